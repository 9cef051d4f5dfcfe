"""Decides which changes of what a placement of solids says of demands by face and of datums leave every claim true.

What the file of features demands says tests/support/solid_demands.py, which was written from docs/formats.md alone.
"""

import bisect
import heapq
import itertools
import math

import solid_demands as asked
from exact_bodies import of_segments
from exact_solids import F, dot, normal, squared_distance, sub


def ways_between(s, t):
    """Of which the shortest is as long as two triangles are apart."""
    return [(squared_distance, p, t) for p in s] + [(squared_distance, p, s) for p in t] + [
        (of_segments, s[k - 1], s[k], t[j - 1], t[j]) for k in range(3) for j in range(3)]


def of_triangles(s, t):
    return min(measure(*way) for measure, *way in ways_between(s, t))


def exactly_of_triangles(s, t):
    """In fractions, of the ways that doubles show to be shortest."""
    near = [measure(*way) for measure, *way in ways_between(*([list(map(float, p)) for p in one] for one in (s, t)))]
    return min(measure(*way) for far, (measure, *way) in zip(near, ways_between(s, t)) if far <= min(near) + 1e-9)


def farthest(triangles, surface, within):
    """Bounds of how far the farthest point of some triangles is from a surface, in doubles."""
    def of(t):
        middle = [sum(c) / 3 for c in zip(*t)]
        far = [squared_distance(middle, s) for s in surface]
        near = surface[far.index(min(far))]
        way = max(math.dist(middle, p) for p in t)
        high = min(max(math.sqrt(squared_distance(p, near)) for p in t), math.sqrt(min(far)) + way)
        return -high, math.sqrt(min(far)), t
    open_ = [of(t) for t in triangles]
    heapq.heapify(open_)
    low = max(one[1] for one in open_)
    while -open_[0][0] > low + within:
        if len(open_) > 5000:
            raise ValueError("too many pieces to tell")
        _, _, t = heapq.heappop(open_)
        k = max(range(3), key=lambda k: math.dist(t[k - 1], t[k]))
        a, b, c = t[k - 1], t[k], t[k - 2]
        m = [(x + y) / 2 for x, y in zip(a, b)]
        for half in (of([a, m, c]), of([m, b, c])):
            low = max(low, half[1])
            heapq.heappush(open_, half)
    return low, -open_[0][0]


def deviation(triangles, targets, place, surface):
    """How far 600 points of triangles are from a surface, off their targets or their mean, in doubles (docs/formats.md,
    "Criteria"). Triangles are those of the part's file; `place` puts a point where the part is placed."""
    corners = [sorted(tuple(map(float, p)) for p in t) for t in triangles]
    until = list(itertools.accumulate(0.5 * math.dist((0, 0, 0), normal(t)) for t in corners))
    rows = []
    for n in range(600):
        k = min(bisect.bisect_right(until, (n + 0.4142) / 600 * until[-1]), len(until) - 1)
        u, v = math.sqrt((n + 1) * 0.7548776662466927 % 1), (n + 1) * 0.5698402909980532 % 1
        a, b, c = corners[k]
        p = [float(x) for x in place([F(x + u * (1 - v) * (y - x) + u * v * (z - x)) for x, y, z in zip(a, b, c)])]
        rows.append((math.sqrt(min(squared_distance(p, s) for s in surface)), targets[k]))
    free = [far for far, target in rows if target is None]
    mean = sum(free) / len(free) if free else 0
    return math.sqrt(sum((far - (mean if target is None else target)) ** 2 for far, target in rows) / 600)


