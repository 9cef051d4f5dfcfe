"""What a profile program with pierces, joints, tabs and marks burns, by its text and the layout alone, and whether all of
it is as it was stated (docs/formats.md, "Profile programs").

Cuts and contours become chords that are off by OFF at most; every distance is that of two chords. What is loose is
looked for in a picture of the sheet, in which the cuts are burnt one after the other.
"""

import json
import math

from profile import NEEDED, Near, Refused, inside, off_segment, words_of

OFF = 1e-4  # mm, chords from their arcs
ROUNDED = 5e-3  # mm, what the decimals of a program may change of a joint and of an arc's radius
MARKED = 4e-3  # mm, an engraving from its mark
LETTERS = set("XYZIJFSPOTH")


class Cut:
    """A chain of moves without a lift, or the beam off."""

    def __init__(self, depth, tool):
        self.depth, self.tool, self.moves, self.rapid = depth, tool, [], False

    def key(self):
        return tuple(self.moves), self.rapid


class Reader:
    """Follows a program as its control does, block by block."""

    def __init__(self, text):
        self.cuts, self.modes, self.scale = [], set(), 0
        self.at, self.known, self.z = (0.0, 0.0), set(), None
        self.on = self.ended = self.going_on = False
        self.motion = self.switch = self.pierced = None
        self.tool, self.due = 0, []  # what has to come after a change of tools, and in which order
        for number, line in enumerate(text.splitlines()):
            if line.strip() == "%":
                self.require(number == 0 or self.ended)
                continue
            words = words_of(line)
            self.require(not words or not self.ended)
            self.block(words)
        self.require(self.ended, not self.on, self.pierced is None)
        deepest = max((cut.depth for cut in self.cuts), default=0)
        self.require(len({cut.tool for cut in self.cuts if cut.depth == deepest}) <= 1)

    @staticmethod
    def require(*conditions):
        if not all(conditions):
            raise Refused

    def block(self, words):
        given, dwell, moves, codes = {}, False, False, set()
        for word in words:
            letter, value = word[0], float(word[1:])
            code = f"{letter}{value:g}"
            codes.add(code)
            if code in ("G0", "G1", "G2", "G3"):
                self.motion, moves = code, True
            elif code == "G4":
                dwell = True
            elif code in ("G43", "M6"):
                pass
            elif letter == "G":
                self.require(code in NEEDED | {"G20", "G21", "G80"})
                if code in ("G20", "G21"):
                    self.require(not self.known)
                    self.scale = 25.4 if code == "G20" else 1
                self.modes.add(code)
            elif letter == "M":
                self.switched(code)
            else:
                self.require(letter in LETTERS, letter not in given)
                given[letter] = value
        self.require(("M6" in codes) == ("T" in given), ("G43" in codes) == ("H" in given))
        if "M6" in codes:
            self.require(not self.on, 1 <= given["T"] <= 9999, given["T"] % 1 == 0)
            self.tool, self.due = given["T"], ["length", "lift"]
            self.known, self.z, self.going_on = set(), None, False
        if "G43" in codes:
            self.require(self.due[:1] == ["length"], given["H"] == self.tool)
            self.due.pop(0)
        self.require(not ("G49" in codes and self.tool))
        moves = moves or bool({"X", "Y", "Z"} & set(given))
        self.require(("P" in given) == dwell, not (dwell and moves))
        if moves:
            self.move(given)

    def switched(self, code):
        self.going_on = False
        if code in ("M3", "M4"):
            self.require(self.switch in (None, code), self.z is None or code == "M3")
            self.switch, self.on = code, True
            if self.z is None or self.z < 0:
                self.pierced = self.at
        elif code == "M5":
            self.on = False
        else:
            self.require(code in ("M2", "M30"))
            self.ended = True

    def move(self, given):
        self.require(NEEDED <= self.modes, self.scale, self.motion)
        arc, flat = self.motion in ("G2", "G3"), bool({"X", "Y"} & set(given))
        self.require(("I" in given) == ("J" in given) == arc, not (flat and "Z" in given))
        self.require(not self.due or (self.due == ["lift"] and not flat))
        self.due = []
        was_known = self.known >= {"X", "Y"}
        self.known |= {"X", "Y"} & set(given)
        start = self.at
        self.at = end = tuple(self.scale * given[k] if k in given else start[i] for i, k in enumerate("XY"))
        if "Z" in given:
            self.z = self.scale * given["Z"]
        cuts = self.on and (self.z is None or self.z < 0)
        if not flat:
            self.require(not (cuts and self.motion == "G0"))
            self.pierced, self.going_on = end if cuts else self.pierced, False
            return
        self.require(self.on or self.z is None or self.z >= 0)
        if not cuts:
            self.require(self.pierced in (None, end))
            self.going_on = False
            return
        self.require(was_known)
        self.pierced = None
        if not self.going_on:
            self.cuts.append(Cut(-self.z if self.z is not None else 0, self.tool))
        self.going_on = True
        centre = tuple(start[i] + self.scale * given[k] for i, k in enumerate("IJ")) if arc else None
        if arc:
            self.require(abs(math.dist(start, centre) - math.dist(end, centre)) <= ROUNDED, start != end,
                         math.dist(start, centre) > 0)
        self.cuts[-1].moves.append((start, end, centre, self.motion == "G3"))
        self.cuts[-1].rapid |= self.motion == "G0"


