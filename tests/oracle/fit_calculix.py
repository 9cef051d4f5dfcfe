#!/usr/bin/env python3
"""Results of `lekalo fit` against CalculiX, which solves the same assemblies on a mesh that is written here.

    fit_calculix.py LEKALO CCX [--only REGEX] [--table]

Axisymmetric CAX8 elements, contact surface to surface with a linear penalty, von Mises without hardening. Each ring
that is pressed on another shrinks evenly by a temperature until it interferes, so that the interference grows step by
step and nothing overlaps at first. Growths along the axis have to agree to 1 % or 0.05 um, in the radius, and pressures
away from edges to 1 %. A corrected profile is turned on the nodes, and the surface has to be a cylinder here, too.

Without LEKALO_FULL only the first case is run. --table prints the figures as Markdown.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

WITHIN, WITHIN_UM, PRESSURE = 0.01, 0.05, 0.01
# A node at a sharp edge moves by what the mesh there can show; its neighbours do not.
EDGE_MM = 0.05
PENALTY = 1e8  # MPa/mm: overlaps stay below 1e-5 um

SHAFT = ["--diameter", "18", "--hub-outer", "36", "--length", "18", "--shaft-length", "54", "--material", "C45"]
STRONG = ["--yield", "2000"]
CASES = [
    ("elastic", SHAFT + STRONG + ["--interference", "0.04"]),
    ("elastic, hollow shaft", SHAFT + STRONG + ["--bore", "12", "--interference", "0.04"]),
    ("yielding, 40 um", SHAFT + ["--yield", "340", "--interference", "0.04"]),
    ("yielding, 87 um", SHAFT + ["--yield", "340", "--interference", "0.087"]),
    ("yielding, 121 um", SHAFT + ["--yield", "340", "--interference", "0.121"]),
    ("yielding, hollow shaft", SHAFT + ["--bore", "6", "--yield", "340", "--interference", "0.06"]),
    ("aluminium on steel", ["--diameter", "40", "--hub-outer", "70", "--length", "20", "--shaft-length", "80",
                            "--material", "6061-T6", "--shaft-material", "C45", "--interference", "0.05"]),
    ("three rings", ["--diameter", "40", "--hub-outer", "60", "--length", "30", "--bore", "10", "--ring", "80,0.03",
                     "--material", "C45", "--interference", "0.02"]),
    ("as long as one another", ["--diameter", "20", "--hub-outer", "30", "--length", "12", "--shaft-length", "12",
                                "--material", "C45", "--interference", "0.015"]),
    ("at the end of the shaft", SHAFT + STRONG + ["--interference", "0.04", "--from-end", "0"]),
    ("at the end, yielding, seat corrected", SHAFT + ["--yield", "340", "--interference", "0.06", "--from-end", "2",
                                                      "--cylindrical", "seat"]),
    ("outside corrected", SHAFT + ["--yield", "340", "--interference", "0.06", "--cylindrical", "outside"]),
    ("bore corrected", SHAFT + STRONG + ["--bore", "8", "--interference", "0.04", "--cylindrical", "bore"]),
    ("seat corrected", SHAFT + STRONG + ["--interference", "0.04", "--cylindrical", "seat"]),
    ("seat corrected, yielding", SHAFT + ["--yield", "340", "--interference", "0.087", "--cylindrical", "seat"]),
]


def graded(start, end, fine, most, at_start, at_end):
    """Places from start to end, dense at the ends that are said."""
    sides, length = int(at_start) + int(at_end), end - start
    reach, step, steps = (length / 2 if sides == 2 else length), (fine if sides else most), []
    while sum(steps) < reach * (1 - 1e-9):
        steps.append(step)
        step = min(1.3 * step, most)
    steps = [s * reach / sum(steps) for s in steps]
    steps = steps + steps[::-1] if sides == 2 else steps[::-1] if at_end and not at_start else steps
    places = [start]
    for s in steps:
        places.append(places[-1] + s)
    places[-1] = end
    return places


class Mesh:
    """Rings in quadrilaterals of 8 nodes; `at[ring][j, k]` is the node j half elements across and k along."""

    def __init__(self):
        self.nodes, self.elements, self.at, self.of, self.size = [], [], [], [], []

    def add(self, radii, places):
        half = lambda p, i: p[i // 2] if i % 2 == 0 else (p[i // 2] + p[i // 2 + 1]) / 2
        across, along, at, of = 2 * len(radii) - 1, 2 * len(places) - 1, {}, []
        for k in range(along):
            for j in range(across):
                if k % 2 == 0 or j % 2 == 0:
                    self.nodes.append([half(radii, j), half(places, k)])
                    at[j, k] = len(self.nodes)
        for k in range(0, along - 2, 2):
            for j in range(0, across - 2, 2):
                self.elements.append([at[j, k], at[j + 2, k], at[j + 2, k + 2], at[j, k + 2], at[j + 1, k],
                                      at[j + 2, k + 1], at[j + 1, k + 2], at[j, k + 1]])
                of.append(len(self.elements))
        self.at.append(at), self.of.append(of), self.size.append((across, along))

    def surface(self, ring, outer):
        across, along = self.size[ring]
        return [self.at[ring][across - 1 if outer else 0, k] for k in range(along)]

    def sides(self, ring, outer):
        row = (self.size[ring][0] - 1) // 2
        return [e for i, e in enumerate(self.of[ring]) if i % row == (row - 1 if outer else 0)]


def ends_of(ring):
    return ring["middle_mm"] - ring["length_mm"] / 2, ring["middle_mm"] + ring["length_mm"] / 2


def diameter_at(profile, z):
    """Straight between the points; the half that is given is mirrored."""
    points = profile if profile[0]["z_mm"] < 0 else profile
    z = z if profile[0]["z_mm"] < 0 else abs(z)
    for a, b in zip(points, points[1:]):
        if z <= b["z_mm"]:
            part = (z - a["z_mm"]) / (b["z_mm"] - a["z_mm"])
            return a["diameter_mm"] + max(part, 0) * (b["diameter_mm"] - a["diameter_mm"])
    return points[-1]["diameter_mm"]


def along(ends, thinnest):
    """Places from 0 outwards, dense beside all ends but that of the longest ring alone."""
    places, marks = [0.0], sorted(set(ends))
    for i, mark in enumerate(marks):
        places += graded(places[-1], mark, thinnest / 30, 0.3 * thinnest, i > 0, i + 1 < len(marks) or ends.count(mark) > 1)[1:]
    return places


def meshed(rings, shrinks, turned):
    """Half of the assembly, or all of it where the hub sits elsewhere than in the middle. Coordinates are such that each
    ring has its length after it has shrunk freely."""
    mesh, thinnest = Mesh(), min(min((r["outer_diameter_mm"] - r["inner_diameter_mm"]) / 2, r["length_mm"] / 2)
                                 for r in rings)
    places = along([ends_of(r)[1] for r in rings], thinnest)
    if rings[0]["middle_mm"]:
        places = [-z for z in reversed(along([-ends_of(r)[0] for r in rings], thinnest)[1:])] + places
    for i, (ring, shrink) in enumerate(zip(rings, shrinks)):
        inner, outer = ring["inner_diameter_mm"] / 2, ring["outer_diameter_mm"] / 2
        radii = graded(inner, outer, (outer - inner) / 16, (outer - inner) / 6, i > 0, i + 1 < len(rings))
        low, high = ends_of(ring)
        mesh.add(radii, [z / (1 + shrink) for z in places if low - 1e-9 <= z <= high + 1e-9])
        if turned and turned["ring"] == i:
            for k in range(mesh.size[i][1]):
                for j in range(mesh.size[i][0]):
                    if (j, k) in mesh.at[i]:
                        node = mesh.nodes[mesh.at[i][j, k] - 1]
                        part = (node[0] - inner) / (outer - inner)
                        change = (diameter_at(turned["profile"], node[1] * (1 + shrink)) - turned["nominal"]) / 2
                        node[0] += change * (part if turned["outer"] else 1 - part)
    return mesh


def listed(numbers):
    return "\n".join(", ".join(map(str, numbers[i:i + 12])) for i in range(0, len(numbers), 12))


def deck(mesh, rings, shrinks, steps):
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{i + 1}, {r:.12g}, {z:.12g}, 0" for i, (r, z) in enumerate(mesh.nodes)]
    for i, ring in enumerate(rings):
        lines.append(f"*ELEMENT, TYPE=CAX8, ELSET=E{i}")
        lines += [", ".join(map(str, [e] + mesh.elements[e - 1])) for e in mesh.of[i]]
        lines += [f"*MATERIAL, NAME=M{i}", "*ELASTIC", f"{ring['youngs_mpa']}, {ring['poisson']}", "*PLASTIC",
                  f"{ring['yield_mpa']}, 0.", "*EXPANSION, ZERO=0", "1.", f"*SOLID SECTION, ELSET=E{i}, MATERIAL=M{i}",
                  f"*NSET, NSET=N{i}", listed(sorted(mesh.at[i].values()))]
    lines += ["*SURFACE INTERACTION, NAME=I", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{PENALTY:g}"]
    for seat in range(len(rings) - 1):
        low, high = ends_of(rings[seat + 1])
        near = [e for e in mesh.sides(seat, True) if low - 1 <= mesh.nodes[mesh.elements[e - 1][1] - 1][1] <= high + 1]
        lines += [f"*SURFACE, NAME=IN{seat}"] + [f"{e}, S2" for e in near]
        lines += [f"*SURFACE, NAME=OUT{seat}"] + [f"{e}, S4" for e in mesh.sides(seat + 1, False)]
        lines += ["*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE", f"OUT{seat}, IN{seat}"]
    bases = [i + 1 for i, (_, z) in enumerate(mesh.nodes) if z == 0]
    if rings[0]["middle_mm"]:  # nothing pulls along the axis: one node holds each ring
        bases = [n for i in range(len(rings)) for n in mesh.surface(i, True) if mesh.nodes[n - 1][1] == 0]
    axis = [i + 1 for i, (r, _) in enumerate(mesh.nodes) if r == 0]
    lines += ["*NSET, NSET=BASE", listed(bases), "*BOUNDARY", "BASE, 2, 2"]
    if axis:
        lines += ["*NSET, NSET=AXIS", listed(axis), "*BOUNDARY", "AXIS, 1, 1"]
    shown = sorted(set(sum((mesh.surface(i, outer) for i in range(len(rings)) for outer in (False, True)), [])))
    lines += ["*NSET, NSET=SHOWN", listed(shown), "*INITIAL CONDITIONS, TYPE=TEMPERATURE", "ALL, 0.",
              "*STEP, NLGEOM=NO, INC=400", "*STATIC", steps, "*TEMPERATURE"]
    lines += [f"N{i}, {shrink:.15g}" for i, shrink in enumerate(shrinks)]
    lines += ["*NODE PRINT, NSET=SHOWN, FREQUENCY=1000", "U", "*CONTACT PRINT, FREQUENCY=1000", "CSTR",
              "*CONTACT PRINT, MASTER=IN0, SLAVE=OUT0, FREQUENCY=1000", "CFN", "*END STEP"]
    return "\n".join(lines) + "\n"


def read_answer(text):
    """Radial displacements of nodes, pressures at the points of each slave's element, and the first seat's mean."""
    moved, pressures, mean, block = {}, {}, 0.0, ""
    for line in text.splitlines():
        words = line.split()
        if "displacements" in line or "contact stress" in line:
            block = words[0]
        elif block == "displacements" and len(words) == 4:
            moved[int(words[0])] = float(words[1])
        elif block == "contact" and len(words) == 5:
            pressures.setdefault(int(words[0]), []).append(float(words[2]))
        elif line.strip().startswith("area"):
            block = "area"
        elif block == "area" and len(words) == 3:
            mean, block = -float(words[1]) / float(words[0]), ""
    return moved, pressures, mean


def between(points, z):
    """The value at z of what runs from the least z to the greatest."""
    for (a, u), (b, v) in zip(points, points[1:]):
        if z <= b + 1e-9:
            return u + (z - a) / (b - a) * (v - u)
    return points[-1][1]


class Case:
    def __init__(self, result, ccx, folder):
        self.rings, self.case = result["rings"], result["cases"][len(result["cases"]) // 2]
        self.correction = result["correction"]
        self.shrinks, turned = [0.0], None
        for seat, ring in zip(self.case["seats"], self.rings):
            self.shrinks.append(self.shrinks[-1] - seat["interference_um"] / 1000 / ring["outer_diameter_mm"])
        if self.correction:
            outer = self.correction["surface"] != "bore"
            turned = {"ring": len(self.rings) - 1 if self.correction["surface"] == "outside" else 0, "outer": outer,
                      "nominal": self.correction["nominal_mm"], "profile": self.correction["profile"]}
        # The profile's growths are those of the parts as they were before they were corrected.
        self.meshes = [meshed(self.rings, self.shrinks, None)] + (
            [meshed(self.rings, self.shrinks, turned)] if turned else [])
        self.answers = []
        steps = "0.5, 1., 1e-5, 0.5" if self.case["state"] == "elastic" else "0.1, 1., 1e-5, 0.1"
        for mesh in self.meshes:
            (folder / "fit.inp").write_text(deck(mesh, self.rings, self.shrinks, steps))
            (folder / "fit.dat").unlink(missing_ok=True)
            ran = subprocess.run([ccx, "fit"], cwd=folder, capture_output=True, text=True,
                                 env=dict(os.environ, OMP_NUM_THREADS="1"))
            if "Job finished" not in ran.stdout:
                raise SystemExit(f"CalculiX: {ran.stdout[-800:]}")
            self.answers.append(read_answer((folder / "fit.dat").read_text()))

    def growths(self, ring, outer, run=0):
        """(z, um of the radius) along a surface, without the shrinking itself."""
        mesh, shrink = self.meshes[run], self.shrinks[ring]
        return [(mesh.nodes[n - 1][1] * (1 + shrink), 1000 * (self.answers[run][0][n] - shrink * mesh.nodes[n - 1][0]))
                for n in mesh.surface(ring, outer)]

    def compare(self):
        """Rows: what, ours, theirs, how far they may be apart."""
        rows, edge = [], ends_of(self.rings[1])[1]
        last = len(self.rings) - 1
        for key, ring, outer in (("bore_um", 0, False), ("shaft_um", 0, True), ("hub_bore_um", 1, False),
                                 ("hub_um", last, True)):
            theirs = self.growths(ring, outer)
            for row in self.case["profile"]:
                if row[key] is not None and abs(abs(row["z_mm"]) - edge) > EDGE_MM * (key != "hub_um"):
                    other = between(theirs, row["z_mm"])
                    rows.append((f"{key[:-3]} at {row['z_mm']:.3f}", row[key] / 2, other,
                                 max(WITHIN * abs(other), WITHIN_UM)))
        mesh, (_, pressures, mean) = self.meshes[0], self.answers[0]
        points = pressures[next(e for e in mesh.sides(1, False) if mesh.nodes[mesh.elements[e - 1][0] - 1][1] == 0)]
        middle = sum(points) / len(points)
        rows.append(("pressure in the middle", self.case["middle_pressure_mpa"], middle, PRESSURE * middle))
        rows.append(("mean pressure", self.case["pressure_mpa"], mean, PRESSURE * mean))
        if self.correction:
            surface, nominal = self.correction["surface"], self.correction["nominal_mm"]
            ring, outer = (last if surface == "outside" else 0), surface != "bore"
            here = lambda z: surface != "seat" or abs(z) <= edge + 1e-9
            after = [2 * u + 1000 * (diameter_at(self.correction["profile"], z) - nominal)
                     for z, u in self.growths(ring, outer, run=1) if here(z)]
            before = [2 * u for z, u in self.growths(ring, outer) if here(z)]
            rows.append(("varies after correction", self.correction["remains"][len(self.correction["remains"]) // 2]
                         ["after_um"], max(after) - min(after), max(1, 0.05 * (max(before) - min(before)))))
        return rows


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lekalo")
    parser.add_argument("ccx")
    parser.add_argument("--only", default="")
    parser.add_argument("--table", action="store_true")
    words = parser.parse_args()
    lekalo, wrong = os.path.abspath(words.lekalo), 0
    chosen = [c for c in CASES if re.search(words.only, c[0])][:None if "LEKALO_FULL" in os.environ else 1]
    if words.table:
        print("| case | largest difference of growths, um in the radius | where | pressure in the middle, MPa | mean pressure, MPa | variation after correction, um |"
              "\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        for title, options in chosen:
            ran = subprocess.run([lekalo, "fit", "--json"] + options, capture_output=True, text=True)
            if ran.returncode != 0:
                raise SystemExit(f"{title}: {ran.stderr}")
            start = time.monotonic()
            rows = Case(json.loads(ran.stdout), words.ccx, pathlib.Path(name)).compare()
            bad = [r for r in rows if not abs(r[1] - r[2]) <= r[3]]
            worst = max((r for r in rows if " at " in r[0]), key=lambda r: abs(r[1] - r[2]))
            figures = {r[0]: r for r in rows}
            if words.table:
                print(f"| {title} | {abs(worst[1] - worst[2]):.3f} of {abs(worst[2]):.2f} | {worst[0]} | " + " | ".join(
                    f"{figures[k][1]:{form}} / {figures[k][2]:{form}}" if k in figures else "" for k, form in
                    (("pressure in the middle", ".1f"), ("mean pressure", ".1f"), ("varies after correction", ".2f"))) +
                      " |", flush=True)
            else:
                print(f"{title}: {len(rows)} figures, {len(bad)} apart, largest difference {worst[0]} "
                      f"{worst[1]:.4f} / {worst[2]:.4f} um, {time.monotonic() - start:.1f} s", flush=True)
            for what, ours, theirs, most in bad:
                print(f"  {title}: {what}: {ours:.4f}, CalculiX {theirs:.4f}, allowed {most:.4f}", flush=True)
            wrong += len(bad)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
