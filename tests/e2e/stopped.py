"""Ends some thirty command lines with Ctrl-C at moments drawn by chance, and demands that they end at once.

    stopped.py LEKALO SOURCE_DIR

A command may use half a second of processor time after the signal, which says nearly the same on a machine that
does other things too; LEKALO_STOP_SECONDS is another bound, for tests that share their processors. It then gives its best so far (nest, locate) or one sentence and exit status 1, and every
file in its folder is as it was before or whole: nothing is half written, nothing is left over.
LEKALO_CASES is the number of signals (at least one and at most ten for each line), LEKALO_SEED their seed.
"""

import json
import math
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

MOST = float(os.environ.get("LEKALO_STOP_SECONDS", "0.5"))  # seconds of processor time after the signal
TICK = os.sysconf("SC_CLK_TCK")
CHANCE = random.Random(int(os.environ.get("LEKALO_SEED", "1")))


def write(folder, name, text):
    with open(os.path.join(folder, name), "w") as out:
        out.write(text)


def star(count, size, x=0.0, y=0.0):
    return [(round(x + r * math.cos(a), 4), round(y + r * math.sin(a), 4)) for a, r in
            ((2 * math.pi * k / count, size * (1 + 0.1 * math.sin(7 * 2 * math.pi * k / count))) for k in range(count))]


def region(points):
    return json.dumps({"units": "mm", "outer": [
        {"line": {"from": a, "to": b}} for a, b in zip(points, points[1:] + points[:1])]})


def big_layout(columns, rows):
    parts = [{"id": "star", "outline": {"polygon": {"outer": star(60, 9)}}}]
    places = [{"id": 1 + r * columns + c, "part": "star", "stock": "sheet", "copy": 0, "x": 15 + 24 * c, "y": 15 + 24 * r,
               "rotation_deg": 0} for r in range(rows) for c in range(columns)]
    sheet = {"id": "sheet", "kind": "sheet", "outline": {"polygon": {"outer": [
        [0, 0], [24 * columns + 20, 0], [24 * columns + 20, 24 * rows + 20], [0, 24 * rows + 20]]}}}
    return json.dumps({"format": "lekalo-layout/1", "units": "mm", "rules": {"gap": 1}, "stocks": [sheet],
                       "parts": parts, "placements": places})


def big_order(count):
    parts = [{"id": f"p{k}", "demand": count // 20, "rotations": [0, 90],
              "outline": {"polygon": {"outer": star(30, 10 + k)}}} for k in range(20)]
    sheet = {"id": "sheet", "kind": "sheet", "count": 50, "outline": {"polygon": {"outer": [
        [0, 0], [1000, 0], [1000, 800], [0, 800]]}}}
    return json.dumps({"format": "lekalo-layout/1", "units": "mm", "rules": {"gap": 1}, "stocks": [sheet],
                       "parts": parts, "placements": []})


