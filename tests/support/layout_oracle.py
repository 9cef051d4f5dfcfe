#!/usr/bin/env python3
"""What another library (shapely, GEOS) says of layouts and of the violations found in them.

  layout_oracle.py probe       status 0 where the library is there
  layout_oracle.py FILE        FILE: [{"name", "layout": a layout, "violations": as `lekalo check --json` has them}, ...]

Outlines are placed in doubles by the rule of docs/design/layout.md. What is decided by less than 1e-6 mm is left to the
other side; everything else has to be the same, what is missing of a gap too, and moving part a by amount_mm in its
direction has to end a violation. Prints {"documents", "found": {kind: count}, "absent": relations that hold, "close": left
to the other side, "complaints": [...]}.
"""
import json
import math
import sys

try:
    import shapely.geometry as sg
    from shapely.affinity import translate
    from shapely.ops import unary_union
except ImportError:
    sys.exit(3)

CLOSE = 1e-6  # mm
STEP = 2.0**-20


def steps(mm):
    """Rule 1: the nearest step, ties to even, as Python rounds."""
    return round(mm * 2**20)


def polygon(outline, place=lambda x, y: (x, y)):
    rings = [outline["polygon"]["outer"]] + outline["polygon"].get("holes", [])
    rings = [[tuple(STEP * round(v) for v in place(steps(x), steps(y))) for x, y in ring] for ring in rings]
    shape = sg.Polygon(rings[0], rings[1:])
    if not shape.is_valid:
        raise ValueError("an outline that shapely calls invalid")
    return shape


def edges(shape):
    return shape.boundary


def placing(placement):
    if "rotation_deg" in placement:
        angle = math.radians(placement["rotation_deg"])
        c, s = math.cos(angle), math.sin(angle)
    else:
        c, s = placement["c"], placement["s"]
    sign = -1.0 if placement.get("mirrored", False) else 1.0
    x0, y0 = steps(placement["x"]), steps(placement["y"])
    return lambda x, y: (c * sign * x - s * y + x0, s * sign * x + c * y + y0)


def width(shape):
    """Twice the area by the boundary's length: what is wider than CLOSE certainly has an interior."""
    return 2 * shape.area / shape.length if shape.area > 0 else 0.0


def meeting(a, b):
    """(state, width) of two regions that may not have interior in common."""
    if a.distance(b) > CLOSE:
        return "no", 0.0
    wide = width(a.intersection(b))
    return ("yes" if wide > CLOSE else "close"), wide


def nearness(a, b, gap):
    """State of a gap, and what is missing of it."""
    missing = gap - edges(a).distance(edges(b))
    return ("yes" if missing > CLOSE else "no" if missing < -CLOSE else "close"), missing


def off_by(a, b):
    """How far two angles are apart, in [0, 180]."""
    return abs(math.remainder(a - b, 360))


def quality_of(value):
    return math.inf if value == "best" else value


