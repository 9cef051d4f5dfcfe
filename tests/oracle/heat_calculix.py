#!/usr/bin/env python3
"""Results of `lekalo heat` against CalculiX, which follows the same cuts on a mesh and in steps that are made here.

    heat_calculix.py LEKALO HEAT_CUTS CCX [--only REGEX] [--table] [--keep FOLDER]

The source alone is the same: HEAT_CUTS says where and when a program cuts, and what work that is. All else is made
anew: hexahedra whose borders are the pocket's walls and levels and that grow outwards, elements that go away (*MODEL
CHANGE) once the tool has been over their middles, heat that enters nodes about the rim, films on what is open, one
implicit step of the heat for each stretch of the path, and the displacement by elements with incompatible modes. The
error of a place is what its displacement was when the tool was beside it, the largest of all such times. Each has to
agree to 10 % or 1 um, but for one of 200, which has to agree to 15 % or 1.5 um: where what the tool takes changes from
one millimetre to the next, the two differ a little more (docs/measurements/heat-walls.md). The shallow pocket is solved on a second, finer mesh, and both meshes have to agree as well.

Without LEKALO_FULL only some places of the shallow pocket are solved, on its coarse mesh. --table prints the figures as
Markdown.
"""

import argparse
import bisect
import concurrent.futures
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

WITHIN, WITHIN_UM = 0.10, 1.0
RARELY, SO_MUCH_MORE = 1 / 200, 1.5
AS_NEAR, ONE_VISIT = 0.03, 0.2  # mm, s: passes that are as near as each other, and that are one
SHORT, BEFORE_A_VISIT = 0.1, 0.3  # s
TOOL, TEETH, RPM = 6, 3, 8000
ALIKE = 1e-9


def ring(low, high):
    return [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]), (low[0], low[1])]


def lanes():
    return [(26.5 if (k + turn) % 2 else 3.5, 3.5 + 13 / 3 * k) for k in range(4) for turn in range(2)]


# Each: size of the stock, pocket, its islands, levels, ways on each level (roughing, then the walls), feed, words.
# So much heat goes in that errors are well above what they may differ by.
ALUMINIUM = ["--material", "6061-T6", "--share", "1", "--wear", "1.5", "--cooling", "100"]
CASES = {
    "shallow": dict(stock=(60, 50, 16), pocket=(30, 20), islands=[], levels=[-4], feed=500,
                    ways=[lanes(), ring((3, 3), (27, 17))], words=ALUMINIUM, voxel=2, mesh=1.34, step=0.6),
    "island": dict(stock=(70, 60, 16), pocket=(44, 34), islands=[((16, 12), (28, 22))], levels=[-4], feed=600,
                   ways=[ring((3.5, 3.5), (40.5, 30.5)), ring((8, 6), (36, 28)), ring((12.5, 8.5), (31.5, 25.5)),
                         ring((3, 3), (41, 31)), ring((13, 9), (31, 25))],
                   words=ALUMINIUM, voxel=1, mesh=1.6, step=0.6),
    "deep": dict(stock=(60, 50, 20), pocket=(30, 20), islands=[], levels=[-4, -8, -12], feed=500,
                 ways=[lanes(), ring((3, 3), (27, 17))], words=ALUMINIUM + ["--hold", "plate"], voxel=1, mesh=1.34,
                 step=0.6),
    # In steel heat gets only the diffusivity by the feed ahead of the tool, 3 mm here, and both have to be finer.
    "steel": dict(stock=(36, 32, 10), pocket=(18, 14), islands=[], levels=[-2], feed=240,
                  ways=[ring((4, 4), (14, 10)), ring((3, 3), (15, 11))],
                  words=["--material", "C45", "--share", "1", "--wear", "1.5", "--cooling", "200"], voxel=1, mesh=0.8,
                  step=0.3),
}


