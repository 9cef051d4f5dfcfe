"""What a profile program cuts, by following it in small steps, and whether that is what its layout says."""

import json
import math

STEP = 0.05  # mm along a cut
NEEDED = {"G17", "G40", "G49", "G54", "G61", "G90", "G91.1", "G94"}


class Refused(Exception):
    pass


def words_of(line):
    while "(" in line:
        begin, end = line.index("("), line.find(")", line.index("("))
        if end < 0:
            raise Refused
        line = line[:begin] + line[end + 1:]
    return line.split(";")[0].split()


def cuts_of(text):
    """The cuts, each as its moves (x, y, x, y and the centre of an arc with its sense), and the modes before them."""
    at, z, motion, on, has_z, going_on, ended = [None, None], 0.0, None, False, False, False, False
    chains, modes = [], set()
    for line in text.splitlines():
        given, dwell, moves = {}, False, False
        for word in words_of(line):
            if word == "%":
                continue
            letter, value = word[0], float(word[1:])
            name = f"{letter}{value:g}"
            if name in ("G0", "G1", "G2", "G3"):
                motion, moves = name, True
            elif name == "G4":
                dwell = True
            elif letter == "G":
                modes.add(name)
            elif letter == "M":
                on = {"M3": True, "M4": True, "M5": False}.get(name, on)
                ended = ended or name in ("M2", "M30")
                going_on = False
            elif letter in given:
                raise Refused
            else:
                given[letter] = value
        if dwell or not (moves or {"X", "Y", "Z"} & set(given)):
            continue
        if not NEEDED <= modes or not modes & {"G20", "G21"} or motion is None:
            raise Refused
        scale = 25.4 if "G20" in modes else 1
        x, y = (scale * given[k] if k in given else at[i] for i, k in enumerate("XY"))
        deep = scale * given.get("Z", z / scale)
        has_z = has_z or "Z" in given
        cutting = on and (not has_z or deep < 0 or z < 0)
        if not {"X", "Y"} & set(given) or not cutting:
            going_on = False
        else:
            if None in at:
                raise Refused
            arc = motion in ("G2", "G3")
            if arc != ("I" in given and "J" in given):
                raise Refused
            if not going_on:
                chains.append([])
            going_on = True
            centre = (at[0] + scale * given["I"], at[1] + scale * given["J"], motion) if arc else ()
            if arc and abs(math.dist(at, centre[:2]) - math.dist((x, y), centre[:2])) > 0.005:
                raise Refused
            chains[-1].append((*at, x, y, *centre, *(["rapid"] if motion == "G0" else [])))
        at, z = [x, y], deep
    if not ended or on:
        raise Refused
    return [tuple(chain) for chain in chains]


def places(chain, step=STEP):
    """Places along a chain of moves."""
    made = []
    for move in chain:
        x, y, u, v = move[:4]
        if len(move) >= 7:
            cx, cy, sense = move[4:7]
            r, first = math.hypot(x - cx, y - cy), math.atan2(y - cy, x - cx)
            turn = (math.atan2(v - cy, u - cx) - first) % (2 * math.pi)
            turn = turn if sense == "G3" else turn - 2 * math.pi
            n = min(100000, max(1, math.ceil(abs(turn) * r / step)))
            made += [(cx + r * math.cos(first + turn * k / n), cy + r * math.sin(first + turn * k / n))
                     for k in range(n)]
            made.append((u, v))
        else:
            n = min(100000, max(1, math.ceil(math.hypot(u - x, v - y) / step)))
            made += [(x + (u - x) * k / n, y + (v - y) * k / n) for k in range(n + 1)]
    return made


def off_segment(p, a, b):
    ux, uy = b[0] - a[0], b[1] - a[1]
    t = min(1, max(0, ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / (ux * ux + uy * uy)))
    return math.hypot(p[0] - a[0] - t * ux, p[1] - a[1] - t * uy)


def inside(p, ring):
    found = False
    for a, b in zip(ring, ring[1:] + ring[:1]):
        if (a[1] > p[1]) != (b[1] > p[1]) and a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]) > p[0]:
            found = not found
    return found


