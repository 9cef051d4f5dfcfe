"""The widths of a blank that was touched, from the result, the nominal mesh and the touches, by docs/formats.md alone
and in fractions: every cut and every way is proved."""

import math

import check_solid_certificate as proof
import exact
import exact_solids as space
from exact_solids import F, dot, plus, sub, times, turned


def decimal_root(square):
    return (exact.D(square.numerator) / exact.D(square.denominator)).sqrt()


def met(centre, direction, radius):
    """Where a ball met the blank, within 2^-100 of its radius."""
    if not any(direction):
        raise ValueError("a direction that leads nowhere")
    square = dot(direction, direction)
    root = F(math.isqrt((square.numerator * square.denominator) << 256), square.denominator << 128)
    return sub(centre, times(direction, radius / root))


def is_number_below(k, count):
    return k == int(k) and 0 <= k < count


class Touches:
    """Raises ValueError where something is not so."""

    proved = {}

    def __init__(self, scan, nominal, points, directions):
        said = self.said = scan["touches"]
        self.left_out = set(scan["left_out"])
        ball, form, guard = said["ball"] / 2, said["form"], scan["guard"]
        self.require(ball >= 0, said["directions"] is bool(directions))
        self.points, spare = [met(*row, ball) for row in zip(points, directions)] or points, 0
        if directions:
            ball, spare = F(0), ball / 2 ** 100
        off = form + guard + spare
        self.low, self.high = said["around"]
        corners = [p for t in nominal.kept for p in t]
        self.require(ball >= 0, form > 0, guard >= 0, not ball or ball > guard,
                     all(scan[key] is None for key in ("min_radius", "max_dip", "underside")),
                     all(is_number_below(k, len(points)) for k in self.left_out), any(said["quaternion"]),
                     all(low < high for low, high in zip(self.low, self.high)),
                     all(low <= c <= high for p in corners for low, c, high in zip(self.low, p, self.high)))
        self.balls = []
        for *centre, radius in said["balls"]:
            inside = nominal.ball_holds(centre + [radius], True)
            self.require(len(centre) == 3, radius > 0, inside or nominal.ball_holds(centre + [radius], False))
            least = radius - off - (ball if not inside else -ball if ball > 2 * off else 0)
            self.balls.append((centre, least))
        box = [said[axis] for axis in proof.AXES]
        self.require(all(low <= high for low, high in box))
        for cut in said["cuts"]:
            k, (low, high) = self.axis(cut, 6), box[proof.AXES.index(cut["axis"])]
            self.require(low <= cut["at"] <= high)
            halves = [low, cut["at"]], [cut["at"], high]
            self.prove(cut["terms"], [], box[:k] + [halves[cut["above"]]] + box[k + 1:])
            box[k] = halves[not cut["above"]]
        self.farthest = {}
        for way in said["ways"]:
            k, corner, sign = self.axis(way, 3), way["corner"], 1 if way["above"] else -1
            self.require(is_number_below(corner, 8), way["at"] >= 0, way["multiplier"] >= 0)
            v = [(self.low, self.high)[int(corner) >> axis & 1][axis] for axis in range(3)]
            e = [F(sign * (axis == k)) for axis in range(3)]
            beyond = proof.height(way["multiplier"], self.from_pivot(v), e, -dot(e, self.put(v)) - way["at"])
            self.prove(way["terms"], [beyond] if way["multiplier"] else [], box)
            self.farthest.setdefault((int(corner), k), {}).setdefault(way["above"], []).append(way["at"])
        self.require(all(len(self.farthest[corner, k]) == 2 for corner in range(8) for k in range(3)))

    def require(self, *conditions):
        if not all(conditions):
            raise ValueError("a claim about touches that is not so")

    def axis(self, row, count):
        self.require(row["above"] in (True, False), isinstance(row["above"], bool), row["axis"] in proof.AXES[:count])
        return proof.AXES.index(row["axis"])

    def from_pivot(self, v):
        return turned(self.said["quaternion"], sub(v, self.said["pivot"]))

    def put(self, v):
        moved = self.said["moved"]
        return plus(turned(moved["quaternion"], v), [moved[axis] for axis in "xyz"])

    def prove(self, terms, forms, box):
        key = str((terms, forms, box, self.balls, [self.points[int(t[0])] for t in terms], self.said["pivot"],
                   self.said["quaternion"]))
        if key not in self.proved:
            self.proved[key] = self.proves(terms, list(forms), box)
        self.require(self.proved[key])

    def proves(self, terms, forms, box):
        middle = [(low + high) / 2 for low, high in box]
        for touch, ball, m in terms:
            if not (is_number_below(touch, len(self.points)) and is_number_below(ball, len(self.balls)) and m >= 0 and
                    touch not in self.left_out):
                return False
            if not m:
                continue
            c, (a, least) = self.points[int(touch)], self.balls[int(ball)]
            p = self.from_pivot(a)
            length = F(math.dist(plus(turned([F(1)] + middle[3:], p), middle), c)) or F(1)
            level = (dot(p, p) / length + length) / 2 - least
            forms.append(proof.form(m, p, times(c, -1 / length), 1 / length, level, bend=length / 2))
        return bool(forms) and proof.largest(forms, box) <= 0

    def way(self, v, put):
        total = [F(0)] * 3
        for corner in range(8):
            share = F(1)
            for axis in range(3):
                part = (v[axis] - self.low[axis]) / (self.high[axis] - self.low[axis])
                share *= part if corner >> axis & 1 else 1 - part
            most = [max(max(ats) for ats in self.farthest[corner, k].values()) for k in range(3)]
            total = plus(total, times(most, share))
        off = sub(self.put(v), put)
        return decimal_root(dot(total, total)) + decimal_root(dot(off, off))

    def widths(self, nominal, blank):
        """Of the blank's triangles, which are those of the nominal mesh at their places."""
        self.require(len(nominal.kept) == len(blank.kept))
        places, ways = {}, {}
        for t, there in zip(nominal.kept, blank.kept):
            for v, put in zip(map(tuple, t), map(tuple, there)):
                self.require(places.setdefault(v, put) == put)
                ways[v] = ways.get(v) or self.way(list(v), list(put))
        form = exact.D(self.said["form"].numerator) / exact.D(self.said["form"].denominator)
        return [form + max(ways[tuple(v)] for v in t) for t in nominal.kept]