def beside_rim(triangle, face, rim):
    """Pieces of a triangle that have all its points which are no nearer to a face than its rim is wide, and few others."""
    kept, open_, square = [], [(triangle, 0)], rim * rim

    def between(a, b, share):
        return [x + share * (y - x) for x, y in zip(a, b)]

    def last(a, b, g):  # in the rim, on the way from a to b
        if squared_distance(b, g) < square:
            return b
        low, high = F(0), F(1)
        for _ in range(40):
            middle = (low + high) / 2
            low, high = (middle, high) if squared_distance(between(a, b, middle), g) < square else (low, middle)
        return between(a, b, low)
    while open_:
        t, cuts = open_.pop()
        if t[0] == t[1] or t[1] == t[2] or t[2] == t[0]:
            continue
        far = [[squared_distance(p, g) for p in t] for g in face]
        if any(max(row) < square for row in far):
            continue
        well = [[one < square * F(4095, 4096) for one in row] for row in far]
        best = max(range(len(face)), key=lambda k: sum(well[k]))
        if cuts == 30 or sum(well[best]) == 0 and min(of_triangles(t, g) for g in face) >= square * F(999, 1000):
            kept.append(t)
        elif sum(well[best]) == 0:
            k = max(range(3), key=lambda k: float(dot(sub(t[k], t[k - 1]), sub(t[k], t[k - 1]))))
            a, b, c = t[k - 1], t[k], t[k - 2]
            m = between(a, b, F(1, 2))
            open_ += [([a, m, c], cuts + 1), ([m, b, c], cuts + 1)]
        else:
            two = sum(well[best]) == 2
            k = next(k for k in range(3) if well[best][k] != two)
            a, b, c = t[k], t[k - 2], t[k - 1]
            if two:
                open_.append(([a, last(b, a, face[best]), last(c, a, face[best])], cuts + 1))
            else:
                p, q = last(a, b, face[best]), last(a, c, face[best])
                open_ += [([p, b, c], cuts + 1), ([p, c, q], cuts + 1)]
    return kept


def allowed(feature):
    """How far its points may be from the blank's surface, or None."""
    return feature.get("maximum", feature.get("finished"))