def big_dxf(count):
    lines = ["0", "SECTION", "2", "HEADER", "9", "$INSUNITS", "70", "4", "0", "ENDSEC", "0", "SECTION", "2", "ENTITIES"]
    for k in range(count):
        x, y = 30 * (k % 100), 30 * (k // 100)
        ring = [(x, y), (x + 20, y), (x + 20, y + 20), (x, y + 20)]
        for (a, b), (c, d) in zip(ring, ring[1:] + ring[:1]):
            lines += ["0", "LINE", "8", "0", "10", str(a), "20", str(b), "11", str(c), "21", str(d)]
    return "\n".join(lines + ["0", "ENDSEC", "0", "EOF", ""])


def big_svg(count):
    shapes = "".join(f'<path d="M{30 * (k % 100)} {30 * (k // 100)} h20 c5 5 5 15 0 20 h-20 z"/>' for k in range(count))
    return f'<svg xmlns="http://www.w3.org/2000/svg" width="3000mm" height="3000mm" viewBox="0 0 3000 3000">{shapes}</svg>'


def big_program(count):
    lines = ["G21 G90 G17", "G54", "G0 Z5", "G0 X10 Y10", "G1 Z-1 F100"]
    lines += [f"G1 X{10 + 60 * (k % 2)} Y{10 + 20 * k / count:.4f}" for k in range(count)]
    return "\n".join(lines + ["G0 Z5", "M2", ""])


def above_box(x, y, z):
    """What a scanner sees of a box from above, 1 mm apart."""
    return "".join(f"{i} {j} {k}\n" for i in range(x + 1) for j in range(y + 1) for k in range(z + 1)
                   if k == z or i in (0, x) or j in (0, y))


def prepare(folder, source):
    examples = os.path.join(source, "examples")
    for name in ["regions", "orders", "pockets", "layouts", "localisation", "solid"]:
        for file in os.listdir(os.path.join(examples, name)):
            shutil.copy(os.path.join(examples, name, file), folder)
    write(folder, "above.xyz", above_box(250, 200, 100))
    write(folder, "big.json", big_layout(60, 50))
    write(folder, "order.json", big_order(2000))
    write(folder, "big.dxf", big_dxf(4000))
    write(folder, "big.svg", big_svg(4000))
    write(folder, "big.nc", big_program(40000))
    write(folder, "part.json", region(star(150, 100)))
    write(folder, "blank.json", region(star(200, 120, 500, 400)))
    write(folder, "plate.json", region([(0, 0), (80, 0), (80, 40), (0, 40)]))
    write(folder, "scan.csv", "x,y\n" + "".join(f"{x},{y}\n" for x, y in star(4000, 120, 500, 400)))
    write(folder, "many.commands", "lekalo-commands/1\n" + "".join(f"move {k} by 0.1 0.1\n" for k in range(1, 800)))
    write(folder, "compact.commands", "lekalo-commands/1\ncompact sheet 0 towards -1 0\n")


# Words of a command; what a file made before needs is made once, without a signal.
CONVEX = "locate --part example-5-part.csv --blank example-5-blank.csv"
BRACKET = "locate --part bracket.json --blank casting.json"
BEFORE = [
    f"{CONVEX} -o convex.json",
    f"{BRACKET} -o found.json --work 3000",
    f"{BRACKET} --features bracket-features.json -o demands.json --work 3000",
    "pocket cover.json --tool 6 --depth 4 --stepdown 1 -o cover.ngc",
]
LINES = [
    f"{CONVEX} -o o.json --picture o.svg",
    f"{BRACKET} -o o.json --report o.pdf",
    f"{BRACKET} --features bracket-features.json -o o.json",
    f"{BRACKET} --criterion even --give-up 0.2 -o o.json",
    "locate --part part.json --blank blank.json -o o.json",
    "locate --part part.json --blank blank.json -o o.json --time 1",
    "locate --part flange.json --blank flange-scan.csv --uncertainty 0.01 --min-radius 4 -o o.json",
    "locate --part part.json --blank scan.csv --uncertainty 0.01 -o o.json",
    "locate --part big.dxf --blank big.dxf -o o.json",
    "locate --part example-1-part.csv --blank example-1-blank.csv --nc big.nc --nc-out o.nc -o o.json",
    "locate --part part.stl --blank casting.stl -o o.json",
    "locate --part part.stl --blank above.xyz --uncertainty 0.01 --min-radius 3 --mesh o.ply -o o.json",
    "locate --part part.stl --blank touches.xyz --nominal-blank casting.stl --form 0.1 --ball 3 --uncertainty 0.005 "
    "--mesh o.ply -o o.json",
    "verify convex.json",
    "verify found.json",
    "verify demands.json --json",
    "check big.json",
    "check big.json --json --picture o.svg",
    "check big.dxf",
    "show big.json --picture o.png",
    "show big.svg --json",
    "show big.json --picture o.pdf",
    "export big.json -o o.json",
    "export big.dxf -o o.json",
    "export big.svg -o o.json",
    "export big.json --format dxf -o o.dxf",
    "export big.json --format gcode --kerf 0.2 --feed 2000 -o o.nc",
    "export big.json --format hpgl -o o.plt",
    "edit big.json --commands many.commands -o o.json",
    "edit big.json --commands compact.commands -o o.json",
    "nest order.json -o o.json --time 60",
    "nest order.json -o o.json --picture o.svg --stream o.stream",
    "nest brackets.json -o o.json --time 20",
    "pocket cover.json --tool 3 --depth 4 --stepdown 1 -o o.ngc --picture o.svg",
    "pocket cover.json --tool 6 --depth 2 --method floz-linear -o o.ngc",
    "simulate cover.ngc --pocket cover.json --tool 6",
    "simulate cover.ngc --pocket cover.json --tool 6 --samples o.csv --animation o.html",
]
# Lines with the moments at which they once went on for too long.
FOUND = [("show big.json --picture o.pdf", moment) for moment in (0.15, 0.3)]
KEEPS_BEST = ("nest", "locate")


def cpu_of(pid):
    fields = open(f"/proc/{pid}/stat").read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICK


def catches(pid):
    try:
        for line in open(f"/proc/{pid}/status"):
            if line.startswith("SigCgt:"):
                return int(line.split()[1], 16) >> (signal.SIGINT - 1) & 1
    except (FileNotFoundError, ProcessLookupError):
        pass
    return False


def contents(folder):
    return {name: open(os.path.join(folder, name), "rb").read() for name in sorted(os.listdir(folder))
            if os.path.isfile(os.path.join(folder, name)) and name not in ("said", "out")}


def trial(lekalo, folder, line, after):
    """Runs a line and sends SIGINT after so much of its processor time; gives what was wrong, or nothing."""
    before = contents(folder)
    with open(os.path.join(folder, "out"), "w") as out, open(os.path.join(folder, "said"), "w") as said:
        process = subprocess.Popen([lekalo] + line.split(), cwd=folder, stdout=out, stderr=said)
        sent = None
        while True:
            done, status, usage = os.wait4(process.pid, os.WNOHANG)
            if done:
                break
            if sent is None and catches(process.pid):
                try:
                    used = cpu_of(process.pid)
                    if used >= after:
                        sent = used
                        process.send_signal(signal.SIGINT)
                except (FileNotFoundError, ProcessLookupError):
                    pass
            time.sleep(0.002)
        process.returncode = 0
    code = os.waitstatus_to_exitcode(status)
    text = open(os.path.join(folder, "said"), errors="replace").read()
    files = contents(folder)
    if sent is None:
        return (None if code in (0, 1) else f"ended with status {code}: {text[-200:]}"), code, 0
    late = usage.ru_utime + usage.ru_stime - sent
    if late > MOST + 2 / TICK:
        return f"used {late:.2f} s of processor time after the signal", code, late
    stopped = "stopped before there was anything to show" in text
    if stopped and (code != 1 or files != before):
        return f"stopped with status {code}, or a file was changed", code, late
    if code < 0 or code > 1:
        return f"ended with status {code}: {text[-200:]}", code, late
    strange = [name for name in files if name not in before and not name.startswith("o.")]
    if strange:
        return f"left {strange} behind", code, late
    for name in files:
        if name.startswith("o.") and name.endswith(".json") and files[name] != before.get(name):
            json.loads(files[name])
    if not stopped and line.split()[0] in KEEPS_BEST and files.get("o.json") == before.get("o.json"):
        return "neither its best so far nor a sentence", code, late
    return None, code, late


def gives_up(lekalo, folder):
    """A work limit ends a command, always at the same step, with a sentence that names the way out."""
    for line in ["check big.json", "show big.svg", "export big.dxf", "edit big.json --commands many.commands -o o.json",
                 "simulate cover.ngc --pocket cover.json --tool 6", "pocket cover.json --tool 6 --depth 2", "verify convex.json"]:
        before = contents(folder)
        runs = [subprocess.run([lekalo] + line.split() + ["--work", "400"], cwd=folder, capture_output=True)
                for _ in range(2)]
        said = runs[0].stderr.decode()
        if [run.returncode for run in runs] != [3, 3] or "more than 400 steps of work; --work allows more" not in said:
            yield f"lekalo {line} --work 400: status {runs[0].returncode}, {said}"
        if runs[0].stderr != runs[1].stderr or contents(folder) != before:
            yield f"lekalo {line} --work 400: not the same twice, or something was written"


def ended_twice(lekalo, folder):
    """A second Ctrl-C ends what is done to the end after the first, and nothing is written."""
    before = contents(folder)
    line = "locate --part part.stl --blank casting.stl -o o.json --picture o.png --report o.pdf --gap 0.0001"
    process = subprocess.Popen([lekalo] + line.split(), cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None and not (catches(process.pid) and cpu_of(process.pid) >= 0.2):
        time.sleep(0.002)
    process.send_signal(signal.SIGINT)
    while process.poll() is None and catches(process.pid):
        time.sleep(0.0005)
    process.send_signal(signal.SIGINT)
    code = process.wait()
    if code == -signal.SIGINT and contents(folder) != before:
        yield "a second Ctrl-C left files behind"
    if code not in (-signal.SIGINT, 0, 1):
        yield f"a second Ctrl-C: status {code}"


def main():
    lekalo, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    cases = min(max(len(LINES), int(os.environ.get("LEKALO_CASES", "0"))), 10 * len(LINES))
    only = sys.argv[3] if len(sys.argv) > 3 else ""
    failures, most = 0, 0.0
    with tempfile.TemporaryDirectory() as folder:
        prepare(folder, source)
        for line in BEFORE:
            subprocess.run([lekalo] + line.split(), cwd=folder, capture_output=True)
        for trouble in gives_up(lekalo, folder) if not only else []:
            failures += 1
            print(trouble, flush=True)
        for trouble in ended_twice(lekalo, folder) if not only else []:
            failures += 1
            print(trouble, flush=True)
        lines = [line for line in LINES if re.search(only, line)]
        signals = [(lines[k % len(lines)], None) for k in range(cases if not only else max(len(lines), min(cases, 20)))]
        signals += [(line, moment) for line, moment in FOUND if re.search(only, line)]
        for line, after in signals:
            for name in contents(folder):
                if name.startswith("o."):
                    os.remove(os.path.join(folder, name))
            for word in line.split():
                if word.startswith("o."):
                    write(folder, word, "old")
            if after is None:
                after = CHANCE.choice([0, CHANCE.uniform(0, 0.1), CHANCE.uniform(0, 0.6)])
            trouble, code, late = trial(lekalo, folder, line, after)
            most = max(most, late)
            if only:
                print(f"{line}: after {after:.2f} s, status {code}, {late:.2f} s late", flush=True)
            if trouble:
                failures += 1
                print(f"lekalo {line}, Ctrl-C after {after:.3f} s of processor time: {trouble}", flush=True)
    print(f"{len(signals)} signals, the latest end after {most:.2f} s of processor time")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