class Near:
    """Segments by the squares of a grid that they come near."""

    def __init__(self, rings, cell=8.0, reach=1.0):
        self.cell, self.squares = cell, {}
        for ring in rings:
            for a, b in zip(ring, ring[1:] + ring[:1]):
                if a == b:
                    continue
                for i in range(int((min(a[0], b[0]) - reach) // cell), int((max(a[0], b[0]) + reach) // cell) + 1):
                    for j in range(int((min(a[1], b[1]) - reach) // cell),
                                   int((max(a[1], b[1]) + reach) // cell) + 1):
                        self.squares.setdefault((i, j), []).append((a, b))

    def off(self, p):
        """The distance of a place, where it is below 1 mm."""
        near = self.squares.get((int(p[0] // self.cell), int(p[1] // self.cell)), [])
        return min((off_segment(p, a, b) for a, b in near), default=math.inf)


class Sheet:
    """The contours on one sheet of a layout."""

    def __init__(self, layout, stock, copy, kerf, tolerance=0.01, step=STEP):
        self.half, self.tolerance, self.step = kerf / 2, tolerance, step
        parts = {part["id"]: part["outline"]["polygon"] for part in layout["parts"]}
        self.contours, self.parts = [], []  # (ring, is a hole, lines near it); rings of a part
        for placement in layout["placements"]:
            if placement["stock"] != stock or placement.get("copy", 0) != copy:
                continue
            polygon, rings = parts[placement["part"]], []
            for ring in [polygon["outer"]] + polygon.get("holes", []):
                c, s, mirror = placement["c"], placement["s"], -1 if placement.get("mirrored") else 1
                rings.append([(c * mirror * x - s * y + placement["x"], s * mirror * x + c * y + placement["y"])
                              for x, y in ring])
            self.parts.append(rings)
            self.contours += [(ring, k > 0, Near([ring])) for k, ring in enumerate(rings)]
        self.near = Near([ring for rings in self.parts for ring in rings])

    def in_a_part(self, p):
        return any(sum(inside(p, ring) for ring in rings) % 2 for rings in self.parts)

    def followed(self, chain):
        """The number of the contour that a cut follows, or None where it cuts anything else."""
        if any("rapid" in move for move in chain):
            return None
        end = chain[-1][2:4]
        begins = [move[:2] for move in chain]
        if end not in begins:
            return None
        whole, loop = (places(moves, self.step) for moves in (chain, chain[begins.index(end):]))
        if any(self.near.off(p) < self.half - self.tolerance - 1e-6 for p in whole) or self.in_a_part(whole[0]):
            return None
        for number, (ring, hole, near) in enumerate(self.contours):
            if inside(loop[0], ring) != hole:
                continue
            if all(near.off(p) <= self.half + self.tolerance + 0.02 for p in loop) and self.all_round(ring, near, loop):
                return number
        return None

    def contour_by(self, chain):
        """The number of the contour that a cut which is known to be right follows."""
        start = chain[-1][2:4]
        return next(number for number, (ring, hole, near) in enumerate(self.contours)
                    if inside(start, ring) == hole and near.off(start) <= self.half + self.tolerance + 0.02)

    def all_round(self, ring, near, loop):
        """Where the middle of the kerf can be half a kerf from the contour, the loop is."""
        along = Near([loop[:-1]])
        for a, b in zip(ring, ring[1:] + ring[:1]):
            n = max(1, math.ceil(math.hypot(b[0] - a[0], b[1] - a[1])))
            for k in range(n):
                x, y = (a[i] + (b[i] - a[i]) * (k + 0.5) / n for i in (0, 1))
                size = math.hypot(b[0] - a[0], b[1] - a[1])
                ways = ((b[1] - a[1]) / size, (a[0] - b[0]) / size)
                offs = []
                for sign in (1, -1):
                    p = x + sign * self.half * ways[0], y + sign * self.half * ways[1]
                    if near.off(p) >= self.half - 1e-6:
                        offs.append(along.off(p))
                if offs and min(offs) > self.tolerance + 0.02:
                    return False
        return True

    def is_cut_by(self, numbers):
        """Cuts that follow contours of these numbers cut all, and what is enclosed before what encloses it."""
        first = {number: k for k, number in reversed(list(enumerate(numbers)))}
        last = {number: k for k, number in enumerate(numbers)}
        return set(numbers) == set(range(len(self.contours))) and \
            not any(self.encloses(i, j) and first[i] < last[j] for i in first for j in last)

    def encloses(self, i, j):
        return i != j and inside(self.contours[j][0][0], self.contours[i][0])


def oracle(context):
    sheet = Sheet(json.loads(context.files["nested.json"]), "steel 2 mm", 0, 0.3)
    before = cuts_of(context.text)
    known = {chain: sheet.contour_by(chain) for chain in set(before)}

    def holds(change):
        try:
            after = cuts_of(change.text())
        except (Refused, ValueError, KeyError, TypeError):
            return None
        if after == before:
            return "information"
        numbers = [known[chain] if chain in known else sheet.followed(chain) for chain in after]
        return None not in numbers and sheet.is_cut_by(numbers) or None
    return holds