def chords_of(start, end, centre, ccw):
    """Places along a move, from its start to its end."""
    if centre is None:
        return [start, end]
    r, first = math.dist(start, centre), math.atan2(start[1] - centre[1], start[0] - centre[0])
    turn = (math.atan2(end[1] - centre[1], end[0] - centre[0]) - first) % math.tau or math.tau
    turn = turn if ccw else turn - math.tau if turn < math.tau else -math.tau
    n = max(1, math.ceil(abs(turn) / math.sqrt(8 * OFF / max(r, OFF))))
    between = [(centre[0] + r * math.cos(first + turn * k / n), centre[1] + r * math.sin(first + turn * k / n))
               for k in range(1, n)]
    return [start] + between + [end]


def segments(chords):
    return [(a, b) for a, b in zip(chords, chords[1:])] or [(chords[0], chords[0])]


def off(p, a, b):
    return off_segment(p, a, b) if a != b else math.dist(p, a)


def cross(a, b, p):
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def apart(s, t):
    """The distance of two segments."""
    (a, b), (c, d) = s, t
    if cross(a, b, c) * cross(a, b, d) < 0 and cross(c, d, a) * cross(c, d, b) < 0:
        return 0.0
    return min(off(a, c, d), off(b, c, d), off(c, a, b), off(d, a, b))


def nearer(some, others, least):
    """Some two segments are nearer than this."""
    boxes = [(min(c[0], d[0]) - least, min(c[1], d[1]) - least, max(c[0], d[0]) + least, max(c[1], d[1]) + least)
             for c, d in others]
    for a, b in some:
        low, high = (min(a[0], b[0]), min(a[1], b[1])), (max(a[0], b[0]), max(a[1], b[1]))
        for (x0, y0, x1, y1), other in zip(boxes, others):
            if low[0] < x1 and high[0] > x0 and low[1] < y1 and high[1] > y0 and apart((a, b), other) < least:
                return True
    return False


def samples_of(chords, step):
    """Places along chords, not farther from each other than a step."""
    made = []
    for a, b in segments(chords):
        n = max(1, math.ceil(math.dist(a, b) / step))
        made += [(a[0] + (b[0] - a[0]) * k / n, a[1] + (b[1] - a[1]) * k / n) for k in range(n)]
    return made + [chords[-1]]


def motion_of(placement):
    c, s, mirror = placement["c"], placement["s"], -1 if placement.get("mirrored") else 1
    return lambda p: (c * mirror * p[0] - s * p[1] + placement["x"], s * mirror * p[0] + c * p[1] + placement["y"])


def chords_of_edges(edges):
    made = []
    for edge in edges:
        (kind, e), = edge.items()
        centre = tuple(e["centre"]) if kind == "arc" else None
        made += chords_of(tuple(e["from"]), tuple(e["to"]), centre, e.get("ccw"))[bool(made):]
    return made


class Contour:
    """An outline or a hole of a placed part, as a ring of chords."""

    def __init__(self, ring, hole):
        self.ring, self.hole = ring, hole
        self.sides = segments(ring + ring[:1])
        self.near = Near([ring])
        x, y = zip(*ring)
        self.box = min(x), min(y), max(x), max(y)
        turned = sum(a[0] * b[1] - b[0] * a[1] for a, b in self.sides)
        self.waste = 1 if (turned > 0) != hole else -1  # on the right of its sides, or on the left

    def holds(self, p):
        return self.box[0] <= p[0] <= self.box[2] and self.box[1] <= p[1] <= self.box[3] and inside(p, self.ring)

    def middles(self, half, step):
        """Where the middle of a kerf runs beside it, at places that are half a kerf from all of it."""
        for a, b in self.sides:
            size = math.dist(a, b)
            n = max(1, math.ceil(size / step)) if size else 0
            for k in range(n):
                x, y = (a[i] + (b[i] - a[i]) * (k + 0.5) / n for i in (0, 1))
                p = (x + self.waste * half * (b[1] - a[1]) / size, y - self.waste * half * (b[0] - a[0]) / size)
                if self.near.off(p) >= half - 2 * OFF:
                    yield p


