"""Clearances and bounds of placements with 60 digits, from the formulas of docs/formats.md."""

import decimal
import re
from decimal import Decimal as D
from fractions import Fraction

decimal.getcontext().prec = 60
PI = D("3.14159265358979323846264338327950288419716939937510582097494459")


def number(value):
    """A number of a document as the decimal that is written."""
    return D(repr(value)) if isinstance(value, float) else D(value)


def turn(theta):
    """(cos, sin) of an angle, by their series."""
    theta = number(theta) % (2 * PI)
    cosine, sine, term, k = D(0), D(0), D(1), 0
    while abs(term) > D("1e-58"):
        cosine += term * (1, 0, -1, 0)[k % 4]
        sine += term * (0, 1, 0, -1)[k % 4]
        k += 1
        term = term * theta / k
    return cosine, sine


def points_of(text):
    """The points of a CSV, one a line."""
    rows = (re.fullmatch(r"\s*(-?[\d.]+(?:e-?\d+)?)[\s,]+(-?[\d.]+(?:e-?\d+)?)\s*", line)
            for line in text.splitlines())
    return [(D(row[1]), D(row[2])) for row in rows if row]


def placed(points, x, y, theta, mirrored=False):
    c, s = turn(theta)
    x, y = number(x), number(y)
    sign = -1 if mirrored else 1
    return [(c * sign * px - s * py + x, s * sign * px + c * py + y) for px, py in points]


def edges(points):
    """Origin and inward unit normal of every edge that has a length."""
    area = sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1]))
    made = []
    for a, b in zip(points, points[1:] + points[:1]):
        dx, dy = b[0] - a[0], b[1] - a[1]
        length = (dx * dx + dy * dy).sqrt()
        if length == 0:
            made.append(None)
            continue
        sign = 1 if area > 0 else -1
        made.append((a, (-sign * dy / length, sign * dx / length)))
    return made


def is_convex(points, slack=D(0)):
    """No corner is turned the other way, but for dents of at most `slack`."""
    turns = set()
    n = len(points)
    for k in range(n):
        a, b, c = points[k], points[(k + 1) % n], points[(k + 2) % n]
        cross = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
        if abs(cross) > slack * ((c[0] - a[0]) ** 2 + (c[1] - a[1]) ** 2).sqrt():
            turns.add(cross > 0)
    return len(turns) == 1


def convex_clearance(part, blank, pose):
    """The least distance of a placed point of the part from the line of a side of the blank, inwards."""
    there = placed(part, *pose)
    return min(n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1])
               for a, n in filter(None, edges(blank)) for p in there)


def balance(sides):
    """The weights with which three normals sum to nothing, 1 together; None where they are parallel, or one weighs less
    than nothing by more than a rounding of parallel sides can make."""
    normals = [n for _, n in sides]
    cross = lambda u, v: u[0] * v[1] - u[1] * v[0]
    weights = [cross(normals[1], normals[2]), cross(normals[2], normals[0]), cross(normals[0], normals[1])]
    whole = sum(weights)
    if whole == 0 or any(w / whole < D("-1e-6") for w in weights):
        return None
    return [w / whole for w in weights]


def interval_bound(part, sides, interval):
    """The largest K + A cos + B sin over an interval of a certificate, or None where its edges bound nothing."""
    try:
        chosen = [sides[c["blank_edge"]] for c in interval["contacts"]]
        corners = [part[c["part_vertex"]] for c in interval["contacts"]]
    except (IndexError, TypeError, KeyError):
        return None
    if len(chosen) != 3 or None in chosen or min(c[k] for c in interval["contacts"]
                                                 for k in ("blank_edge", "part_vertex")) < 0:
        return None
    weights = balance(chosen)
    if weights is None:
        return None
    if any(abs(number(c["multiplier"]) - w) > D("1e-6") for c, w in zip(interval["contacts"], weights)):
        return None
    # Of two opposite sides one may be turned by a last place. Then the third, which weighs nothing, may be on the wrong
    # side of them; another one in its stead makes a bound that is as good.
    light = min(range(3), key=lambda j: weights[j])
    if weights[light] < 0:
        others = [chosen[:light] + [side] + chosen[light + 1:] for side in sides if side]
        chosen, weights = next(((three, w) for three, w in ((three, balance(three)) for three in others)
                                if w and min(w) >= 0), (None, None))
        if weights is None:
            return None
    k = a = b = D(0)
    for m, (origin, n), v in zip(weights, chosen, corners):
        k -= m * (n[0] * origin[0] + n[1] * origin[1])
        a += m * (n[0] * v[0] + n[1] * v[1])
        b += m * (n[1] * v[0] - n[0] * v[1])
    low, high = number(interval["from"]), number(interval["to"])
    if low > high:
        return None
    (cl, sl), (ch, sh) = turn(low), turn(high)
    crest = (a * a + b * b).sqrt()
    if high - low > 3 or (b * cl - a * sl > 0 and b * ch - a * sh < 0):
        return k + crest
    return k + max(a * cl + b * sl, a * ch + b * sh)


def certificate_proves(intervals, part, blank, window_deg, bound):
    """Every interval is bounded by `bound`, and together they cover the window without a hole."""
    sides = edges(blank)
    reach = None
    begin, end = (number(w) * PI / 180 for w in window_deg)
    last = None
    for interval in intervals:
        value = interval_bound(part, sides, interval)
        if value is None or value > number(bound):
            return False
        low, high = number(interval["from"]), number(interval["to"])
        if reach is None:
            first = low
        elif low > reach or low < last:
            return False
        last = low
        reach = high if reach is None else max(reach, high)
    if reach is None:
        return False
    if end - begin >= 2 * PI - D("1e-50"):
        return reach - first >= 2 * PI
    return first <= begin and reach >= end


def near(value, exact, share, of):
    """A derived number is within a share of the numbers that it comes from."""
    return abs(number(value) - exact) <= D(share) * max(map(abs, of))


def fraction(value):
    return Fraction(repr(value)) if isinstance(value, float) else Fraction(value)


def to_segment(p, a, b):
    ux, uy = b[0] - a[0], b[1] - a[1]
    square = ux * ux + uy * uy
    t = ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / square if square else D(0)
    t = min(max(t, D(0)), D(1))
    return ((p[0] - a[0] - t * ux) ** 2 + (p[1] - a[1] - t * uy) ** 2).sqrt()


def is_in(p, polygon, slack):
    """A point is in a polygon, or within `slack` of its outline."""
    inside = False
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        if slack and to_segment(p, a, b) <= slack:
            return True
        if (a[1] > p[1]) != (b[1] > p[1]):
            x = a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
            if x > p[0]:
                inside = not inside
    return inside