class Judge:
    def __init__(self, name, layout, violations):
        self.name, self.layout = name, layout
        self.parts = {part["id"]: part for part in layout["parts"]}
        self.stocks = {stock["id"]: stock for stock in layout["stocks"]}
        self.rules = layout.get("rules", {})
        self.said = {}
        for v in violations:
            self.said[(v["kind"], v["a"], v["b"], v.get("feature"))] = v
        self.found, self.absent, self.close, self.complaints = {}, 0, 0, []

    def complain(self, text):
        self.complaints.append(f"{self.name}: {text}")

    def settle(self, kind, a, b, feature, state, ends=None, where=None):
        """Compares what was found of one relation with what the other side says. ends(dx, dy): how wide the violation
        still is when a is moved."""
        said = self.said.pop((kind, a, b, feature), None)
        what = f"{kind} of {a}" + (f" and {b}" if b else "") + (f" at {feature}" if feature else "")
        if state == "close":
            self.close += 1
        elif state == "yes":
            self.found[kind] = self.found.get(kind, 0) + 1
            if said is None:
                self.complain(f"{what} was not reported")
        else:
            self.absent += 1
            if said is not None:
                self.complain(f"{what} was reported, and is none")
        if said is None:
            return
        if said["direction"] is not None and ends is not None:
            dx, dy = said["direction"]
            if abs(math.hypot(dx, dy) - 1) > 1e-9:
                self.complain(f"{what}: no unit vector {said['direction']}")
            left = ends(said["amount_mm"] * dx, said["amount_mm"] * dy)
            if left > CLOSE:
                self.complain(f"{what}: moved by {said['amount_mm']} along {said['direction']}, {left} mm are left")
        if where is not None:
            far = max(shape.distance(sg.Point(said["at"])) - reach for shape, reach in where)
            if far > 2 * CLOSE:
                self.complain(f"{what}: its place {said['at']} is {far} mm away")

    def region_rule(self, meets, nears, a, b, feature, shape, other, gap):
        """Overlap of one kind, or else a gap of another."""
        state, _ = meeting(shape, other)
        self.settle(meets, a, b, feature, state,
                    lambda dx, dy: width(translate(shape, dx, dy).intersection(other)),
                    [(shape, 0), (other, 0)])
        near, missing = nearness(shape, other, gap)
        self.gap_rule(nears, a, b, feature, state, near, missing, shape, other, gap)

    def gap_rule(self, nears, a, b, feature, meets, near, missing, shape, other, gap):
        said = self.said.get((nears, a, b, feature))
        if said is not None and abs(said["amount_mm"] - missing) > CLOSE:
            self.complain(f"{nears} of {a} and {b or feature}: {said['amount_mm']} is missing, by shapely {missing}")
        if meets == "yes" or gap == 0:
            near = "no"  # said by the other kind, or nothing asked for
        elif meets == "close" and near == "yes":
            near = "close"
        self.settle(nears, a, b, feature, near, None, [(shape, 0), (other, gap)])

    def own(self, part, gap):
        return STEP * math.ceil(part.get(gap, self.rules.get(gap, 0)) * 2**20)

    def run(self):
        sheets = {}
        for placement in self.layout["placements"]:
            part, stock = self.parts[placement["part"]], self.stocks[placement["stock"]]
            self.own_rules(placement, part, stock)
            shape = polygon(part["outline"], placing(placement))
            sheets.setdefault((stock["id"], placement.get("copy", 0)), []).append((placement, part, shape))
        for (stock, _), placed in sheets.items():
            self.sheet(self.stocks[stock], placed)
        for key in self.said:
            self.complain(f"{key} was reported, and shapely was not asked")
        return self

    def own_rules(self, placement, part, stock):
        a = placement["id"]
        copy = placement.get("copy", 0)
        self.settle("stock", a, None, None, "no" if 0 <= copy < stock.get("count", 1) else "yes")
        mirrored = placement.get("mirrored", False)
        self.settle("mirror", a, None, None, "yes" if mirrored and not part.get("mirror", False) else "no")
        if "rotation_deg" in placement:
            angle = placement["rotation_deg"]
        else:
            angle = math.degrees(math.atan2(placement["s"], placement["c"]))
        outside = math.inf if "rotations" in part else -1.0
        for one in part.get("rotations", []):
            low, high = (one["from"], one["to"]) if isinstance(one, dict) else (one, one)
            if high - low >= 360:
                outside = -1.0
            elif low == high:
                outside = min(outside, off_by(angle, low))
            else:
                middle = (low + high) / 2
                outside = min(outside, off_by(angle, middle) - (high - low) / 2)
        # A single angle is met exactly or missed: its pair is the one in the file.
        self.settle("rotation", a, None, None,
                    "yes" if outside > 1e-9 else "no" if outside < -1e-9 else "close")
        grain = part.get("grain")
        if grain is not None and "grain_deg" in stock:
            own = 180 - grain["deg"] if mirrored else grain["deg"]
            off = off_by(2 * (own + angle), 2 * stock["grain_deg"]) / 2 - grain.get("tolerance_deg", 0)
            self.settle("grain", a, None, None, "yes" if off > 1e-9 else "no" if off < -1e-9 else "close")

    def sheet(self, stock, placed):
        if stock["kind"] == "strip":
            material = sg.box(0, 0, stock.get("length", 262144.0), stock["height"])
        else:
            material = polygon(stock["outline"])
        defects = [(d["id"], d.get("severity", 1), polygon(d["outline"])) for d in stock.get("defects", [])]
        zones = [(z["id"], quality_of(z["quality"]), polygon(z["outline"])) for z in stock.get("zones", [])]
        for placement, part, shape in placed:
            a = placement["id"]
            wide = width(shape.difference(material))
            out = "yes" if wide > CLOSE else "no" if material.contains(shape.buffer(CLOSE)) else "close"
            self.settle("outside", a, None, None, out,
                        lambda dx, dy, s=shape: width(translate(s, dx, dy).difference(material)),
                        [(shape, 0)])
            gap = self.own(part, "border_gap")
            near, missing = nearness(shape, material, gap)
            self.gap_rule("border-gap", a, None, None, out, near, missing, shape, edges(material), gap)
            for name, severity, defect in defects:
                if severity > part.get("tolerated_severity", 0):
                    self.region_rule("defect", "defect-gap", a, None, name, shape, defect,
                                     self.own(part, "defect_gap"))
            for name, quality, zone in zones:
                self.zone_rule(placement, part, shape, name, quality, zone)
        placed.sort(key=lambda one: one[0]["id"])
        for i, (first, part, shape) in enumerate(placed):
            for second, other_part, other in placed[i + 1:]:
                gap = max(self.own(part, "gap"), self.own(other_part, "gap"))
                self.region_rule("overlap", "gap", first["id"], second["id"], None, shape, other, gap)

    def zone_rule(self, placement, part, shape, name, quality, zone):
        areas = [(quality_of(area["quality"]), polygon(area["outline"], placing(placement)))
                 for area in part.get("areas", [])]
        strict = [area for demand, area in areas if demand > quality]
        bad = [shape.intersection(area) for area in strict]
        if quality_of(part.get("quality", 0)) > quality:
            rest = shape
            for demand, area in areas:
                if demand <= quality:
                    rest = rest.difference(area)
            bad.append(rest)
        if not bad:
            return self.settle("quality", placement["id"], None, name, "no")
        bad = unary_union(bad)
        wide = width(bad.intersection(zone))
        if wide > CLOSE:
            state = "yes"
        else:
            state = "no" if bad.is_empty or bad.distance(zone) > CLOSE else "close"
        self.settle("quality", placement["id"], None, name, state,
                    lambda dx, dy: width(translate(bad, dx, dy).intersection(zone)), [(shape, 0), (zone, 0)])


def main():
    if sys.argv[1] == "probe":
        return
    total = {"documents": 0, "found": {}, "absent": 0, "close": 0, "complaints": []}
    with open(sys.argv[1], encoding="utf-8") as file:
        cases = json.load(file)
    for case in cases:
        judge = Judge(case["name"], case["layout"], case["violations"]).run()
        total["documents"] += 1
        for kind, count in judge.found.items():
            total["found"][kind] = total["found"].get(kind, 0) + count
        total["absent"] += judge.absent
        total["close"] += judge.close
        total["complaints"] += judge.complaints
    json.dump(total, sys.stdout)


main()
