#!/usr/bin/env python3
"""Rechecks the leaves of a certificate for solids, written from docs/formats.md alone, for binary STL in mm:
    check_solid_certificate.py LIST     with five names a line: PART BLANK RESULT CERTIFICATE_FILE FEATURES (or -)
Prints for each "proved", or what does not hold. Fractions throughout: every answer is exact, and slow."""
import json, math, sys
from exact_bodies import fault_of_body, sides
from exact_forms import form, height, largest
from exact_solids import F, ball_holds, cross, dot, normal, plus, root, stl, sub, times, turned
from solid_demands import datums, demands, maxima, straight_off

def read(path): return json.load(open(path), parse_float=F, parse_int=F)
AXES = ("x", "y", "z", "turn_x", "turn_y", "turn_z")

def plane_holds(plane, mesh):
    *n, least = plane
    return any(n) and all(dot(n, v) >= least for v in {tuple(v) for t in mesh for v in t})

def wrong_with(leaf, cell, q, c, bounds, part, blank, held=(), within=None, holds=ball_holds, fault=fault_of_body,
               bounds_all=plane_holds):  # with a bound for each triangle of the part
    forms, middle = [], [(lo + hi) / 2 for lo, hi in cell]
    def from_pivot(v): return turned(q, sub(v, c["pivot"]))
    def turn_there(v): return turned([F(1)] + middle[3:], turned(q, v))
    def place_there(v): return plus(turn_there(sub(v, c["pivot"])), middle)
    terms = [(kind, int(i), int(j), m) for kind, i, j, m in leaf if m > 0]
    for kind, i, j, m in terms:
        if kind == "datum":
            d, k = c["datum_points"][i]
            if d != int(d) or not 0 <= d < len(held) or k not in held[int(d)]["points"]: return f"datum point {i}"
            u = straight_off(datum := held[int(d)], c["directions"][j])
            if not any(u): return f"direction {j}"
            room = datum["within"] * root(dot(u, u), True) + dot(u, datum["through"])
            forms.append(height(m, from_pivot(datum["points"][k]), times(u, -1), room))
            continue
        a = c["part_balls"][i] if kind in ("ball", "plane", "face") else None
        b = c["blank_balls"][j] if kind in ("ball", "part_face", "point") else None
        if a and not holds(a, part, True): return f"part ball {i}"
        if b and not holds(b, blank, False): return f"blank ball {j}"
        f = {"part_face": i, "edges": i // 3}.get(kind)
        if kind.startswith("point") or kind == "near":
            f, x, y = c["part_points"][i]
            if f != int(f) or not 0 <= f < len(part) or x < 0 or y < 0 or x + y > 1: return f"part point {i}"
            t = part[int(f)]
            a = plus(t[0], plus(times(sub(t[1], t[0]), x), times(sub(t[2], t[0]), y))) + [F(0)]
        if kind == "near":
            body, most = c["bodies"][j // 6], within and within[int(f)]
            if most is None or body[12] < most or fault(body, blank): return f"body {j // 6}"
            out = [height(m, from_pivot(a[:3]), times(n, -1), least) for n, least in sides(body)]
            forms.append(out.pop(j % 6))
            if any(largest([one], cell) >= 0 for one in out): return "a body that it may leave"
            continue
        if None in (bounds if f is None else [bounds[int(f)]]): return "something that is as cast"
        beta = min(bounds) if f is None else bounds[int(f)]
        kind = kind.removeprefix("point_")
        if beta < (-b[3] if kind == "ball" else beta if kind in ("plane", "point") else 0): return "a bound that is too low"
        p = a and from_pivot(a[:3])
        if kind in ("ball", "point"):
            l = F(math.dist(place_there(a[:3]), b[:3])) or F(1)
            level = (dot(p, p) / l + l) / 2 - a[3] - b[3] - beta
            forms.append(form(m, p, times(b[:3], -1 / l), 1 / l, level, bend=l / 2))
        elif kind == "plane":
            *n, least = c["planes"][j]
            if not bounds_all(c["planes"][j], blank): return f"plane {j}"
            nu = root(dot(n, n), a[3] + beta < 0)
            forms.append(height(m, p, times(n, 1 / nu), -least / nu - a[3] - beta))
        elif kind == "edges":
            (a, b), (o, e) = ([mesh[k // 3][(k + end) % 3] for end in (0, 1)] for mesh, k in ((part, i), (blank, j)))
            n = cross(turn_there(sub(b, a)), sub(e, o))
            if not any(n): return "edges that are parallel"
            if dot(n, sub(place_there(a), o)) < 0: o, e, n = e, o, times(n, -1)
            g, angle = sub(e, o), F(math.sqrt(dot(n, n)))
            u = times(n, (1 - F(1, 2 ** 50)) / angle)
            a, b, d, s = from_pivot(a), from_pivot(b), turned(q, sub(b, a)), cross(g, u)
            def passing(m, g, o): return [form(m, cross(a, d), g), form(m, d, cross(o, g), around=g)]
            below = [[height(F(1), a, s, -dot(s, o))], [height(F(-1), b, s, -dot(s, o))]]  # passing: m (d x g).(T a - o)
            below += [passing(F(1), u, o), passing(F(-1), u, e), passing(F(-1), g, o)]
            if any(largest(one, cell) >= 0 for one in below): return "edges that may not pass"
            forms += passing(m / angle, g, plus(o, times(u, beta)))
        else:
            t, ball = (blank[j], a) if a else (part[i], b)
            n = normal(t)
            if not any(n): return "a face that bounds nothing"
            feet = [(cross(n, sub(t[k - 2], t[k])), t[k]) for k in range(3)]
            above = dot(n, sub(place_there(a[:3]), t[0])) if a else dot(turn_there(n), sub(b[:3], place_there(t[0])))
            n = times(n, (1 if above >= 0 else -1) / root(dot(n, n)))
            def over(v, more, weight=F(1)):  # v.(T a) + more, or v.(T^-1 b) + more
                if a: return height(weight, p, v, more)
                return form(weight, turned(q, v), b[:3], F(-1), more + dot(v, c["pivot"]))
            forms.append(over(n, -dot(n, t[0]) - ball[3] - beta, m))
            conditions = [over(times(n, -1), dot(n, t[0]) - ball[3])] + [over(times(e, -1), dot(e, v)) for e, v in feet]
            if any(largest([one], cell) > 0 for one in conditions): return "a face that it may leave"
    most = largest(forms, cell)  # terms of datums and bodies are not below 0, and all others are above 0
    return None if most < 0 or most == 0 and any(t[0] not in ("datum", "near") for t in terms) else "a leaf proves too little"

def check(part, blank, result, certificate, features):
    part, blank, r = stl(part), stl(blank), read(result)
    c = r["certificate"] or read(certificate)["certificate"]
    bounds, held, within, known = [r["upper_bound"]] * len(part), [], None, {}
    def once(what, row, *more):  # of a ball and whose it is, or of a plane
        if (key := (*row, *more[1:])) not in known: known[key] = what(row, *more)
        return known[key]
    if r.get("demands"):
        held, of = datums(read(features), part), demands(read(features), part, r["min_allowance"])
        within = maxima(read(features), part)
        bounds = [one and one[0] + one[1] * r["demands"]["margin_bound"] for one in of]
    for tree in c["trees"]:
        open_ = [[tree[k] for k in AXES]]
        for node in tree["nodes"]:
            cell = open_.pop()
            if isinstance(node[0], str):
                k = AXES.index(node[0])
                if not cell[k][0] <= node[1] <= cell[k][1]: return "a split beside its box"
                open_ += [cell[:k] + [half] + cell[k + 1:] for half in ([node[1], cell[k][1]], [cell[k][0], node[1]])]
            elif wrong := wrong_with(node, cell, tree["quaternion"], c, bounds, part, blank, held, within,
                                     lambda *ball: once(ball_holds, *ball), bounds_all=lambda *plane: once(plane_holds, *plane)): return wrong
        if open_: return "the tree ends early"
    return "proved"

if __name__ == "__main__":
    for line in open(sys.argv[1]): print(check(*line.split()), flush=True)