def program_of(case):
    lines = ["G21 G90 G17 G94 G54"]
    for level in case["levels"]:
        for way in case["ways"]:
            lines += [f"G0 Z5\nG0 X{way[0][0]:.4f} Y{way[0][1]:.4f}\nG1 Z{level} F200\nG1 F{case['feed']}"]
            lines += [f"G1 X{x:.4f} Y{y:.4f}" for x, y in way[1:]]
    return "\n".join(lines) + "\nG0 Z5\nM2\n"


def pocket_of(case):
    line = lambda a, b: {"line": {"from": list(a), "to": list(b)}}
    around = lambda corners: [line(a, b) for a, b in zip(corners, corners[1:])]
    holes = [around(ring(low, high)[::-1]) for low, high in case["islands"]]
    outer = around(ring((0, 0), case["pocket"]))
    return json.dumps(dict({"units": "mm", "outer": outer}, **({"holes": holes} if holes else {})))


def fine_at(marks, size):
    """Places from the least mark to the greatest, through all of them, whose steps grow from each mark to the middle
    between two."""
    places = [marks[0]]
    for a, b in zip(marks, marks[1:]):
        half = growing(a, (a + b) / 2, size)
        places += half + [a + b - p for p in half[-2::-1]] + [b]
    return places


def growing(start, end, size):
    """Places from start (left out) to end, each step a third longer than the one before, up to three times `size`."""
    length, steps = abs(end - start), []
    while sum(steps) < length - ALIKE:
        steps.append(min((steps[-1] if steps else size) * 4 / 3, 3 * size))
    places, at = [], 0.0
    for step in steps:
        at += step * length / sum(steps)
        places.append(start + math.copysign(at, end - start))
    return places[:-1] + [end]


