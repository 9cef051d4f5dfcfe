"""Puts extreme numbers in place of those of the example files, and demands that lekalo answers or refuses.

    number_sweep.py LEKALO SOURCE_DIR

An exit status of 4 says that lekalo refuted itself, which no file may bring about; neither may one end it
by a signal. LEKALO_CASES is the number of mutants drawn (0: all of them, which takes hours), LEKALO_SEED their seed.
Mutants that take longer than 20 s are stopped and counted; how long a file may take is another test's question.
"""

import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

EXTREMES = ["1e-500", "1e-999999", "1e-330", "1e-99", "1e-12", "1e-7", "-0", "0", "0.5", "-1", "1e3", "-1e3",
            "3600", "-1e5", "262144", "-524288", "1e6", "1e8", "-999999999", "1e9", "-1e9", "1000000001",
            "2147483648", "4294967296", "1e15", "9007199254740993", "9223372036854775808",
            "99999999999999999999", "1e308", "-1e308", "1e999", "nan", "NaN", "Infinity",
            "3." + "14159265" * 120]
NUMBER = re.compile(rb"(?<![\w.#])[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?(?![\w.])")
WAIT = 20

BRACKET = ["locate", "--part", "bracket.json", "--blank", "casting.json", "--work", "300", "-o", "r.json"]
REGIONS = ["regions/bracket.json", "regions/casting.json"]
ORDER = ["../tests/corpus/data/layouts/order.json"]
WRITTEN = "../tests/corpus/data/written-0.1/"
JUDGED = "../tests/corpus/data/attack/simulate/"
SIMULATE = ["simulate", "--pocket", "p.json", "--tool", "6", "--stepover", "40%", "--json"]
# The files of `examples` that a line reads, the first of them those whose numbers change, and its words.
LINES = [
    (2, ["localisation/example-1-part.csv", "localisation/example-1-blank.csv"],
     ["locate", "--part", "example-1-part.csv", "--blank", "example-1-blank.csv", "-o", "r.json"]),
    (2, ["localisation/example-5-part.csv", "localisation/example-5-blank.csv"],
     ["locate", "--part", "example-5-part.csv", "--blank", "example-5-blank.csv", "--units", "inch",
      "--min-allowance", "0.2", "-o", "r.json"]),
    (2, REGIONS, BRACKET),
    (1, ["regions/bracket-features.json"] + REGIONS, BRACKET + ["--features", "bracket-features.json"]),
    (2, ["regions/bracket-features.json"] + REGIONS,
     BRACKET + ["--features", "bracket-features.json", "--criterion", "largest", "--give-up", "0.1"]),
    (1, ["regions/bracket.nc"] + REGIONS, BRACKET + ["--nc", "bracket.nc", "--nc-out", "o.nc"]),
    (1, ["regions/flange.json"],
     ["locate", "--part", "flange.json", "--blank", "flange.json", "--window", "-1", "1", "--work", "300",
      "-o", "r.json"]),
    (2, ["regions/flange.json", "regions/flange-scan.csv"],
     ["locate", "--part", "flange.json", "--blank", "flange-scan.csv", "--uncertainty", "0.01",
      "--min-radius", "4", "--work", "100", "-o", "r.json"]),
    (1, ["../tests/corpus/data/dxf_styles/librecad.dxf"],
     ["locate", "--part", "librecad.dxf", "--blank", "librecad.dxf", "--window", "0", "0", "--work", "100",
      "-o", "r.json"]),
    (1, ["../tests/corpus/data/contours/ezdxf-r2010-lines.dxf"],
     ["locate", "--part", "ezdxf-r2010-lines.dxf", "--blank", "ezdxf-r2010-lines.dxf", "-o", "r.json"]),
    (1, ["layouts/shoes.json"], ["check", "shoes.json", "--json"]),
    (1, ORDER, ["check", "order.json", "--json"]),
    (1, ORDER, ["export", "order.json", "-o", "e.json"]),
    (1, ["orders/begun.json"], ["export", "begun.json", "--format", "gcode", "--kerf", "0.2", "--feed",
                                "2000", "-o", "e.nc"]),
    (1, ["orders/begun.json"], ["export", "begun.json", "--format", "dxf", "-o", "e.dxf"]),
    (2, ["layouts/shoes.commands", "layouts/shoes.json"],
     ["edit", "shoes.json", "--commands", "shoes.commands", "-o", "e.json"]),
    (1, ["orders/begun.json"], ["nest", "begun.json", "--work", "1", "--threads", "1", "-o", "n.json"]),
    (1, ORDER, ["nest", "order.json", "--work", "1", "--threads", "1", "-o", "n.json"]),
    (1, ["orders/frames.json"], ["nest", "frames.json", "--work", "1", "--threads", "1", "-o", "n.json"]),
    (1, ["../tests/corpus/pockets/L.json"],
     ["pocket", "L.json", "--tool", "6", "--depth", "3", "--feed", "900", "-o", "p.nc"]),
    (1, ["../tests/corpus/pockets/keyhole.json"],
     ["pocket", "keyhole.json", "--tool", "6", "--depth", "3", "--feed", "900", "-o", "p.nc"]),
    (2, [WRITTEN + "tree-part.json", WRITTEN + "tree-blank.json"],
     ["locate", "--part", "tree-part.json", "--blank", "tree-blank.json", "--work", "100", "-o", "r.json"]),
    (1, ["localisation/part.nc", "localisation/example-1-part.csv", "localisation/example-1-blank.csv"],
     ["locate", "--part", "example-1-part.csv", "--blank", "example-1-blank.csv", "--nc", "part.nc",
      "--nc-out", "o.nc", "-o", "r.json"]),
    (1, ["regions/flange-scan.csv", "regions/flange.json"],
     ["locate", "--part", "flange.json", "--blank", "flange-scan.csv", "--uncertainty", "0.01",
      "--min-radius", "4", "--work", "10", "-o", "r.json"]),
    (1, ["../tests/corpus/data/dxf/polylines.dxf"], ["export", "polylines.dxf", "-o", "e.json"]),
    (1, ["../tests/corpus/data/dxf_styles/freecad.dxf"], ["check", "freecad.dxf", "--json"]),
    (1, ["../tests/corpus/data/dxf_styles/qcad_inch.dxf"],
     ["locate", "--part", "qcad_inch.dxf", "--blank", "qcad_inch.dxf", "--window", "0", "0", "--work", "100",
      "-o", "r.json"]),
    (2, ["../tests/corpus/data/hides/small.commands", "../tests/corpus/data/hides/small.json"],
     ["edit", "small.json", "--commands", "small.commands", "-o", "e.json"]),
    (1, ["orders/cupboard.json"], ["nest", "cupboard.json", "--work", "1", "--threads", "1", "-o", "n.json"]),
    (1, ["orders/coats.json"], ["nest", "coats.json", "--work", "1", "--threads", "1", "-o", "n.json"]),
    (1, ["orders/bags.json"], ["nest", "bags.json", "--work", "1", "--threads", "1", "-o", "n.json"]),
    (1, ["layouts/shoes.json"], ["show", "shoes.json", "--json"]),
    (1, ["orders/begun.json"], ["export", "begun.json", "--format", "hpgl", "-o", "e.plt"]),
    (1, ["../tests/corpus/pockets/islands.json"],
     ["pocket", "islands.json", "--tool", "4", "--depth", "3", "--feed", "900", "-o", "p.nc"]),
    (1, ["pockets/cover.json"], ["pocket", "cover.json", "--tool", "6", "--depth", "3", "--feed", "900",
                                 "-o", "p.nc"]),
    (1, [JUDGED + "p.json", JUDGED + "plain_good.ngc"], SIMULATE + ["plain_good.ngc"]),
    (1, [JUDGED + "plain_good.ngc", JUDGED + "p.json"], SIMULATE + ["plain_good.ngc"]),
    (1, [JUDGED + "cut_good.ngc", JUDGED + "p.json"], SIMULATE + ["cut_good.ngc"]),
]


