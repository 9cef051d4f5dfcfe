"""Nests the jobs of time_kept.txt with --time 5, and demands that each ends in time with a valid layout.

    time_kept.py LEKALO SOURCE_DIR [--most SECONDS] [--shared FOLDER] [--only REGEX] [--table]

A job must end within 7 s (--most) of the wall clock, on a machine that does nothing else, and `lekalo check`
must find no broken rule in its layout. --table prints what docs/measurements/nest.md records: the seconds to
the first layout, to the end, the corners of the largest part, and how many pieces lie.
"""

import argparse
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
import time


def polygon(points):
    return {"polygon": {"outer": [[round(x, 4), round(y, 4)] for x, y in points]}}


def rectangle(width, height):
    return polygon([(0, 0), (width, 0), (width, height), (0, height)])


def stock(kind, width, height, **more):
    one = {"id": "stock", "kind": kind, "outline": rectangle(width, height)}
    if kind == "strip":
        one = {"id": "stock", "kind": "strip", "height": height}
    else:
        one["count"] = more.pop("count", 50)
    one.update(more)
    return one


def layout(stocks, parts, gap=2):
    return {"format": "lekalo-layout/1", "units": "mm", "rules": {"gap": gap, "border_gap": gap, "defect_gap": 0},
            "stocks": stocks, "parts": parts, "placements": []}


def part(number, outline, demand=1, rotations=(0, 90, 180, 270)):
    one = {"id": f"part {number}", "outline": outline, "demand": demand}
    if rotations is not None:
        one["rotations"] = list(rotations)
    return one


def ring(corners, radius_at, squeeze=1.0):
    spokes = [(a, radius_at(a)) for a in (2 * math.pi * k / corners for k in range(corners))]
    return [(r * math.cos(a), squeeze * r * math.sin(a)) for a, r in spokes]


def wavy(chance, corners, size):
    terms = [(n, chance.uniform(0, 0.3 / n), chance.uniform(0, 7)) for n in range(2, 9)]
    return ring(corners, lambda a: size * (1 + sum(h * math.sin(n * a + p) for n, h, p in terms)),
                chance.uniform(0.5, 1))


def jagged(chance, corners, size):
    return ring(corners, lambda a: size * chance.uniform(0.97, 1))


def gear(chance, corners, size):
    teeth = corners // 40
    return ring(corners, lambda a: size * (1 + 0.08 * max(-1, min(1, 3 * math.sin(teeth * a)))))


def of_shapes(shape):
    def make(copies, corners, kind, seed):
        chance = random.Random(int(seed))
        parts = [part(k, polygon(shape(chance, int(corners), chance.uniform(60, 160)))) for k in range(int(copies))]
        return layout([stock(kind, 1500, 1000)], parts)
    return make


