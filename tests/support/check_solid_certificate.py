#!/usr/bin/env python3
"""Rechecks the leaves of a certificate for solids, written from docs/formats.md alone, for binary STL in mm:
    check_solid_certificate.py LIST     with four names a line: PART BLANK RESULT CERTIFICATE_FILE (or - for none)
Prints for each "proved", or what does not hold. Fractions throughout: every answer is exact, and slow."""
import json, math, struct, sys
from fractions import Fraction as F

AXES = ("x", "y", "z", "turn_x", "turn_y", "turn_z")
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def plus(a, b): return [x + y for x, y in zip(a, b)]
def sub(a, b): return [x - y for x, y in zip(a, b)]
def times(a, m): return [x * m for x in a]
def cross(a, b): return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
def normal(t): return cross(sub(t[1], t[0]), sub(t[2], t[0]))
def sign(x): return (x > 0) - (x < 0)
def read(path): return json.load(open(path), parse_float=F, parse_int=F)
def stl(path):
    data = open(path, "rb").read()
    rows = [struct.unpack_from("<12f", data, at)[3:] for at in range(84, len(data), 50)]
    return [[[F(x) for x in row[k:k + 3]] for k in (0, 3, 6)] for row in rows]
def product(a, b):  # of quaternions
    return [a[0] * b[0] - dot(a[1:], b[1:])] + plus(plus(times(b[1:], a[0]), times(a[1:], b[0])), cross(a[1:], b[1:]))
def turned(q, p): return times(product(product(q, [0] + p), q[:1] + times(q[1:], -1))[1:], 1 / dot(q, q))

def root(x, up=False):  # exactly, or to 40 places
    n = x.numerator * x.denominator * 10 ** 80
    r = math.isqrt(n)
    return F(r + (up and r * r != n), x.denominator * 10 ** 40)

def squared_distance(p, t):
    n = normal(t)
    if any(n) and all(dot(n, cross(sub(t[k - 2], t[k]), sub(p, t[k]))) >= 0 for k in range(3)):
        return dot(n, sub(p, t[0])) ** 2 / dot(n, n)
    ways = [(sub(p, t[k]), sub(t[k - 2], t[k])) for k in range(3)]
    ways = [sub(w, times(e, min(max(dot(w, e) / (dot(e, e) or F(1)), F(0)), F(1)))) for w, e in ways]
    return min(dot(w, w) for w in ways)

def inside(p, mesh):  # straight up from p, which counts as moved by a trifle along y and by less along x
    def turn(a, b):
        e, w = sub(b, a), sub(p, a)
        return sign(e[0] * w[1] - e[1] * w[0]) or sign(e[0]) or -sign(e[1])
    around = [(t, {turn(t[k], t[k - 2]) for k in range(3)}) for t in mesh]
    met = [t for t, sides in around if len(sides) == 1 and sides == {-sign(dot(normal(t), sub(p, t[0])))} != {0}]
    return len(met) % 2 == 1

def ball_holds(ball, mesh, wanted):
    least = min(squared_distance(ball[:3], t) for t in mesh)
    return least >= ball[3] ** 2 and (least == 0 or inside(ball[:3], mesh) == wanted)