class Faces:
    """The demands on a part, and where it is to lie."""

    def __init__(self, file, part, least):
        self.unit, self.part = asked.UNITS[file.get("units", "mm")], part
        self.file = {one["name"]: one for one in file.get("features", [])}
        self.features = [self.feature(one) for one in file.get("features", [])]
        self.of = asked.demands(file, part.all, least)
        self.datums, self.within = asked.datums(file, part.all), asked.maxima(file, part.all)
        self.rims = [([part.all[f] for f in asked.triangles_of(one, self.unit, part.all)], F(told["rim"]))
                     for one, told in zip(file.get("features", []), self.features) if "rim" in told]
        self.names = [one["name"] for one in file.get("datums", [])]
        self.minimum = None if file.get("as_cast") else max(float(self.unit) * float(file.get("minimum", 0)), float(least))

    def feature(self, one):
        more = {key: float(self.unit) * float(one[key]) for key in ("maximum", "finished") if one.get(key) is not None}
        rough = one.get("as_cast", False) or "finished" in more
        if one.get("target") is not None:
            more["target"] = float(self.unit) * float(one["target"])
        if float(one.get("rim") or 0) > 0:
            more["rim"] = float(self.unit) * float(one["rim"])
        return more | {"name": one["name"], "triangles": len(asked.triangles_of(one, self.unit, self.part.all)),
                "minimum": None if rough else float(self.unit) * float(one.get("minimum", 0)),
                "scale": None if rough else float(one.get("scale", 1)), "as_cast": one.get("as_cast", False)}

    def are_told(self, said):
        def same(one, other):
            return one.keys() == other.keys() and all(
                value == other[key] if isinstance(value, (str, bool)) or None in (value, other[key])
                else float(value) == float(other[key]) for key, value in one.items())
        datums = [(datum["name"], float(datum["within"])) for datum in said["datums"]]
        if any(("largest" in one) != ("maximum" in one or "finished" in one) for one in said["features"]):
            return False
        features = [{key: value for key, value in one.items() if key != "largest"} for one in said["features"]]
        return (same({"minimum": self.minimum}, {"minimum": said["minimum"]}) and len(said["features"]) == len(self.features) and
                all(map(same, self.features, features)) and
                datums == [(name, float(datum["within"])) for name, datum in zip(self.names, self.datums)])

    def are_off(self, document, place, slack):
        """The part is as far off each datum as is said, and its datums are kept where it is said to be inside."""
        for said, datum in zip(document["demands"]["datums"], self.datums):
            ways = [asked.straight_off(datum, sub(place(document, p), datum["through"])) for p in datum["points"].values()]
            most = max(dot(way, way) for way in ways)
            missed = max(F(0), said["off"] - said["within"])
            if ("missed" in said) != (missed > 0) or abs(said.get("missed", 0) - missed) > (said["off"] + said["within"]) / 10 ** 15:
                return False
            if said["off"] < 0 or said["off"] ** 2 < most or max(F(0), said["off"] - slack) ** 2 > most:
                return False
        return not document["inside"] or self.are_kept(document)

    def are_kept(self, document):
        said = document["demands"]
        return all(one["off"] <= datum["within"] for one, datum in zip(said["datums"], self.datums)) and all(
            one["largest"] <= F(allowed(one)) for one in said["features"] if allowed(one) is not None)

    def are_far(self, document, place, surface):
        """The points of each feature with a maximum, or that is finished, are as far from the blank's surface as is said."""
        for said, feature in zip(document["demands"]["features"], self.features):
            within = allowed(feature)
            if within is None:
                continue
            most = float(said["largest"])
            low, high = farthest([[list(map(float, place(document, p))) for p in self.part.all[f]]
                                  for f in asked.triangles_of(self.file[said["name"]], self.unit, self.part.all)],
                                 [[list(map(float, p)) for p in t] for t in surface], max(within * 1e-4, 1e-9))
            if most < low * (1 - 1e-12) or most > high + within / 32:
                return False
        return not document["inside"] or self.are_kept(document)

    def targets(self):
        """The target of each triangle of the part, or None."""
        made = [None] * len(self.part.all)
        for one, told in zip(self.file.values(), self.features):
            for f in asked.triangles_of(one, self.unit, self.part.all):
                made[f] = told.get("target")
        return made

    def demanded(self):
        """The triangles of each demand."""
        groups = {}
        for demand, triangle in zip(self.of, self.part.all):
            if demand and any(normal(triangle)):
                groups.setdefault(demand, []).extend(self.beside_rims(triangle))
        return groups

    def beside_rims(self, triangle):
        pieces = [triangle]
        for face, rim in self.rims:
            pieces = [one for piece in pieces for one in beside_rim(piece, face, rim)]
        return pieces

    def in_rim(self, kind, number, certificate):
        """The part of a term may demand nothing."""
        if kind in ("part_face", "edges"):
            t = self.part.all[int(number) // (3 if kind == "edges" else 1)]
            return any(of_triangles(t, g) < rim * rim for face, rim in self.rims for g in face)
        if kind not in ("point", "point_plane", "point_face"):
            return False
        f, u, v = certificate["part_points"][int(number)]
        if f != int(f) or not 0 <= f < len(self.part.all):
            return True
        a, b, c = self.part.all[int(f)]
        p = [x + u * (y - x) + v * (z - x) for x, y, z in zip(a, b, c)]
        return any(squared_distance(p, g) < rim * rim for face, rim in self.rims for g in face)

    def bounds(self, bound):
        return [one and one[0] + one[1] * bound for one in self.of]


def derived(document, certificate):
    """The fields that follow from others where there are demands, and the status."""
    said, clearance = document["demands"], document["clearance"]
    margin, bound, gap = said["margin"], said["margin_bound"], said["margin_gap"]
    inside, status, shortfall = document["inside"], document["status"], document["shortfall"]
    if document["upper_bound"] is not None or document["gap"] is not None or any(
            (one is None) == inside for one in (clearance, margin, shortfall)):
        return False
    if (gap is None) != (margin is None or bound is None) or (inside and (clearance < 0 or shortfall != max(F(0), -margin))):
        return False
    if gap is not None and (bound < margin or
                            abs(gap - (bound - margin)) > F(1, 10 ** 15) * (abs(bound) + abs(margin))):
        return False
    if status in ("stopped", "unproved"):
        return status == "stopped" or certificate is None
    return bound is not None and (bound < 0) == (status == "infeasible") and (status == "infeasible" or inside)
