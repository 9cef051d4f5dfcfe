#!/usr/bin/env python3
"""Mutants of the checker, compiled in once and chosen at run time: docs/measurements/mutation.md.

    tools/mutants.py write FOLDER            a copy of src/verify in FOLDER/verify whose every place can be mutated,
                                             and FOLDER/mutants.json, the list of them; CMake calls it
    tools/mutants.py run FOLDER RUNNER       runs the tests against each, and lists those that survive
        --only REGEX      mutants whose place (file:line) matches
        --tests REGEX     tests whose name matches, to see soon what a new test kills
        --jobs N          runners side by side (the number of processors)
        --minutes M       no new mutant after so many
        --longest S       tests that take more seconds of a processor are left out
        --most S          a mutant that outlives tests of so many seconds counts as a survivor
        --explained       also those that tests/mutation/explained.txt explains

A mutant is killed by the first test that fails, takes ten times its time, or wants 3 GB. A test is tried only on
the mutants that it asked when it ran untouched; a mutant that no test asks survives at once. Exit status 1 when a
survivor is not explained, or an explanation fits no mutant.
"""
import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import queue
import re
import resource
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SOURCES = os.path.join(ROOT, "src", "verify")
EXPLAINED = os.path.join(ROOT, "tests", "mutation", "explained.txt")
CONSTANTS = 1000  # drawn of all, by SEED
SEED = 1
BLOCK = 64  # a file's mutants begin at a multiple, so that a change of one file leaves the numbers of most others

SPACED = re.compile(r" (<=|>=|==|!=|<|>|&&|\|\|)(?=[ \n])")
EXTREME = re.compile(r"\bstd::(min|max)(<[\w:]+>)?(?=\()")
NUMBER = re.compile(r"(?<![\w.'\"])(?<!p[-+])(0[xX][0-9a-fA-F']+|\d[\d']*(?:\.\d*)?(?:[eE][+-]?\d+)?)([uUlLfF]*)(?![\w.'\"])")
# What complains keeps a sentence and is false, so that nothing changes where it counts as false.
COMPLAINT = re.compile(r"\s*(complain|fail)\(")
# A constant of a file becomes a function behind its name, so that its mutant can be chosen later than it is made.
NAMED = re.compile(r"^(?:inline |static )?constexpr ([\w:]+(?: [\w:]+)?) (k\w+) = ([^{},]*);(.*)$")


def blanked(text):
    """The text with comments, literals of text and lines of the preprocessor as spaces."""
    pattern = re.compile(
        r"//[^\n]*|/\*.*?\*/|R\"\w*\(.*?\)\w*\"|\"(?:\\.|[^\"\\\n])*\"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])'|^[ \t]*#[^\n]*",
        re.S | re.M)
    return pattern.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)


def begins_chain(code, at, word):
    """Whether no other operator of this kind stands before this one in its chain; its operand is then whole."""
    depth = 0
    while at > 0:
        at -= 1
        c = code[at]
        if c in ")]}":
            depth += 1
        elif c in "([{":
            depth -= 1
            if depth < 0:
                return True
        elif depth == 0:
            two = code[at - 1:at + 1]
            if c in ";,?=" and two not in ("==", "<=", ">=", "!="):
                return True
            if two == word:
                return False
            if two == "||" or code[at - 6:at] == "return":
                return True
    return True


def fixed_number(line, start, end):
    """Whether the compiler wants the number: sizes of arrays, arguments of templates, labels, enumerators."""
    before, after = line[:start], line[end:]
    return (re.match(r"\s*(case|enum|static_assert|template|using|virtual)\b", line) or after.startswith(">")
            or ("constexpr" in line and named_constants(line) == line)
            or re.search(r"(?:get|array)<[^<>()]*$", before) or re.search(r"\w \w+\[$", before)
            or re.match(r"\s*k?\w+ = \d+,", line))