class Mesh:
    def __init__(self, case, source, size):
        low, high = source["low"], source["high"]
        marks = [sorted({0.0, float(case["pocket"][a])} | {float(c[a]) for i in case["islands"] for c in i})
                 for a in (0, 1)] + [sorted({0.0} | {float(z) for z in case["levels"]})]
        self.at = []
        for axis in range(3):
            inner = fine_at(marks[axis], size)
            below = growing(inner[0], low[axis], size)[::-1]
            above = growing(inner[-1], high[axis], size) if high[axis] > inner[-1] + ALIKE else []
            self.at.append(below + inner + above)
        self.n = [len(a) - 1 for a in self.at]
        n = self.n
        self.elements = n[0] * n[1] * n[2]
        self.nodes = [(x, y, z) for z in self.at[2] for y in self.at[1] for x in self.at[0]]
        self.size = size

    def element(self, i, j, k):
        return (k * self.n[1] + j) * self.n[0] + i

    def triple(self, e):
        return e % self.n[0], e // self.n[0] % self.n[1], e // (self.n[0] * self.n[1])

    def corners(self, e):
        """In CalculiX' order."""
        i, j, k = self.triple(e)
        node = lambda a, b, c: ((k + c) * (self.n[1] + 1) + j + b) * (self.n[0] + 1) + i + a
        return [node(a, b, c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]

    def neighbours(self, e):
        """(number of the face, element or None beyond it); 1 below, 2 above, 3 and 5 along Y, 6 and 4 along X."""
        at, found = self.triple(e), []
        for axis, side, face in ((2, -1, 1), (2, 1, 2), (1, -1, 3), (0, 1, 4), (1, 1, 5), (0, -1, 6)):
            to = list(at)
            to[axis] += side
            found.append((face, self.element(*to) if 0 <= to[axis] < self.n[axis] else None))
        return found

    def middle(self, e):
        return [(self.at[a][t] + self.at[a][t + 1]) / 2 for a, t in enumerate(self.triple(e))]

    def find(self, place):
        """The element of a place and where it lies in it, from 0 to 1 along each axis; nothing outside of the stock."""
        at, within = [], []
        for axis, p in enumerate(place):
            places = self.at[axis]
            if not places[0] - ALIKE <= p <= places[-1] + ALIKE:
                return None
            t = min(max(bisect.bisect_right(places, p) - 1, 0), len(places) - 2)
            at.append(t), within.append((p - places[t]) / (places[t + 1] - places[t]))
        return self.element(*at), within

    def shares(self, e, within):
        """(node, its share at a place of the element)."""
        x, y, z = within
        weights = [(1 - x, 1 - y, 1 - z), (x, 1 - y, 1 - z), (x, y, 1 - z), (1 - x, y, 1 - z), (1 - x, 1 - y, z),
                   (x, 1 - y, z), (x, y, z), (1 - x, y, z)]
        return [(n, a * b * c) for n, (a, b, c) in zip(self.corners(e), weights)]


def distance(piece, x, y):
    (ax, ay, _), (bx, by, _) = piece[2], piece[3]
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    t = min(max(((x - ax) * dx + (y - ay) * dy) / square, 0), 1) if square > 0 else 0
    return math.hypot(x - ax - t * dx, y - ay - t * dy)


def listed(numbers):
    return "\n".join(", ".join(str(n + 1) for n in numbers[i:i + 12]) for i in range(0, len(numbers), 12))


class Oracle:
    def __init__(self, case, source, result, size, step):
        self.source, self.result = source, result
        self.mesh = Mesh(case, source, size)
        middle = lambda name: sum(result["material"][name]) / 2
        self.conductivity = middle("conductivity_w_mk") * 1e-3
        self.capacity = middle("density_kg_m3") * middle("heat_capacity_j_kgk") * 1e-9
        self.elastic = middle("youngs_mpa"), middle("poisson"), middle("expansion_per_k")
        self.share, self.film = middle("share"), sum(result["film_w_m2k"]) / 2 * 1e-6
        self.held = result["holding"]["kind"] == "plate"
        self.places = [(w["at_mm"], w["outward"]) for w in result["walls"]]
        self.visits = [self.visits_of(*place) for place in self.places]
        self.spans = self.divide(step)
        self.removed, self.active = self.bodies()
        self.lost = 0.0

    def divide(self, step):
        """Times at which steps end, none of which cuts a piece of the path in two. Where a place is visited, and shortly
        before, they are short: what is a few millimetres from the tool follows it within a tenth of a second."""
        ends, visits = [], sorted({t for visits in self.visits for t in visits})
        for p in self.source["pieces"]:
            begin, end = ends[-1] if ends else 0, p[0] + p[1]
            soon = bisect.bisect_left(visits, begin)
            is_near = soon < len(visits) and visits[soon] <= end + BEFORE_A_VISIT
            if end - begin >= (SHORT if is_near else step):
                ends.append(end)
        if not ends or self.source["seconds"] > ends[-1] + 1e-6:
            ends.append(self.source["seconds"])
        return ends

    def span_of(self, at):
        return min(bisect.bisect_left(self.spans, at), len(self.spans) - 1)

    def bodies(self):
        """What goes away at the end of each step, and what is left after it: elements whose middle was under the tool,
        and those that hang on no face of others."""
        mesh, here = self.mesh, [True] * self.mesh.elements
        of_layer = {}
        for e in range(mesh.elements):
            x, y, z = mesh.middle(e)
            of_layer.setdefault(z, []).append((e, x, y))
        removed, after = [[] for _ in self.spans], []
        swept = [[] for _ in self.spans]
        for p in self.source["pieces"]:
            if min(p[2][2], p[3][2]) < 0:
                swept[self.span_of(p[0] + p[1] / 2)].append(p)
        for k, pieces in enumerate(swept):
            for p in pieces:
                for z, row in of_layer.items():
                    if z > min(p[2][2], p[3][2]):
                        for e, x, y in row:
                            if here[e] and abs(x - p[2][0]) < 2 * TOOL and distance(p, x, y) < TOOL / 2:
                                here[e] = False
                                removed[k].append(e)
            seen, wait = {0}, [0]  # the first element is a corner of the underside
            while wait:
                for _, other in mesh.neighbours(wait.pop()):
                    if other is not None and here[other] and other not in seen:
                        seen.add(other), wait.append(other)
            for e in range(mesh.elements):
                if here[e] and e not in seen:
                    here[e] = False
                    removed[k].append(e)
            after.append(list(here))
        return removed, after

    def body(self, k):
        """During the step k."""
        return self.active[k - 1] if k > 0 else [True] * self.mesh.elements

    def visits_of(self, at, _):
        """Times at which the tool is beside a place, at its nearest of each pass that is as near as any."""
        deep = [(distance(p, at[0], at[1]), p) for p in self.source["pieces"]
                if p[4] and max(p[2][2], p[3][2]) <= at[2] + 1e-6]
        nearest = min(d for d, _ in deep)
        visits, best, ended = [], 0.0, -1.0
        for d, p in deep:
            if d > nearest + AS_NEAR:
                continue
            if not visits or p[0] > ended + ONE_VISIT:
                visits.append(p[0] + p[1] / 2)
                best = d
            elif d < best:
                visits[-1], best = p[0] + p[1] / 2, d
            ended = p[0] + p[1]
        return visits

    def heat_of(self, k, cuts):
        """Watts of each node during a step."""
        mesh, body, watts = self.mesh, self.body(k), {}
        seconds = self.spans[k] - (self.spans[k - 1] if k > 0 else 0)

        def enter(place, way, joules):
            for n in range(9):
                found = mesh.find([p + w * (n * mesh.size / 4 + 1e-6) for p, w in zip(place, way)])
                if found and body[found[0]]:
                    for node, share in mesh.shares(*found):
                        watts[node] = watts.get(node, 0) + share * joules / seconds
                    return True
            return False

        for _, _, a, b, floor, low, high, begin, end, work in cuts:
            x, y, joules = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, work * self.share
            if floor:
                places = [((x + r * math.cos(t), y + r * math.sin(t), low), (0, 0, -1))
                          for r in (TOOL / 6, TOOL / 3, TOOL / 2.2) for t in (math.pi / 6 * i for i in range(12))]
                weights = [r / 12 for r in (1, 2, 3) for _ in range(12)]
                weights = [w / sum(weights) for w in weights]
            else:
                around = max(1, math.ceil((end - begin) * TOOL / mesh.size))
                up = max(1, math.ceil(2 * (high - low) / mesh.size))
                places = []
                for i in range(around):
                    c, s = (f(begin + (end - begin) * (i + 0.5) / around) for f in (math.cos, math.sin))
                    places += [((x + TOOL / 2 * c, y + TOOL / 2 * s, low + (high - low) * (n + 0.5) / up), (c, s, 0))
                               for n in range(up)]
                weights = [1 / len(places)] * len(places)
            for (place, way), weight in zip(places, weights):
                if not enter(place, way, joules * weight) and not enter((place[0], place[1], low), (0, 0, -1),
                                                                         joules * weight):
                    self.lost += joules * weight
        return watts

    def films(self, k):
        mesh, body, lines = self.mesh, self.body(k), []
        for e in range(mesh.elements):
            if body[e]:
                lines += [f"{e + 1}, F{face}, 0., {self.film:.9g}" for face, other in mesh.neighbours(e)
                          if (other is None and face != 1) or (other is not None and not body[other])]
        return lines

    def head(self, kind):
        mesh, (youngs, poisson, expansion) = self.mesh, self.elastic
        lines = ["*NODE, NSET=ALL"]
        lines += [f"{n + 1}, {x:.10g}, {y:.10g}, {z:.10g}" for n, (x, y, z) in enumerate(mesh.nodes)]
        lines += [f"*ELEMENT, TYPE={kind}, ELSET=BODY"]
        lines += [f"{e + 1}, " + ", ".join(str(n + 1) for n in mesh.corners(e)) for e in range(mesh.elements)]
        return lines + ["*MATERIAL, NAME=M", "*ELASTIC", f"{youngs}, {poisson}", "*EXPANSION, ZERO=0", f"{expansion}",
                        "*CONDUCTIVITY", f"{self.conductivity}", "*SPECIFIC HEAT", f"{self.capacity}", "*DENSITY", "1.",
                        "*SOLID SECTION, ELSET=BODY, MATERIAL=M", "*INITIAL CONDITIONS, TYPE=TEMPERATURE", "ALL, 0."]

    @staticmethod
    def change(elements):
        return ["*MODEL CHANGE, TYPE=ELEMENT, REMOVE", listed(elements)] if elements else []

    def temperatures(self, ccx, folder):
        """Of each node at the end of each step."""
        cuts = [[] for _ in self.spans]
        for c in self.source["cuts"]:
            cuts[self.span_of(c[0] + c[1] / 2)].append(c)
        lines, before = self.head("C3D8"), 0.0
        for k, end in enumerate(self.spans):
            flux = [f"{n + 1}, 11, {w:.9g}" for n, w in sorted(self.heat_of(k, cuts[k]).items())] or ["1, 11, 0."]
            lines += ["*STEP, INC=10"] + self.change(self.removed[k - 1] if k > 0 else [])
            lines += ["*HEAT TRANSFER, DIRECT", f"{end - before:.9g}, {end - before:.9g}", "*CFLUX, OP=NEW"] + flux
            lines += ["*FILM, OP=NEW"] + self.films(k) + ["*NODE PRINT, NSET=ALL", "NT", "*END STEP"]
            before = end
        answer = solved(ccx, folder, "warm", lines)
        return [{int(n): float(t) for n, t in block} for block in answer]

    def wanted(self):
        """Steps at whose ends displacements are needed: those of visits, and those before them."""
        spans = {self.span_of(t) for visits in self.visits for t in visits}
        return sorted(spans | {k - 1 for k in spans if k > 0})

    def displacements(self, ccx, folder, warm):
        mesh, lines = self.mesh, self.head("C3D8I")
        bottom = list(range((mesh.n[0] + 1) * (mesh.n[1] + 1)))
        if self.held:
            lines += ["*NSET, NSET=BOTTOM", listed(bottom), "*BOUNDARY", "BOTTOM, 1, 3"]
        else:  # three corners, which hold it without stress
            lines += ["*BOUNDARY", "1, 1, 3", f"{mesh.n[0] + 1}, 2, 3", f"{bottom[-1] - mesh.n[0] + 1}, 3, 3"]
        shown = set(bottom)
        for at, outward in self.places:
            shown |= set(mesh.corners(self.behind(at, outward)[0]))
        lines += ["*NSET, NSET=SHOWN", listed(sorted(shown))]
        done = 0
        for k in self.wanted():
            gone = [e for step in self.removed[done:k + 1] for e in step]
            done = k + 1
            lines += ["*STEP"] + self.change(gone) + ["*STATIC", "*TEMPERATURE, OP=NEW"]
            active = {n for e in range(mesh.elements) if self.active[k][e] for n in mesh.corners(e)}
            lines += [f"{n + 1}, {warm[k][n + 1]:.9g}" for n in sorted(active)]
            lines += ["*NODE PRINT, NSET=SHOWN", "U", "*END STEP"]
        found = {}
        for k, block in zip(self.wanted(), solved(ccx, folder, "moved", lines)):
            moved = {int(row[0]) - 1: [float(v) for v in row[1:]] for row in block}
            found[k] = moved if self.held else self.without_rigid(moved, bottom)
        return found

    def without_rigid(self, moved, bottom):
        """Takes the small motion out that fits the underside best, each node with its part of the area."""
        mesh = self.mesh
        width = lambda a, t: (mesh.at[a][min(t + 1, mesh.n[a])] - mesh.at[a][max(t - 1, 0)]) / 2
        weigh = [width(0, n % (mesh.n[0] + 1)) * width(1, n // (mesh.n[0] + 1)) for n in bottom]
        whole, nodes = sum(weigh), mesh.nodes
        mean = lambda of: sum(w * of(n) for w, n in zip(weigh, bottom)) / whole
        cx, cy = mean(lambda n: nodes[n][0]), mean(lambda n: nodes[n][1])
        z0 = nodes[0][2]
        shift = [mean(lambda n, c=c: moved[n][c]) for c in range(3)]
        xx, yy = mean(lambda n: (nodes[n][0] - cx) ** 2), mean(lambda n: (nodes[n][1] - cy) ** 2)
        # The underside is a rectangle about (cx, cy), so that the turns about the three axes are apart.
        turn_x = mean(lambda n: (nodes[n][1] - cy) * moved[n][2]) / yy
        turn_y = -mean(lambda n: (nodes[n][0] - cx) * moved[n][2]) / xx
        turn_z = mean(lambda n: (nodes[n][0] - cx) * moved[n][1] - (nodes[n][1] - cy) * moved[n][0]) / (xx + yy)
        left = {}
        for n, u in moved.items():
            x, y, z = nodes[n][0] - cx, nodes[n][1] - cy, nodes[n][2] - z0
            left[n] = [u[0] - shift[0] - (turn_y * z - turn_z * y), u[1] - shift[1] - (turn_z * x - turn_x * z),
                       u[2] - shift[2] - (turn_x * y - turn_y * x)]
        return left

    def behind(self, at, outward):
        """The element of the wall behind a place."""
        return self.mesh.find((at[0] + 1e-6 * outward[0], at[1] + 1e-6 * outward[1], at[2]))

    def errors(self, ccx, folder):
        moved = self.displacements(ccx, folder, self.temperatures(ccx, folder))
        found = []
        for (at, outward), visits in zip(self.places, self.visits):
            shares = self.mesh.shares(*self.behind(at, outward))

            def error_at(k):
                return -1000 * sum(s * (moved[k][n][0] * outward[0] + moved[k][n][1] * outward[1]) for n, s in shares)

            each = []
            for t in visits:
                k = self.span_of(t)
                begin = self.spans[k - 1] if k > 0 else 0.0
                part = (t - begin) / (self.spans[k] - begin)
                each.append(part * error_at(k) + (1 - part) * (error_at(k - 1) if k > 0 else 0.0))
            found.append(max(each))
        return found


def solved(ccx, folder, name, lines):
    """Runs a deck, and returns the rows of each block of its answer."""
    (folder / f"{name}.inp").write_text("\n".join(lines) + "\n")
    (folder / f"{name}.dat").unlink(missing_ok=True)
    ran = subprocess.run([ccx, name], cwd=folder, capture_output=True, text=True,
                         env=dict(os.environ, OMP_NUM_THREADS="1"))
    if "Job finished" not in ran.stdout:
        raise SystemExit(f"CalculiX: {ran.stdout[-800:]}{ran.stderr[-400:]}")
    blocks = []
    for line in (folder / f"{name}.dat").read_text().splitlines():
        if "for set" in line:
            blocks.append([])
        elif line.strip():
            blocks[-1].append(line.split())
    return blocks


def run(command):
    ran = subprocess.run(command, capture_output=True, text=True)
    if ran.returncode != 0:
        raise SystemExit(f"{' '.join(command)}: {ran.stderr}")
    return json.loads(ran.stdout)


def allowed(theirs):
    return max(WITHIN * abs(theirs), WITHIN_UM)


def followed(case, words, folder):
    """What is heated and when, and what lekalo makes of it."""
    (folder / "part.ngc").write_text(program_of(case))
    (folder / "pocket.json").write_text(pocket_of(case))
    stock = "x".join(map(str, case["stock"]))
    files = [str(folder / "part.ngc"), str(folder / "pocket.json")]
    material, wear = (case["words"][case["words"].index(option) + 1] for option in ("--material", "--wear"))
    source = run([words.heat_cuts] + files + [stock, str(TOOL), str(TEETH), str(RPM), material, wear])
    result = run([words.lekalo, "heat", files[0], "--pocket", files[1], "--stock", stock, "--tool", str(TOOL),
                  "--teeth", str(TEETH), "--spindle", str(RPM), "--voxel", str(case["voxel"]), "--json"]
                 + case["words"])
    # A place every two millimetres along a wall, at all its heights.
    heights = len({w["at_mm"][2] for w in result["walls"]})
    result["walls"] = [w for i, w in enumerate(result["walls"]) if i // heights * case["voxel"] % 2 == 0]
    return source, result


def compared(title, finer, words, folder, full):
    """Returns the line of a pocket, sentences about what is wrong there, and the errors by CalculiX."""
    case, start = CASES[title], time.monotonic()
    label = title if finer == 1 else f"{title}, finer"
    folder = folder / label.replace(", ", "-")
    folder.mkdir(parents=True, exist_ok=True)
    source, result = followed(case, words, folder)
    if not full:  # two heights of each fifth place: fewer displacements
        result["walls"] = [w for i, w in enumerate(result["walls"]) if i % 10 < 2]
    oracle = Oracle(case, source, result, case["mesh"] * finer, case["step"])
    theirs = oracle.errors(words.ccx, folder)
    ours = [w["error_um"] for w in result["walls"]]
    bad = [i for i in range(len(ours)) if not abs(ours[i] - theirs[i]) <= allowed(theirs[i])]
    far = [i for i in bad if not abs(ours[i] - theirs[i]) <= SO_MUCH_MORE * allowed(theirs[i])]
    most = max(range(len(ours)), key=lambda i: abs(ours[i] - theirs[i]))
    figures = [label, f"{oracle.mesh.elements} elements, {len(oracle.spans)} steps", len(ours), len(bad),
               f"{min(theirs):.2f} to {max(theirs):.2f}", f"{ours[most]:.2f} / {theirs[most]:.2f}",
               f"{time.monotonic() - start:.0f}"]
    line = "| " + " | ".join(map(str, figures)) + " |" if words.table else (
        "{}: {}, {} places, {} apart, CalculiX {} um, largest difference {} um, {} s".format(*figures))
    wrong = []
    for i in bad if len(bad) > RARELY * len(ours) else far:
        at = result["walls"][i]["at_mm"]
        wrong.append(f"at {at[0]:.2f} {at[1]:.2f} {at[2]:.2f}: {ours[i]:.2f} um, CalculiX {theirs[i]:.2f}, "
                     f"allowed {allowed(theirs[i]):.2f}")
    if not max(abs(e) for e in theirs) >= 5 * WITHIN_UM:
        wrong.append("its errors are too small to tell anything")
    if oracle.lost > 0.02 * sum(c[-1] for c in source["cuts"]) * oracle.share:
        wrong.append(f"{oracle.lost:.1f} J found no element")
    return line, [f"  {label}: {w}" for w in wrong], theirs


def main():
    parser = argparse.ArgumentParser()
    for name in ("lekalo", "heat_cuts", "ccx"):
        parser.add_argument(name)
    parser.add_argument("--only", default="")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--keep", help="write decks and answers into this folder")
    words = parser.parse_args()
    full, wrong = "LEKALO_FULL" in os.environ, 0
    words.lekalo, words.heat_cuts = os.path.abspath(words.lekalo), os.path.abspath(words.heat_cuts)
    # What takes longest begins first.
    runs = ([("island", 1), ("deep", 1), ("steel", 1), ("shallow", 3 / 4)] if full else []) + [("shallow", 1)]
    runs = [run for run in runs if re.search(words.only, run[0])]
    if words.table:
        print("| pocket | mesh | places | apart | errors, um | largest difference, um | seconds |"
              "\n|---|---|---|---|---|---|---|")
    found = {}
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(2) as pool:
        folder = pathlib.Path(words.keep or name)
        for run, answer in zip(runs, pool.map(lambda run: compared(*run, words, folder, full), runs)):
            line, sentences, found[run] = answer
            print("\n".join([line] + sentences), flush=True)
            wrong += len(sentences)
    coarse, fine = found.get(("shallow", 1)), found.get(("shallow", 3 / 4))
    if coarse and fine:
        apart = [abs(a - b) for a, b in zip(coarse, fine)]
        print(f"{chr(10) if words.table else ''}The two meshes are at most {max(apart):.2f} um apart, "
              f"{sum(apart) / len(apart):.2f} um in the mean", flush=True)
        wrong += sum(1 for a, b in zip(apart, fine) if not a <= allowed(b))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
