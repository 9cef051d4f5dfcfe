"""What a profile program with common lines burns, by its text and the layout alone: whether all edges are cut, and
whether parts come loose only when little is left of their edges (docs/design/common-line.md).

The sheet is a picture of squares, each of which knows the moment at which it is burnt.
"""

import math

import cuts
from profile import Near

CELL = 0.15  # mm
LEFT = 1.5  # kerfs, of its edges, that a part may have left when it is loose


class Picture:
    def __init__(self, low, high, ways, half):
        self.low = [v - 3 for v in low]
        self.wide, self.tall = (math.ceil((high[i] + 3 - self.low[i]) / CELL) for i in (0, 1))
        self.burnt = {}
        moment, reach = 0, math.ceil(half / CELL) + 1
        for way in ways:
            for a in cuts.samples_of(way, CELL / 2):
                i, j = self.cell(a)
                for u in range(i - reach, i + reach + 1):
                    for v in range(j - reach, j + reach + 1):
                        p = (self.low[0] + (u + 0.5) * CELL, self.low[1] + (v + 0.5) * CELL)
                        if math.dist(p, a) <= half:
                            self.burnt.setdefault((u, v), moment)
                moment += 1
        self.moments = moment

    def cell(self, p):
        return tuple(int((p[i] - self.low[i]) // CELL) for i in (0, 1))

    def loose(self, places):
        """The moment from which on each place hangs together with neither the rim nor another; None where it does
        in the end."""
        up = {}
        rim = (-1, -1)

        def root(c):
            while up.setdefault(c, c) != c:
                up[c] = up[up[c]]
                c = up[c]
            return c

        there = set()

        def add(c):
            there.add(c)
            if not (0 < c[0] < self.wide - 1 and 0 < c[1] < self.tall - 1):
                up[root(c)] = root(rim)
            for other in ((c[0] + 1, c[1]), (c[0] - 1, c[1]), (c[0], c[1] + 1), (c[0], c[1] - 1)):
                if other in there:
                    up[root(c)] = root(other)

        by_moment = {}
        for i in range(self.wide):
            for j in range(self.tall):
                if (i, j) in self.burnt:
                    by_moment.setdefault(self.burnt[i, j], []).append((i, j))
                else:
                    add((i, j))
        cells = [self.cell(p) for p in places]
        ends = [root(c) for c in cells]
        found = [None] * len(cells)
        waiting = [k for k, end in enumerate(ends) if end != root(rim) and ends.count(end) == 1]
        for moment in sorted(by_moment, reverse=True):
            for c in by_moment[moment]:
                add(c)
            for k in [k for k in waiting if root(cells[k]) == root(rim)]:
                found[k] = moment
                waiting.remove(k)
        return found


class Judge(cuts.Judge):
    """Of rectangles without holes and marks."""

    def holds(self, made):
        seen = [self.geometry(cut) for cut in made]
        if any(cut.rapid or not one.get("clear") for cut, one in zip(made, seen)):
            return False
        ways = [one["whole"] for one in seen]
        near = Near([way + way[-2:0:-1] for way in ways])
        if any(near.off(p) > self.slack for contour in self.contours for p in contour.middles(self.half, 0.3)):
            return False
        low, high = ([pick(p[i] for way in ways for p in way) for i in (0, 1)] for pick in (min, max))
        picture = Picture(low, high, ways, self.half)
        places = [[sum(p[i] for p in part[0].ring) / len(part[0].ring) for i in (0, 1)] for part in self.parts]
        for part, loose in zip(self.parts, picture.loose(places)):
            if loose is None or self.left_of(part[0], picture, loose) > LEFT * 2 * self.half:
                return False
        return True

    @staticmethod
    def left_of(contour, picture, loose):
        """How much of the edges is burnt after a moment, as the squares just beside them are."""
        left = 0
        for a, b in contour.sides:
            size, out = math.dist(a, b), contour.waste * CELL
            step = ((b[0] - a[0]) / size, (b[1] - a[1]) / size)
            for k in range(1, int(size / CELL)):
                p = (a[0] + k * CELL * step[0] + out * step[1], a[1] + k * CELL * step[1] - out * step[0])
                left += CELL * (picture.burnt.get(picture.cell(p), picture.moments) > loose)
        return left


def program(stock, kerf):
    return cuts.judged_by(lambda layout, before: Judge(layout, stock, kerf), "common.py")