def mutants(examples):
    """Every (line, file, place of the number, extreme)."""
    for line, (mutable, files, _) in enumerate(LINES):
        for name in files[:mutable]:
            with open(os.path.join(examples, name), "rb") as file:
                places = [m.span() for m in NUMBER.finditer(file.read())]
            for place in places:
                for extreme in EXTREMES:
                    yield line, name, place, extreme


def run(lekalo, examples, mutant):
    """The exit status (None: stopped), what stderr says, and what was changed."""
    line, changed, (begin, end), extreme = mutant
    _, files, words = LINES[line]
    with tempfile.TemporaryDirectory(prefix="lekalo-sweep-") as folder:
        for name in files:
            shutil.copy(os.path.join(examples, name), folder)
        path = os.path.join(folder, os.path.basename(changed))
        with open(path, "rb") as file:
            text = file.read()
        os.chmod(path, 0o644)
        with open(path, "wb") as file:
            file.write(text[:begin] + extreme.encode() + text[end:])
        at = "%s:%d: %s -> %s" % (changed, text.count(b"\n", 0, begin) + 1, text[begin:end].decode(),
                                  extreme[:30])
        try:
            ran = subprocess.run([lekalo] + words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 timeout=WAIT, check=False)
        except subprocess.TimeoutExpired:
            return None, "", at
        return ran.returncode, ran.stderr.decode("utf-8", "replace"), at


def main():
    lekalo, source = os.path.abspath(sys.argv[1]), sys.argv[2]
    examples = os.path.join(source, "examples")
    count, seed = int(os.environ.get("LEKALO_CASES", "60")), int(os.environ.get("LEKALO_SEED", "1"))
    count = min(count, 60 * int(os.environ.get("LEKALO_TIMES", "1000000")))
    by_line = {}
    for mutant in mutants(examples):
        by_line.setdefault(mutant[0], []).append(mutant)
    print("seed %d, %s" % (seed, "%d mutants" % count if count else "all mutants"))
    draw = random.Random(seed)
    # Lines take turns, so that long files do not have all the cases.
    lines = sorted(by_line)
    drawn = ([draw.choice(by_line[lines[k % len(lines)]]) for k in range(count)] if count else
             [mutant for line in lines for mutant in by_line[line]])
    wrong = slow = 0
    statuses = {}
    for mutant in drawn:
        status, said, at = run(lekalo, examples, mutant)
        if status is None:
            slow += 1
            print("slow: lekalo %s\n  %s" % (" ".join(LINES[mutant[0]][2]), at), flush=True)
            continue
        statuses[status] = statuses.get(status, 0) + 1
        # A command that breaks a rule of the mutant is not admitted, with 4: that is no mistake.
        if status not in (0, 1, 2, 3) and not (status == 4 and ": not admitted: " in said):
            wrong += 1
            print("exit status %d: lekalo %s\n  %s\n  %s" % (status, " ".join(LINES[mutant[0]][2]), at,
                                                           said.strip()[-600:]), flush=True)
    print("exit statuses %s, %d slow, %d wrong" % (sorted(statuses.items()), slow, wrong))
    return 1 if wrong else 0


sys.exit(main())
