#!/usr/bin/env python3
"""Verifies everything that the command lines of tools/same_bytes.txt and of demo.sh write.

    tools/verify_written.py LEKALO [--only REGEX] [--jobs N] [--times]

Each line runs in a folder of its own with copies of examples/ and tests/corpus/ (as `corpus`) and a link `data` to
LEKALO_SHARED_DATA (lines that name it are left out without). `lekalo` in it is a step; after each, everything that it
wrote and that can be rechecked is verified as it is: placements with the status `optimal`, layouts, reports,
programs, exports, and results of fit with their turned profiles. The answer has to be exit status 0 with nothing left unchecked. What may be left all the same
stands in the table of docs/formats.md, "What is left unchecked"; a sentence that is not of its rows is a fault.

LEKALO_CASES is the number of lines drawn (0: all of them and demo.sh), LEKALO_SEED their seed.
"""

import argparse
import concurrent.futures
import collections
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def exceptions():
    """What may be left unchecked, and what its sentence says."""
    page = (ROOT / "docs/formats.md").read_text()
    table = page[page.index("### What is left unchecked"):].split("\n\n| ", 1)[1].split("\n\n", 1)[0]
    rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in table.splitlines()[2:]]
    return [(what, says.strip("`")) for what, says, *_ in rows]


def reason_of(words, status, rows):
    """The rows of all that an answer leaves unchecked, or None where some sentence is of no row. Bad input is a
    sentence of its own; what is refuted is never left."""
    if status == 4:
        return None
    if status == 1:
        left = re.findall(r"(?m)^  not rechecked +(.*)$", words) or \
            re.findall(r"(?m)^  note +(.*not rechecked.*|.*not proved.*)$", words)
    else:
        left = [words.strip()]
    found = [next((what for what, says in rows if says in sentence), None) for sentence in left]
    return sorted(set(found)) if found and None not in found else None


def outputs(argv):
    """Files that a step was to write with -o, and the words that verify needs beside."""
    def after(*names):
        for k, word in enumerate(argv):
            for name in names:
                if word == name and k + 1 < len(argv):
                    return argv[k + 1]
                if name.startswith("--") and word.startswith(name + "="):
                    return word[len(name) + 1:]
        return None
    return after


def is_json(text, *formats):
    try:
        document = json.loads(text)
    except ValueError:
        return None
    if not isinstance(document, dict):
        return None
    form = document.get("format")
    name = form.get("name") if isinstance(form, dict) else form
    return document if name in formats else None


def checks(argv, stdout, status):
    """The command lines of verify for what a step wrote; {} stands for a file with its standard output. `lekalo edit`
    has said itself, by its exit status, that the layout breaks rules."""
    if argv[0] == "edit" and status == 1:
        return []
    command, after = argv[0], outputs(argv)
    out = after("-o", "--output")
    found = []
    if command == "locate":
        for name, text in ((out, pathlib.Path(out).read_text(errors="replace") if out and os.path.isfile(out) else ""),
                           ("{}", stdout)):
            document = is_json(text, "lekalo-locate")
            if document and document["status"] == "optimal":
                found.append([name])
    elif command in ("nest", "edit"):
        if out and os.path.isfile(out) and is_json(pathlib.Path(out).read_text(errors="replace"), "lekalo-layout/1"):
            found.append([out])
            given = argv[1] if len(argv) > 1 and os.path.isfile(argv[1]) else None
            # A layout that was nested holds what was given; one that was edited may have other parts.
            if command == "nest" and given and is_json(pathlib.Path(given).read_text(errors="replace"),
                                                       "lekalo-layout/1"):
                found.append([out, "--layout", given])
        if is_json(stdout, "lekalo-nest", "lekalo-order") and out:
            found.append(["{}"])
            if order := is_json(stdout, "lekalo-order"):
                found += [[file["path"]] for file in order["outputs"]]
    elif command == "fit":  # a result names the files of its turned profile, beside which it lies
        if out and os.path.isfile(out):
            found.append([out])
        elif is_json(stdout, "lekalo-fit") and not json.loads(stdout).get("outputs"):
            found.append(["{}"])
    elif command == "heat":
        if out and os.path.isfile(out):
            found.append([out])
        elif is_json(stdout, "lekalo-heat"):
            found.append(["{}"])
    elif command in ("check", "show", "simulate", "pocket", "quote"):
        if is_json(stdout, "lekalo-check", "lekalo-show", "lekalo-simulate", "lekalo-pocket", "lekalo-quote"):
            if command != "pocket" or out:
                found.append(["{}"])
    elif command == "export" and out and os.path.isfile(out) and os.path.isfile(argv[1]):
        form = after("--format") or "layout"
        if form == "layout":
            return [[out]]
        if form in ("pdf", "png", "placements"):  # these say too little to be verified
            return []
        words = [out, "--layout", argv[1]]
        for option in ("--sheet", "--only", "--kerf"):
            if after(option):
                words += [option, after(option)]
        if after("--tolerance") and form in ("gcode", "hpgl"):
            words += ["--tolerance", after("--tolerance")]
        if form == "gcode" and after("--post"):
            words += ["--control", after("--post")]
        found.append(words)
    return found