def largest(forms, cell):
    # The largest Bernstein coefficient of sum m (1 + xx) (level + slope.t + bend uu + (R(x) p).u), u = at + turn t.
    values, ends = [], [([lo, (lo + hi) / 2, hi], [lo * lo, lo * hi, hi * hi]) for lo, hi in cell[3:]]
    for t in ([cell[k][n >> k & 1] for k in range(3)] for n in range(8)):
        c, linear, square, mixed = F(0), [F(0)] * 3, [F(0)] * 3, [F(0)] * 3
        for m, p, at, turn, level, slope, bend in forms:
            u = plus(at, times(t, turn))
            h, along = level + dot(slope, t) + bend * dot(u, u), dot(p, u)
            c += m * (h + along)
            linear = plus(linear, times(cross(p, u), 2 * m))
            square = plus(square, [m * (h - along + 2 * p[k] * u[k]) for k in range(3)])
            mixed = plus(mixed, [2 * m * (p[k - 2] * u[k - 1] + p[k - 1] * u[k - 2]) for k in range(3)])
        for n in range(27):
            x, xx = [[ends[k][one][n // 3 ** k % 3] for k in range(3)] for one in (0, 1)]
            values.append(c + dot(linear, x) + dot(square, xx) + dot(mixed, [x[k - 2] * x[k - 1] for k in range(3)]))
    return max(values)

def wrong_with(leaf, cell, q, c, beta, part, blank, holds=ball_holds):
    none, forms, middle = [F(0)] * 3, [], [(lo + hi) / 2 for lo, hi in cell]
    def turn_there(v): return turned([F(1)] + middle[3:], turned(q, v))
    def place_there(v): return plus(turn_there(sub(v, c["pivot"])), middle)
    for kind, i, j, m in ((kind, int(i), int(j), m) for kind, i, j, m in leaf if m > 0):
        a = c["part_balls"][i] if kind != "part_face" else None
        b = c["blank_balls"][j] if kind in ("ball", "part_face") else None
        if a and not holds(a, part, True): return f"part ball {i}"
        if b and not holds(b, blank, False): return f"blank ball {j}"
        p = a and turned(q, sub(a[:3], c["pivot"]))
        if a and b:
            w = sub(place_there(a[:3]), b[:3])
            l = F(math.sqrt(dot(w, w))) or F(1)
            if beta < -b[3]: return "the bound is below a ball's depth"
            level = (dot(p, p) / l + l) / 2 - a[3] - b[3] - beta
            forms.append((m, p, times(b[:3], -1 / l), 1 / l, level, none, l / 2))
        elif kind == "plane":
            n, least = c["planes"][j][:3], c["planes"][j][3]
            if not any(n) or any(dot(n, v) < least for t in blank for v in t): return f"plane {j}"
            nu = root(dot(n, n), a[3] + beta < 0)
            n = times(n, 1 / nu)
            forms.append((m, p, n, F(0), -least / nu - a[3] - beta, n, F(0)))
        else:
            t, ball = (blank[j], a) if a else (part[i], b)
            n = normal(t)
            if not any(n) or beta < 0: return "a face that bounds nothing"
            feet = [(cross(n, sub(t[k - 2], t[k])), t[k]) for k in range(3)]
            above = dot(n, sub(place_there(a[:3]), t[0])) if a else dot(turn_there(n), sub(b[:3], place_there(t[0])))
            n = times(n, (1 if above >= 0 else -1) / root(dot(n, n)))
            def form(v, more, weight=F(1)):  # v.(T a) + more, or v.(T^-1 b) + more
                if a: return weight, p, v, F(0), more, v, F(0)
                return weight, turned(q, v), b[:3], F(-1), more + dot(v, c["pivot"]), none, F(0)
            forms.append(form(n, -dot(n, t[0]) - ball[3] - beta, m))
            conditions = [form(times(n, -1), dot(n, t[0]) - ball[3])] + [form(times(e, -1), dot(e, v)) for e, v in feet]
            if any(largest([one], cell) > 0 for one in conditions): return "a face that it may leave"
    return None if largest(forms, cell) <= 0 else "a leaf proves too little"

def check(part, blank, result, certificate):
    part, blank, r = stl(part), stl(blank), read(result)
    c = r["certificate"] or read(certificate)["certificate"]
    for tree in c["trees"]:
        open_ = [[tree[k] for k in AXES]]
        for node in tree["nodes"]:
            cell = open_.pop()
            if isinstance(node[0], str):
                k = AXES.index(node[0])
                if not cell[k][0] <= node[1] <= cell[k][1]: return "a split beside its box"
                open_ += [cell[:k] + [half] + cell[k + 1:] for half in ([node[1], cell[k][1]], [cell[k][0], node[1]])]
            elif wrong := wrong_with(node, cell, tree["quaternion"], c, r["upper_bound"], part, blank): return wrong
        if open_: return "the tree ends early"
    return "proved"

if __name__ == "__main__":
    for line in open(sys.argv[1]): print(check(*line.split()), flush=True)