def places(code):
    """(start, end, kind, replacement with {k}, number of mutants) of every place in blanked code."""
    found = []
    for match in SPACED.finditer(code):
        word, start, end = match.group(1), match.start(1), match.end(1)
        if word == "<" and code[:start].rstrip().endswith("template"):
            continue
        if word in ("&&", "||"):
            glue, kind = ("|", "and") if word == "&&" else ("&", "or")
            if not (word == "||" and COMPLAINT.match(code, end)):
                found.append(
                    (start, end, kind + " right", f"{word} ::lekalo::mutants::Right<{{k}}>{{{{}}}} {glue}", 1))
            if begins_chain(code, start, word):
                found.append((start, start, kind + " left", f"{glue} ::lekalo::mutants::Left<{{k}}>{{{{}}}} ", 1))
        else:
            count = 1 if word in ("==", "!=") else 2
            found.append((start, end, word, f"{word} ::lekalo::mutants::Relation<{{k}}>{{{{}}}} {word}", count))
    for match in EXTREME.finditer(code):
        name = "least" if match.group(1) == "min" else "greatest"
        given = ", " + match.group(2)[1:-1] if match.group(2) else ""
        found.append((match.start(), match.end(), match.group(1), f"::lekalo::mutants::{name}<{{k}}{given}>", 1))
    for match in NUMBER.finditer(code):
        first = code.rfind("\n", 0, match.start()) + 1
        line = code[first:code.find("\n", first)]
        if not fixed_number(line, match.start() - first, match.end() - first):
            found.append((match.start(), match.end(), "number", "::lekalo::mutants::number<{k}>(" +
                          match.group().replace("{", "").replace("}", "") + ")", 1))
    return sorted(found)


def named_constants(line):
    """A constant at the beginning of a line as a function and a macro; within a function simply not constant."""
    named = NAMED.match(line)
    if named:
        kind, name, value, rest = named.groups()
        return f"[[maybe_unused]] inline {kind} {name}_is() {{ return {value}; }}{rest}\n#define {name} ({name}_is())\n#line"
    # A const number would still be the compiler's to compute.
    return re.sub(r"^(\s+)constexpr (?!.*\[)", r"\1[[maybe_unused]] ", line)


def source_files():
    for folder, _, names in sorted(os.walk(SOURCES)):
        for name in sorted(names):
            if name.endswith((".cpp", ".hpp")):
                yield os.path.relpath(os.path.join(folder, name), SOURCES)


def line_at(text, at):
    """The line about a place, and where in it the place is."""
    first = text.rfind("\n", 0, at) + 1
    return text[first:text.find("\n", first)], at - first


def lot(name, text, start):
    """What a number draws: it keeps its lot as long as its line stands in this file."""
    line, column = line_at(text, start)
    return hashlib.sha256(f"{SEED} {name} {column - len(line) + len(line.lstrip())} {line.strip()}".encode()).digest()


def draw(texts):
    """Every place of every file, but of the numbers as many as CONSTANTS says, which have the least lots."""
    everything = {name: places(blanked(text)) for name, text in texts.items()}
    lots = sorted((lot(name, texts[name], place[0]), name, place) for name, found in everything.items()
                  for place in found if place[2] == "number")
    left = {(name, place[0]) for _, name, place in lots[CONSTANTS:]}
    return {name: [place for place in found if place[2] != "number" or (name, place[0]) not in left]
            for name, found in everything.items()}