def step(argv):
    """Called in the place of lekalo: runs it, and then verify on what it wrote."""
    program, log = os.environ["LEKALO_UNDER_TEST"], os.environ["LEKALO_VERIFIED"]
    ran = subprocess.run([program] + argv, stdout=subprocess.PIPE, stdin=None)
    sys.stdout.buffer.write(ran.stdout)
    sys.stdout.flush()
    try:
        wanted = checks(argv, ran.stdout.decode(errors="replace"), ran.returncode) if argv and ran.returncode in (0, 1) else []
    except OSError:
        wanted = []
    for words in wanted:
        with tempfile.NamedTemporaryFile(suffix=".json") as kept:
            kept.write(ran.stdout)
            kept.flush()
            verified = subprocess.run([program, "verify"] + [kept.name if w == "{}" else w for w in words],
                                      capture_output=True)
        with open(log, "a") as file:
            file.write(json.dumps({"step": argv, "verify": words, "status": verified.returncode,
                                   "words": verified.stderr.decode(errors="replace")}) + "\n")
    return ran.returncode


def demo_lines():
    """The steps of demo.sh without what sets it up and builds it."""
    text = (ROOT / "demo.sh").read_text()
    text = re.sub(r"(?m)^(\. .*|\"\$root.*|build_preset.*|cd \"\$root\")$", "", text)
    text = re.sub(r"(?m)^lekalo=.*$", "say() { :; }; lekalo=lekalo", text)
    return text.replace("web/node_modules", "nowhere")


def run_line(name, command, lekalo, keep):
    with tempfile.TemporaryDirectory() as home:
        files = pathlib.Path(home) / "files"
        files.mkdir()
        shutil.copytree(ROOT / "examples", files / "examples")
        shutil.copytree(ROOT / "tests/corpus", files / "corpus")
        if keep:
            (files / "data").symlink_to(keep)
        shim = pathlib.Path(home) / "bin/lekalo"
        shim.parent.mkdir()
        shim.write_text(f'#!/bin/sh\nexec "{sys.executable}" -B "{__file__}" --step "$@"\n')
        shim.chmod(0o755)
        log = pathlib.Path(home) / "log"
        log.touch()
        environment = dict(os.environ, PATH=f"{shim.parent}:{os.environ['PATH']}", HOME=home,
                           LEKALO_UNDER_TEST=lekalo, LEKALO_VERIFIED=str(log))
        ran = subprocess.Popen(["bash", "-c", command], cwd=files, env=environment, stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        used = os.wait4(ran.pid, 0)[2]
        ran.returncode = 0
        return name, [json.loads(line) for line in log.read_text().splitlines()], used.ru_utime + used.ru_stime


def lines_to_run(only):
    """The command lines that are drawn; those whose data are not there are none."""
    shared, count = os.environ.get("LEKALO_SHARED_DATA"), int(os.environ.get("LEKALO_CASES", "6"))
    count = min(count, 6 * int(os.environ.get("LEKALO_TIMES", "1000000")))
    lines = [("demo", demo_lines())]
    for line in (ROOT / "tools/same_bytes.txt").read_text().splitlines():
        found = re.match(r"([\w.-]+): +(.*)", line)
        writes = found and re.search(r"lekalo (locate|nest|edit|check|show|simulate|pocket|export|fit|heat) ", found[2])
        if writes and "--help" not in found[2] and (shared or "data/" not in found[2].replace("corpus/data/", "")):
            lines.append(found.groups())
    lines = [line for line in lines if re.search(only, line[0])]
    if count:
        lines = [line for line in lines if line[0] != "demo"]  # which takes minutes
        lines = random.Random(int(os.environ.get("LEKALO_SEED", "1"))).sample(lines, min(count, len(lines)))
    return lines, shared


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lekalo")
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--times", action="store_true", help="the processor seconds of each line")
    words = parser.parse_args()
    lines, shared = lines_to_run(words.only)
    lekalo, rows = os.path.abspath(words.lekalo), exceptions()
    faults, count, left = 0, collections.Counter(), collections.Counter()
    with concurrent.futures.ThreadPoolExecutor(words.jobs) as pool:
        for name, steps, seconds in pool.map(lambda line: run_line(*line, lekalo, shared), lines):
            if words.times:
                print(f"{name}: {seconds:.1f} s", flush=True)
            for one in steps:
                count["verified"] += 1
                if one["status"] == 0 and "not rechecked" not in one["words"]:
                    count["confirmed"] += 1
                    continue
                reasons = reason_of(one["words"], one["status"] or 1, rows)
                for reason in reasons or ():
                    left[reason] += 1
                if reasons is None:
                    faults += 1
                    print(f"{name}: lekalo {' '.join(one['step'])}\n  verify {' '.join(one['verify'])}: "
                          f"{one['status']}\n  {one['words'].strip()}", flush=True)
    print(f"{len(lines)} command lines, {count['verified']} results verified, {count['confirmed']} confirmed with "
          "nothing left unchecked")
    for reason, number in sorted(left.items()):
        print(f"{number} left unchecked: {reason}")
    return 1 if faults or not count["verified"] else 0


if __name__ == "__main__":
    sys.exit(step(sys.argv[2:]) if sys.argv[1:2] == ["--step"] else main())