def pieces(count, kind, seed):
    chance = random.Random(int(seed))
    parts = []
    for k in range(10):
        w, h = chance.uniform(20, 90), chance.uniform(15, 60)
        a, b = chance.uniform(0.2, 0.8) * w, chance.uniform(0.2, 0.8) * h
        parts.append(part(k, polygon([(0, 0), (w, 0), (w, b), (a, b), (a, h), (0, h)]), int(count) // 10))
    return layout([stock(kind, 2500, 1250, count=40) if kind == "sheet" else stock(kind, 0, 1250)], parts)


def kinds(count, corners, seed):
    chance = random.Random(int(seed))
    parts = [part(k, polygon(wavy(chance, int(corners), chance.uniform(20, 60)))) for k in range(int(count))]
    return layout([stock("sheet", 1500, 1000)], parts)


def any_angle(count, corners, seed):
    chance = random.Random(int(seed))
    parts = [part(k, polygon(wavy(chance, int(corners), chance.uniform(30, 80))), 1, None) for k in range(int(count))]
    return layout([stock("strip", 0, 1000)], parts)


def ragged(corners, count, seed):
    chance = random.Random(int(seed))
    hide = stock("hide", 0, 0, count=2)
    hide["outline"] = polygon(jagged(chance, int(corners), 1200))
    parts = [part(k, polygon(wavy(chance, 300, chance.uniform(40, 120))), 2) for k in range(int(count) // 2)]
    return layout([hide], parts)


def defects(count, seed):
    chance = random.Random(int(seed))
    spots = []
    for k in range(int(count)):
        x, y, r = chance.uniform(20, 2480), chance.uniform(20, 1230), chance.uniform(2, 15)
        spots.append({"id": f"d{k}", "severity": 1, "outline": polygon(
            [(x + r * math.cos(a), y + r * math.sin(a)) for a in (0.7 * n for n in range(9))])})
    parts = [part(k, polygon(wavy(chance, 40, chance.uniform(20, 70))), 20) for k in range(10)]
    return layout([stock("sheet", 2500, 1250, defects=spots, count=6)], parts)


def leather(path, hides):
    job = json.load(open(path))
    job["Objects"] = job["Objects"][:int(hides)]
    return job


def order(folder, sheet, gap):
    """Gives the words of an order of all drawings of a folder, which the command reads itself."""
    drawings = [os.path.join(folder, name) for name in sorted(os.listdir(folder))]
    return [word for path in drawings for word in ("--part", path)] + ["--sheet", sheet, "--gap", gap]


MAKERS = {"wavy": of_shapes(wavy), "jagged": of_shapes(jagged), "gears": of_shapes(gear), "pieces": pieces,
          "kinds": kinds, "anyangle": any_angle, "ragged": ragged, "defects": defects, "leather": leather,
          "file": lambda path: json.load(open(path))}


def jobs(source, shared):
    for line in open(os.path.join(source, "tests/e2e/time_kept.txt")):
        if line.startswith("#") or not line.strip():
            continue
        name, kind, *words = line.split()
        if any(word.startswith("SHARED") for word in words) and not shared:
            print(f"{name}: left out, there is no shared data")
            continue
        words = [word.replace("SHARED", shared or "") for word in words]
        yield name, kind, [os.path.join(source, w) if w.startswith("examples/") else w for w in words]


def nested(folder, what, seconds):
    """Runs the job; gives its status, the seconds to the first layout and to the end, and what it says."""
    stream = os.path.join(folder, "stream.json")
    words = [LEKALO, "nest", *what, "--time", str(seconds), "-o", "out.json", "--json"]
    begin = time.monotonic()
    # A pipe that nobody reads would hold up a job that has much to say.
    with open(os.path.join(folder, "report.json"), "w") as report, open(os.path.join(folder, "said.txt"), "w") as said:
        process = subprocess.Popen(words, cwd=folder, stdout=report, stderr=said)
    first = None
    while process.poll() is None:
        if first is None and os.path.exists(stream):
            first = time.monotonic() - begin
        time.sleep(0.01)
    end = time.monotonic() - begin
    with open(os.path.join(folder, "said.txt"), errors="replace") as said:
        return process.returncode, first, end, said.read()


def corners_of(document):
    def of(outline):
        rings = outline.get("polygon", {})
        return len(rings.get("outer", [])) + sum(len(hole) for hole in rings.get("holes", []))
    return max((of(one["outline"]) for one in document["parts"]), default=0)


def main():
    words = argparse.ArgumentParser()
    words.add_argument("lekalo")
    words.add_argument("source")
    words.add_argument("--most", type=float, default=7)
    words.add_argument("--time", type=float, default=5)
    words.add_argument("--shared", default=os.environ.get("LEKALO_SHARED_DATA"))
    words.add_argument("--only", default="")
    words.add_argument("--table", action="store_true")
    o = words.parse_args()
    global LEKALO
    LEKALO = os.path.abspath(o.lekalo)
    source = os.path.abspath(o.source)
    usual = os.path.join(source, "../shared/data")
    shared = o.shared or (usual if os.path.isdir(usual) else None)
    if o.table:
        print("| job | corners | pieces | lie | first layout, s | end, s |\n|---|---|---|---|---|---|")
    failures = 0
    for name, kind, arguments in jobs(source, shared and os.path.abspath(shared)):
        if not re.search(o.only, name):
            continue
        with tempfile.TemporaryDirectory() as folder:
            if kind == "order":
                what = order(*arguments)
            else:
                with open(os.path.join(folder, "job.json"), "w") as out:
                    json.dump(MAKERS[kind](*arguments), out)
                what = ["job.json", "--stream", "stream.json"]
            status, first, end, said = nested(folder, what, o.time)
            trouble = "" if status in (0, 1) else f"exit status {status}: {said.strip()[-200:]}"
            document, lie, wanted = {"parts": []}, 0, 0
            if not trouble:
                document = json.load(open(os.path.join(folder, "out.json")))
                report = json.load(open(os.path.join(folder, "report.json")))
                lie = len(document["placements"])
                wanted = lie + sum(one["count"] for one in report["unplaced"])
                checked = subprocess.run([LEKALO, "check", "out.json"], cwd=folder, capture_output=True)
                if checked.returncode != 0:
                    trouble = "the layout breaks a rule: " + checked.stdout.decode()[-200:]
                elif lie == 0:
                    trouble = "nothing lies"
                elif end > o.most:
                    trouble = f"it took {end:.1f} s"
            if o.table:
                print(f"| {name} | {corners_of(document)} | {wanted} | {lie} | "
                      f"{'-' if first is None else format(first, '.2f')} | {end:.2f} |", flush=True)
            if trouble:
                failures += 1
                print(f"{name}: {trouble}", flush=True)
    return 1 if failures else 0


LEKALO = ""
if __name__ == "__main__":
    sys.exit(main())