def write(folder):
    texts = {}
    for name in source_files():
        with open(os.path.join(SOURCES, name), encoding="utf-8") as file:
            texts[name] = file.read()
    mutants, edits = {}, collections.defaultdict(list)
    first = 0
    for name, drawn in draw(texts).items():
        first = (first + BLOCK - 1) // BLOCK * BLOCK
        for start, end, kind, replacement, count in drawn:
            line, column = line_at(texts[name], start)
            fate = {"<": ["<=", "not <"], "<=": ["<", "not <="], ">": [">=", "not >"], ">=": [">", "not >="]}.get(
                kind, ["not " + kind] if kind in ("==", "!=") else [kind])
            edits[name].append((start, end, replacement.format(k=first)))
            for i in range(count):
                mutants[first] = {"file": name, "line": texts[name].count("\n", 0, start) + 1, "column": column + 1,
                                  "kind": fate[i], "source": line.strip()}
                first += 1
    for name, text in texts.items():
        for start, end, replacement in reversed(edits[name]):
            text = text[:start] + replacement + text[end:]
        lines = text.split("\n")
        out = [f'#include "mutation/mutants.hpp"\n#line 1 "{os.path.join(SOURCES, name)}"']
        if name.endswith(".hpp"):
            out.insert(0, "#pragma once")
        for number, line in enumerate(lines, 1):
            if line == "#pragma once":
                line = ""
            line = named_constants(line)
            out.append(line + f" {number + 1}" if line.endswith("#line") else line)
        put(os.path.join(folder, "verify", name), "\n".join(out))
    put(os.path.join(folder, "mutants.json"), json.dumps(mutants, indent=0))
    print(first)


def put(path, text):
    """Writes a file, unless it says so already: what is compiled of it would be compiled again."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            if file.read() == text:
                return
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


class Runner:
    def __init__(self, program):
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def end(self):
        self.process.stdin.close()
        self.process.wait()

    def ask(self, *words):
        self.process.stdin.write(" ".join(str(word) for word in words) + "\n")
        self.process.stdin.flush()
        return self.process.stdout.readline().split()


def tests_of(program):
    listed = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
    suite = ""
    for line in listed.splitlines():
        word = line.split("#")[0].strip()
        if line.startswith("  "):
            yield suite + word
        elif word.endswith("."):
            suite = word


def place_of(mutant):
    return f"{mutant['file']}:{mutant['line']}"


def key_of(mutant):
    """What an explanation names: it holds as long as the line does, wherever it moves."""
    return f"{mutant['file']} | {mutant['kind']} | {mutant['source']}"


def explanations():
    """Keys, each with its reason on an indented line below; lines of # are comments."""
    found, key = {}, None
    if os.path.exists(EXPLAINED):
        with open(EXPLAINED, encoding="utf-8") as file:
            for line in file:
                if line.startswith("  ") and key:
                    found[key] = (found[key] + " " + line.strip()).strip()
                elif line.strip() and not line.startswith("#"):
                    key = line.strip()
                    found[key] = ""
    return found


class Trial:
    """What is known of the tests while the mutants run."""

    def __init__(self, tests):
        self.tests = tests            # name: seconds
        self.askers = collections.defaultdict(list)
        self.kills = collections.defaultdict(collections.Counter)  # of a file
        self.broken = False           # a test fails without a mutant

    def order(self, mutant, file):
        kills = self.kills[file]
        return sorted(self.askers[mutant], key=lambda test: (self.tests[test] + 0.01) / (kills[test] + 0.1))

    def patience(self, test):
        return max(0.5, 10 * self.tests[test])


