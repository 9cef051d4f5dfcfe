#!/usr/bin/env python3
"""Rechecks a result of `lekalo locate`, written from docs/formats.md alone, for convex contours in .json (a list of
points), .csv, .txt or .xyz without header:   recheck.py RESULT PART BLANK [CERTIFICATE]
Prints the clearance, the largest bound and what does not hold. 80 digits, no directed rounding."""
import json, sys
from decimal import Decimal as D, getcontext

getcontext().prec = 80
EPSILON = D("1e-45")


def series(x, term, k):
    total = D(0)
    while abs(term) > D("1e-78"):
        total, term, k = total + term, -term * x * x / ((k + 1) * (k + 2)), k + 2
    return total


def sin(x): return series(x, x, 1)
def cos(x): return series(x, D(1), 0)
def arctan_of_inverse(n): return sum((-1) ** k / D((2 * k + 1) * n ** (2 * k + 1)) for k in range(60))
def cross(a, b): return a[0] * b[1] - a[1] * b[0]
def dot(a, b): return a[0] * b[0] + a[1] * b[1]
def sub(a, b): return (a[0] - b[0], a[1] - b[1])
def read(path): return json.loads(open(path).read(), parse_float=D, parse_int=D)


def points(path, unit):
    rows = read(path) if path.endswith(".json") else [
        [D(word) for word in line.replace(",", " ").replace(";", " ").split()] for line in open(path) if line.strip()]
    return [tuple(value * (D("25.4") if unit == "inch" else 1) for value in row[:2]) for row in rows]


def bound(interval, part, edge):
    contacts = [(part[int(c["part_vertex"])], *edge[int(c["blank_edge"])]) for c in interval["contacts"]]
    e = [direction for _, _, direction in contacts]
    m = [cross(e[1], e[2]), cross(e[2], e[0]), cross(e[0], e[1])]
    if min(m) < 0 < max(m) or not any(m):
        return D("inf")
    m = [abs(x) / sum(abs(y) * dot(f, f).sqrt() for y, f in zip(m, e)) for x in m]
    k = -sum(x * cross(d, a) for x, (_, a, d) in zip(m, contacts))
    a = sum(x * cross(d, v) for x, (v, _, d) in zip(m, contacts))
    b = sum(x * dot(d, v) for x, (v, _, d) in zip(m, contacts))
    f, t = interval["from"], interval["to"]
    crest_inside = b * cos(f) - a * sin(f) >= 0 >= b * cos(t) - a * sin(t)
    ends = max(a * cos(f) + b * sin(f), a * cos(t) + b * sin(t))
    return k + ((a * a + b * b).sqrt() if t - f > 3 or crest_inside else ends)


def main(result, part, blank, certificate=None):
    r, wrong = read(result), []
    given = {item["role"]: item for item in r["inputs"]}
    part, blank = points(part, given["part"]["units"]), points(blank, given["blank"]["units"])
    kept = [k for k in range(len(blank)) if k not in given["blank"]["dropped"]]
    if r["trim"]:
        blank = [tuple(p) for p in r["trim"]["contour"]]
        kept = list(range(len(blank)))
    area = sum(cross(blank[k - 1], blank[k]) for k in range(len(blank)))
    edge = {}
    for k, following in zip(kept, kept[1:] + kept[:1]):
        a, b = (blank[k], blank[following]) if area > 0 else (blank[following], blank[k])
        edge[k] = (a, sub(b, a))

    c, s = cos(r["theta"]), sin(r["theta"])
    placed = [(c * x - s * y + r["x"], s * x + c * y + r["y"]) for x, y in part]
    clearance = min(cross(e, sub(p, a)) / dot(e, e).sqrt() for a, e in edge.values() for p in placed)
    if r["clearance"] > clearance + EPSILON:
        wrong.append(f"clearance {r['clearance']} > {clearance}")

    intervals = r["certificate"] or (read(certificate)["intervals"] if certificate else [])
    largest = max((bound(i, part, edge) for i in intervals), default=None)
    if intervals:
        if largest > r["upper_bound"] + EPSILON:
            wrong.append(f"upper_bound {r['upper_bound']} < {largest}")
        for one, two in zip(intervals, intervals[1:]):
            if two["from"] > one["to"] or one["from"] > one["to"]:
                wrong.append(f"hole or disorder at {one['to']}")
        pi = 16 * arctan_of_inverse(5) - 4 * arctan_of_inverse(239)
        low, high = (degrees * pi / 180 for degrees in r["window_deg"])
        first, last = intervals[0]["from"], intervals[-1]["to"]
        if last - first < 2 * pi if high - low >= 2 * pi else (first > low or last < high):
            wrong.append("the window is not covered")
    print(json.dumps({"clearance": str(clearance), "bound": str(largest), "wrong": wrong}))


main(*sys.argv[1:])