class Line:
    """A line or a stroke on a part."""

    def __init__(self, chords):
        self.sides = segments(chords)
        x, y = zip(*chords)
        self.box = min(x) - MARKED, min(y) - MARKED, max(x) + MARKED, max(y) + MARKED

    def is_near(self, p):
        return self.box[0] <= p[0] <= self.box[2] and self.box[1] <= p[1] <= self.box[3]

    def off(self, p):
        return min(off(p, *side) for side in self.sides)


class Judge:
    """What is stated of a program, and the sheet that it is for."""

    def __init__(self, layout, stock, kerf, copy=0, pierce=0, joint=0, tolerance=0.01, heaps=False):
        self.half, self.pierce, self.joint, self.tolerance = kerf / 2, pierce / 2, joint, tolerance
        # A cut is along a contour where it is off by no more than this.
        self.slack = tolerance + max(0.02, 0.1 * self.half)
        self.heaps = heaps
        parts = {part["id"]: part for part in layout["parts"]}
        self.contours, self.parts, self.lines, self.letters, self.known = [], [], [], [], {}
        for placement in layout["placements"]:
            if placement["stock"] != stock or placement.get("copy", 0) != copy:
                continue
            part, put = parts[placement["part"]], motion_of(placement)
            outline = part["outline"]
            region = outline.get("curves")
            rings = [outline["polygon"]["outer"]] + outline["polygon"].get("holes", []) if not region else \
                [chords_of_edges(loop)[:-1] for loop in [region["outer"]] + region.get("holes", [])]
            made = [Contour([put(p) for p in ring], k > 0) for k, ring in enumerate(rings)]
            self.contours += made
            self.parts.append(made)
            engraved = lambda one: one.get("role", "mark") in ("mark", "engrave")
            self.lines += [Line(list(map(put, chords_of_edges(mark["edges"])))) for mark in part.get("marks", [])
                           if engraved(mark)]
            self.letters += [self.box_of_letters(text, put) for text in part.get("texts", []) if engraved(text)]
        self.strokes = []

    @staticmethod
    def box_of_letters(text, put):
        """The rectangle of a text that stands left and unturned, with room for the widest letters."""
        (x, y), h = text["at"], text["height"]
        wide = 1.4 * h * len(text["text"])
        return [put(p) for p in ((x, y - h / 2), (x + wide, y - h / 2), (x + wide, y + 1.5 * h), (x, y + 1.5 * h))]

    def learn_strokes(self, cuts):
        """Fonts are lekalo's own: the strokes of texts are those of the program before its change that lie where
        letters are."""
        for cut in cuts:
            chords = self.geometry(cut)["whole"]
            if not self.is_on(chords, self.lines) and any(all(inside(p, box) for p in chords) for box in self.letters):
                self.strokes.append(Line(chords))
        self.known = {}

    @staticmethod
    def is_on(chords, lines):
        """All of a chain lies on lines, each of its chords on one of them."""
        for a, b in segments(chords):
            near = [line for line in lines if line.is_near(a) and line.is_near(b)]
            if not any(all(line.off(p) <= MARKED for p in samples_of([a, b], 0.5)) for line in near):
                return False
        return True

    def geometry(self, cut):
        """What depends on the way of a cut alone."""
        key = cut.key()
        if key not in self.known:
            self.known[key] = self.seen(cut)
        return self.known[key]

    def seen(self, cut):
        chords = [chords_of(*move) for move in cut.moves]
        whole = [p for k, some in enumerate(chords) for p in some[k > 0:]]
        made = {"whole": whole, "mark": False, "of": None}
        if cut.rapid:
            return made
        made["mark"] = self.is_on(whole, self.lines + self.strokes)
        if made["mark"]:
            return made
        made["clear"] = self.is_clear(whole)
        end = cut.moves[-1][1]
        first = next((k for k, move in enumerate(cut.moves) if move[0] == end), None)
        begins = [first] if first is not None else [0, 1] if self.joint and len(cut.moves) > 1 else \
            [0] if self.joint else []
        for begin in begins:
            along = [p for k, some in enumerate(chords[begin:]) for p in some[k > 0:]]
            of = self.followed(along, first is not None)
            if of is not None:
                lead = [side for some in chords[:begin] for side in segments(some)]
                made.update(of=of, along=along, closed=first is not None, lead=lead)
                return made
        return made

    def is_clear(self, whole):
        """A chain begins outside of all parts and comes nowhere nearer than half a kerf."""
        some, least = segments(whole), self.half - self.tolerance - 2 * OFF
        if any(sum(c.holds(whole[0]) for c in part) % 2 for part in self.parts):
            return False
        return not any(nearer(some, contour.sides, least) for contour in self.contours)

    def followed(self, along, closed):
        reach = self.half + self.slack
        for number, contour in enumerate(self.contours):
            if contour.holds(along[0]) != contour.hole or contour.near.off(along[0]) > reach:
                continue
            if any(contour.near.off(p) > reach for p in samples_of(along, 0.1)):
                continue
            if not closed or self.is_all_round(contour, [along]):
                return number
        return None

    def is_all_round(self, contour, ways, gaps=()):
        near = Near(ways and [way + way[-2:0:-1] for way in ways])
        for p in contour.middles(self.half, 0.3):
            if near.off(p) > self.slack and not any(off(p, *gap) <= self.slack + math.dist(*gap) / 2 for gap in gaps):
                return False
        return True

    def holds(self, cuts):
        """Everything that is stated is so."""
        seen = [self.geometry(cut) for cut in cuts]
        deepest = max(cut.depth for cut in cuts)
        through = [cut.depth >= deepest - 1e-7 for cut in cuts]
        done = []  # (number of the cut, its contour)
        for k, (cut, one) in enumerate(zip(cuts, seen)):
            if one["mark"]:
                around = [seen[i]["of"] for i in done if seen[i]["closed"] and through[i]]
                if 0 < deepest <= cut.depth + 1e-7 or any(self.contours[c].holds(one["whole"][0]) for c in around
                                                          if not self.contours[c].hole):
                    return False
            elif one["of"] is None or not one["clear"]:
                return False
            else:
                done.append(k)
        joints = []
        for number, contour in enumerate(self.contours):
            mine = [seen[k] for k in done if seen[k]["of"] == number and through[k]]
            if any(one["closed"] for one in mine):
                continue
            found = self.joints_of(contour, [one["along"] for one in mine])
            if found is None:
                return False
            joints += found
        return self.are_free(joints, [seen[k] for k in done if through[k]]) and self.are_pierced(cuts, seen, done) and \
            self.is_in_order(seen, done, through)

    def joints_of(self, contour, ways):
        """The rectangles of the joints between stretches of a contour, each as wide as stated."""
        if not ways or not self.joint:
            return None
        gaps, after = [], set()
        for way in ways:
            k = min(range(len(ways)), key=lambda i: math.dist(way[-1], ways[i][0]))
            gap = (way[-1], ways[k][0])
            if k in after or abs(math.dist(*gap) - 2 * self.half - self.joint) > ROUNDED + OFF:
                return None
            after.add(k)
            gaps.append(gap)
        if not self.is_all_round(contour, ways, gaps):
            return None
        made = []
        for a, b in gaps:
            size = math.dist(a, b)
            u = ((b[0] - a[0]) / size, (b[1] - a[1]) / size)
            sides = [(a[0] - s * u[1], a[1] + s * u[0]) for s in (self.half, -self.half)]
            out = 1 if contour.near.off(sides[0]) > contour.near.off(sides[1]) else -1
            deep, way = self.half + self.joint, (-out * u[1], out * u[0])
            p, q = ((a[0] + self.half * u[0], a[1] + self.half * u[1]), (b[0] - self.half * u[0], b[1] - self.half * u[1]))
            made.append([p, q, (q[0] + deep * way[0], q[1] + deep * way[1]), (p[0] + deep * way[0], p[1] + deep * way[1])])
        return made

    def are_free(self, joints, burning):
        """No kerf and no disc enters a joint."""
        for corners in joints:
            sides = segments(corners + corners[:1])
            for one in burning:
                start = one["whole"][0]
                if nearer(segments(one["whole"]), sides, self.half - ROUNDED - 2 * OFF) or inside(start, corners) or \
                        nearer([(start, start)], sides, max(self.half, self.pierce) - ROUNDED - 2 * OFF):
                    return False
        return True

    def are_pierced(self, cuts, seen, done):
        """Discs stay out of parts, and they and their leads out of the kerfs that are there before."""
        if not self.pierce:
            return True
        for n, k in enumerate(done):
            start = [(seen[k]["whole"][0],) * 2]
            if any(nearer(start, contour.sides, self.pierce - self.tolerance - 2 * OFF) for contour in self.contours):
                return False
            for before in done[:n]:
                # Stretches of one contour begin beside each other, and have joints between them.
                if seen[before]["of"] == seen[k]["of"] and not seen[before]["closed"] and not seen[k]["closed"]:
                    continue
                kerf = segments(seen[before]["whole"])
                if nearer(start, kerf, self.pierce + self.half - 2 * OFF) or \
                        nearer(seen[k]["lead"], kerf, 2 * self.half - 2 * OFF):
                    return False
        return True

    def is_in_order(self, seen, done, through):
        """What is enclosed is cut before what encloses it."""
        for n, k in enumerate(done):
            if not (seen[k]["closed"] and through[k]):
                continue
            around = self.contours[seen[k]["of"]]
            for later in done[n + 1:]:
                other = self.contours[seen[later]["of"]]
                if other is not around and around.holds(other.ring[0]):
                    return False
        return not self.heaps or self.hangs_on([(seen[k], through[k]) for k in done])

    def hangs_on(self, cuts, cell=0.1):
        """Every part is joined to the rim of the sheet when it is cut, in a picture of squares."""
        low = [min(c.box[i] for c in self.contours) - 3 for i in (0, 1)]
        high = [max(c.box[i + 2] for c in self.contours) + 3 for i in (0, 1)]
        wide, tall = (math.ceil((high[i] - low[i]) / cell) for i in (0, 1))
        burnt = {}
        for one, through in cuts:
            # The first contour of a part is its outline: its material is beside that.
            part = next(part for part in self.parts if self.contours[one["of"]] in part)
            if through and not self.reaches_rim(burnt, part, one["of"], low, wide, tall, cell):
                return False
            for a in samples_of(one["whole"], cell / 2) if through else ():
                reach = math.ceil(self.half / cell)
                i, j = (int((a[t] - low[t]) / cell) for t in (0, 1))
                for u in range(i - reach, i + reach + 1):
                    for v in range(j - reach, j + reach + 1):
                        p = (low[0] + (u + 0.5) * cell, low[1] + (v + 0.5) * cell)
                        if math.dist(p, a) <= self.half:
                            burnt.setdefault((u, v), set()).add(one["of"])
        return True

    def reaches_rim(self, burnt, part, own, low, wide, tall, cell):
        a, b = part[0].sides[0]
        size, turned = math.dist(a, b), part[0].waste
        p = [(a[i] + b[i]) / 2 for i in (0, 1)]
        p = (p[0] - turned * 0.3 * (b[1] - a[1]) / size, p[1] + turned * 0.3 * (b[0] - a[0]) / size)
        first = tuple(int((p[i] - low[i]) / cell) for i in (0, 1))
        waiting, met = [first], {first}
        while waiting:
            i, j = waiting.pop()
            if not (0 < i < wide - 1 and 0 < j < tall - 1):
                return True
            for other in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
                if other not in met and not burnt.get(other, set()) - {own}:
                    met.add(other)
                    waiting.append(other)
        return False


def judged_by(judge_of, whose):
    """Of a program that was changed, by a judge of the layout that was not, made of its file and the cuts before."""
    def oracle(context):
        before = Reader(context.text).cuts
        judge = judge_of(context.json("nested.json"), before)
        if not judge.holds(before):
            raise RuntimeError(f"{context.kind.name}: the program is not right by {whose}")
        known = [(cut.key(), cut.depth) for cut in before]

        def answer(change):
            try:
                after = Reader(change.text()).cuts
            except (Refused, ValueError):
                return None
            if [(cut.key(), cut.depth) for cut in after] == known:
                return "information"
            return bool(after) and judge.holds(after) or None
        return answer
    return oracle


def program(stock, kerf, **stated):
    def judge_of(layout, before):
        judge = Judge(layout, stock, kerf, **stated)
        judge.learn_strokes(before)
        return judge
    return judged_by(judge_of, "cuts.py")
