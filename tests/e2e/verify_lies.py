"""Changes every field and every input of a placement, and demands that `lekalo verify` does not confirm it.

    verify_lies.py LEKALO SOURCE_DIR

A result of each kind is made: convex with a program, an earlier result and deviations; regions with demands and a
program; a scan; drawings; trees. The result as it is has to give 0. Then each field is moved by the last digit,
negated, replaced and deleted, lists are turned round, and each input is changed by a byte; each time the exit
status has to be 1, 3 or 4. What may be confirmed all the same stands in HARMLESS with its reason, and is no more
than a tenth of the changes to fields that claim something. LEKALO_CASES is the number of changes drawn for each kind
(0: all of them), LEKALO_SEED their seed.
"""

import copy
import json
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

# Listed, without influence on the exit status (docs/formats.md, "What verify does with each field").
INFORMATION = [
    r"/(seed|work|version|method|run|warnings|alternatives_complete)(/.*)?$", r"/inputs/\d+/path$",
    r"/nc/(motions|scan_frame|notes)(/.*)?$", r"/nc/output/path$", r"/certificate_file/path$",
    r"/deviations/(path|sha256)$", r"/demands/deviation$", r"/demands/trade_off/\d+/(largest_bound|clearance|theta_deg)$",
    r"/contacts/\d+/(multiplier|part_edge|blank_edge)$",
    r"/scan/(median_spacing|widest|deepest|loss|assumptions|unknown|dropped)(/.*)?$",
]
# Where a change may leave every claim true, and why.
HARMLESS = [
    (r"/contacts(/.*)?$", "points for the reader, held to 1e-6 of the blank's size"),
    (r"/certificate/.*", "the bound is proved by what the certificate says now"),
    (r"/regions/.*", "an outline may move within its tolerance, and a full circle runs either way"),
    (r"/tolerances/.*", "a larger tolerance is true where it is still proved"),
    (r"/(min_allowance|window_deg/\d)$", "what was asked for is the asker's, if the pose keeps it"),
    (r"/mirror$", "what was allowed is the asker's, if the pose keeps it"),
    (r"/status$", "one that stopped early claims less"),
    (r"/(clearance|gap|shortfall|theta_deg|upper_bound|x|y|theta)$", "the last digit is within the rounding"),
    (r"/trim(/.*)?$", "nothing was trimmed"),
    (r"/locked$", "nothing was locked"),
    (r"/(nc|comparison|deviations|drawings|certificate_file)$",
     "deleted; what is left claims nothing of it, and is true"),
    (r"/inputs$", "the order of the inputs says nothing"),
    (r"/nc/(clearance|rounding_mm)$", "a smaller clearance is true, and a rounding that is still kept"),
    (r"/nc/work_offset$", "the program does not name it"),
    (r"/comparison/.*", "the last digit is within the rounding, and a larger shift is a bound"),
    (r"/deviations/.*", "the last digit is within the rounding"),
    (r"/scan/(guard|step|min_radius|max_dip)$", "the blank is proved under that assumption too"),
    (r"/demands/.*", "the last digit is within the rounding, or the demand is kept with less"),
    (r"/alternatives/.*", "the last digit is within the rounding"),
    (r"/inputs/\d+/dropped(/.*)?$", "points that lie on the line may be dropped"),
    (r"/inputs/\d+/(units|points)$", "regions do not count points"),
    (r"/drawings/.*", "a larger join tolerance sets nothing aside that is not listed"),
]


def sets(source):
    e, c = source / "examples", source / "tests/corpus/data"
    def copies(*paths):
        return [e / p for p in paths]
    plate = copies("localisation/example-1-part.csv", "localisation/example-1-blank.csv", "localisation/part.nc")
    region = copies("regions/bracket.json", "regions/casting.json", "regions/bracket-features.json",
                    "regions/bracket.nc")
    scan = copies("regions/flange.json", "regions/flange-scan.csv")
    first = ["locate", "--part", "example-1-part.csv", "--blank", "example-1-blank.csv", "-o", "first.json"]
    return [
        ("convex", plate, [first, first[:-1] + ["r.json", "--compare", "first.json", "--nc", "part.nc", "--nc-out",
                                                "o.nc", "--deviations", "d.csv", "--alternatives", "0.5"]]),
        ("demands", region, [["locate", "--part", "bracket.json", "--blank", "casting.json", "--features",
                              "bracket-features.json", "-o", "r.json"]]),
        ("program", region, [["locate", "--part", "bracket.json", "--blank", "casting.json", "--nc", "bracket.nc",
                              "--nc-out", "o.nc", "-o", "r.json"]]),
        ("scan", scan, [["locate", "--part", "flange.json", "--blank", "flange-scan.csv", "--uncertainty", "0.01",
                         "--min-radius", "4", "--min-allowance", "1", "--gap", "0.2", "-o", "r.json"]]),
        ("drawing", region + [c / "dxf_styles/freecad.dxf"],
         [["locate", "--part", "bracket.json", "--blank", "casting.json", "--drawing", "placed.dxf", "--gap", "0.05"],
          ["locate", "--part", "placed.dxf", "--part-layers", "PART", "--blank", "placed.dxf", "--blank-layers",
           "BLANK", "--window", "-2", "2", "--gap", "0.05", "-o", "r.json"]]),
    ]