def run(arguments):
    with open(os.path.join(arguments.folder, "mutants.json"), encoding="utf-8") as file:
        mutants = {int(k): mutant for k, mutant in json.load(file).items()}
    os.environ["LEKALO_RS274_ANSWERS"] = os.path.join(arguments.folder, "rs274")
    os.makedirs(os.environ["LEKALO_RS274_ANSWERS"], exist_ok=True)
    runners = queue.SimpleQueue()
    for _ in range(arguments.jobs):
        runners.put(Runner(arguments.runner))

    def with_runner(act):
        runner = runners.get()
        try:
            return act(runner)
        finally:
            runners.put(runner)

    started = time.monotonic()
    trial = Trial({})
    pool = concurrent.futures.ThreadPoolExecutor(arguments.jobs)
    names, long_ones = [name for name in tests_of(arguments.runner) if re.search(arguments.tests, name)], []
    for name, answer in zip(names, pool.map(lambda name: with_runner(lambda r: r.ask("reach", 600, name)), names)):
        if answer[0] != "passed":
            print(f"{name} fails without a mutant and is left out")
            trial.broken = True
            continue
        if float(answer[1]) > arguments.longest:
            long_ones.append(f"{name} ({float(answer[1]):.1f} s)")
            continue
        trial.tests[name] = float(answer[1])
        for mutant in answer[2:]:
            trial.askers[int(mutant)].append(name)
    if long_ones:
        print(f"left out, since they take more than {arguments.longest:g} s: {', '.join(long_ones)}")
    reasons = explanations()
    chosen = [k for k, m in mutants.items() if re.search(arguments.only, place_of(m))
              and (arguments.explained or key_of(m) not in reasons)]
    print(f"{len(names)} tests, {sum(trial.tests.values()):.0f} s; {len(mutants)} mutants, {len(chosen)} to try",
          flush=True)

    def killed_by(k):
        if time.monotonic() - started > 60 * arguments.minutes:
            return "not tried"
        file, spent = mutants[k]["file"], 0.0
        for test in trial.order(k, file):
            spent += trial.tests[test]
            if spent > arguments.most:
                break
            if with_runner(lambda r: r.ask("try", k, trial.patience(test), test)) != ["passed"]:
                trial.kills[file][test] += 1
                return test
        print(told(k), flush=True)
        return None

    def told(k):
        mutant = mutants[k]
        return (f"{place_of(mutant)}:{mutant['column']}: {mutant['kind']}: {mutant['source']}"
                + ("" if trial.askers[k] else "  (no test comes here)")
                + ("  explained" if key_of(mutant) in reasons else ""))

    fates = dict(zip(chosen, pool.map(killed_by, chosen)))
    while not runners.empty():
        runners.get().end()
    report(mutants, fates, reasons, trial.broken)


def report(mutants, fates, reasons, broken):
    table, survivors = collections.defaultdict(collections.Counter), []
    for k, fate in fates.items():
        word = "survived" if fate is None else "not tried" if fate == "not tried" else "killed"
        table[mutants[k]["file"]][word] += 1
        if word == "survived":
            survivors.append(k)
    print()
    total = collections.Counter()
    rooms = collections.defaultdict(collections.Counter)
    for file, counts in table.items():
        rooms[file.split("/")[0]] += counts
        total += counts
    for name, counts in sorted(table.items()) + sorted(rooms.items()):
        print(f"{name:40} {counts['killed']:5} killed {counts['survived']:4} survived {counts['not tried']:5} not tried")
    known = [m for m in mutants.values() if key_of(m) in reasons]
    print(f"{'all':40} {total['killed']:5} killed {total['survived']:4} survived {total['not tried']:5} not tried; "
          f"{len(known)} of {len(mutants)} explained")
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{used.ru_utime + used.ru_stime:.0f} s of processor time")
    # A number that another draw left out may come back.
    stray = [key for key in reasons if key not in {key_of(m) for m in mutants.values()} and " | number | " not in key]
    for key in stray:
        print(f"explained, but there is no such mutant: {key}")
    bare = [key for key, reason in reasons.items() if not reason]
    for key in bare:
        print(f"explained without a reason: {key}")
    open_ones = [k for k in survivors if key_of(mutants[k]) not in reasons]
    # The threads of the pool wait for nothing any more; the runners end with their stdin.
    sys.exit(1 if broken or open_ones or stray or bare or total["not tried"] else 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("write").add_argument("folder")
    runs = commands.add_parser("run")
    runs.add_argument("folder")
    runs.add_argument("runner")
    runs.add_argument("--only", default="")
    runs.add_argument("--tests", default="")
    runs.add_argument("--jobs", type=int, default=os.cpu_count())
    runs.add_argument("--minutes", type=float, default=85)
    runs.add_argument("--longest", type=float, default=6)
    runs.add_argument("--most", type=float, default=20)
    runs.add_argument("--explained", action="store_true")
    arguments = parser.parse_args()
    write(arguments.folder) if arguments.command == "write" else run(arguments)


if __name__ == "__main__":
    main()