def leaves(value, path=""):
    yield path, value
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, f"{path}/{key}")
    elif isinstance(value, list):
        for k, inner in enumerate(value):
            yield from leaves(inner, f"{path}/{k}")


def changed(document, path, change):
    made = copy.deepcopy(document)
    *around, last = path.split("/")[1:]
    at = made
    for key in around:
        at = at[int(key)] if isinstance(at, list) else at[key]
    key = int(last) if isinstance(at, list) else last
    if change == "delete":
        del at[key]
    else:
        at[key] = change(at[key])
    return made


def changes_of(value):
    yield "delete"
    if isinstance(value, bool):
        yield lambda v: not v
    elif isinstance(value, (int, float)):
        yield lambda v: math.nextafter(v, math.inf)
        yield lambda v: -v - (v == 0)
        yield lambda v: v + 0.5
    elif isinstance(value, str):
        yield lambda v: v + "x"
    elif isinstance(value, list) and len(value) > 1:
        yield lambda v: v[::-1]
    elif value is None:
        yield lambda v: 1


def matches(rules, path):
    return any(re.match(rule if isinstance(rule, str) else rule[0], path) for rule in rules)


def main(lekalo, source):
    count = min(int(os.environ.get("LEKALO_CASES", "40")), 40 * int(os.environ.get("LEKALO_TIMES", "1000000")))
    draw = random.Random(int(os.environ.get("LEKALO_SEED", "1")))
    claims = confirmed = everything = 0
    faults = []
    for name, files, commands in sets(pathlib.Path(source)):
        with tempfile.TemporaryDirectory() as folder:
            for file in files:
                shutil.copy(file, folder)
            def run(words):
                return subprocess.run([lekalo] + words, cwd=folder, capture_output=True, timeout=120)
            for words in commands:
                run(words)
            result = pathlib.Path(folder) / "r.json"
            true = run(["verify", "r.json"])
            if true.returncode != 0:
                faults.append(f"{name}: the result as it is gives {true.returncode}: {true.stderr.decode()[:400]}")
                continue
            document = json.loads(result.read_text())
            walk = [(path, change) for path, value in leaves(document) if path for change in changes_of(value)]
            proofs = [step for step in walk if step[0].startswith("/certificate/")]
            walk = [step for step in walk if not step[0].startswith("/certificate/")] + draw.sample(
                proofs, min(len(proofs), 40))
            if count:
                walk = draw.sample(walk, min(count, len(walk)))
            for path, change in walk:
                made = changed(document, path, change)
                if made == document:
                    continue
                result.write_text(json.dumps(made))
                status = run(["verify", "r.json"]).returncode
                everything += 1
                information = matches(INFORMATION, path)
                claims += not information
                if status in (1, 3, 4) or information:
                    continue
                confirmed += 1
                if status != 0 or not matches(HARMLESS, path):
                    faults.append(f"{name}: {path} changed to {at_path(made, path)!r} gives {status}")
            result.write_text(json.dumps(document))
            for entry in document["inputs"]:
                file = pathlib.Path(folder) / entry["path"]
                whole = file.read_bytes()
                for bytes_now in (whole + b" ", whole[:-2], b""):
                    file.write_bytes(bytes_now)
                    status = run(["verify", "r.json"]).returncode
                    if status not in (3, 4):
                        faults.append(f"{name}: {entry['path']} changed gives {status}")
                file.write_bytes(whole)
    print(f"{everything} changes, {claims} of claims, {confirmed} of these confirmed")
    for fault in faults:
        print(fault)
    if confirmed * 10 > claims:
        faults.append("more than a tenth")
        print("more than a tenth of the changed claims are confirmed")
    return 1 if faults else 0


def at_path(document, path):
    at = document
    for key in path.split("/")[1:]:
        if isinstance(at, list):
            at = at[int(key)] if int(key) < len(at) else None
        else:
            at = at.get(key) if isinstance(at, dict) else None
    return str(at)[:60]


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2]))
