"""Changes every field and every input of what lekalo writes, and demands that `lekalo verify` does not confirm it.

    verify_lies.py LEKALO SOURCE_DIR [--only REGEX] [--jobs N] [--excused]

A result of each kind (kinds.py) is made; as it is it gives 0 (or 1, where docs/formats.md says that a claim is left
unchecked). Then one thing at a time is changed (changes.py), and the exit status has to be 3 or 4 (or 2, where a sheet
that is asked for is no longer one of the layout), or 1 with a claim that is named as unchecked. What is confirmed all
the same has to be information (docs/formats.md), or a change that leaves every claim true: truth.py and what it is
helped by decide that by computing of their own, which shares nothing with the checker. These are at most a tenth of all
changes of claims; of the few that are drawn, by as many more as chance makes once in fifty draws.

LEKALO_CASES is the number of changes drawn for each kind (0: all of them), LEKALO_SEED their seed. The table at the
end has a line for each kind: changes of claims and inputs, refused, weak (exit status 1), excused (confirmed and
true), missed (confirmed and not true).
"""

import argparse
import collections
import concurrent.futures
import itertools
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

import changes
import kinds
import strangers
import truth


class Folder:
    """A copy of the files of a kind, in which the program runs."""

    def __init__(self, lekalo, path):
        self.lekalo, self.path = lekalo, pathlib.Path(path)

    def run(self, words):
        return subprocess.run([self.lekalo] + words, cwd=self.path, capture_output=True, timeout=300)

    def read(self, name):
        return (self.path / name).read_bytes().decode(errors="surrogateescape")

    def write(self, name, text):
        (self.path / name).write_bytes(text.encode(errors="surrogateescape"))

    def make(self, kind, source):
        for file in kind.files:
            shutil.copy(source / file, self.path)
        for name, text in kind.written.items():
            self.write(name, text)
        for words in kind.commands:
            if callable(words):
                words(self)
                continue
            out = [word for word in words if word.startswith(">")]
            words = [word for word in words if not word.startswith(">")]
            ran = self.run(words)
            if ran.returncode not in (0, 1):
                raise RuntimeError(f"{kind.name}: {' '.join(words)}: {ran.stderr.decode()}")
            for name in out:
                (self.path / name[1:]).write_bytes(ran.stdout)


def claim_of(change):
    """The field that a change is of, whatever its place in a list, and the way in which it was changed."""
    return re.sub(r"\d+", "*", change.path), re.sub(r"\d+", "*", change.how)


def by_claims(made, count, draw):
    """Some of the changes: of every field each way of changing it once, then each once more, until there are enough.
    Drawn by their number alone, nine of ten would be coordinates and nodes of proofs, one like the other."""
    groups = collections.defaultdict(list)
    for change in draw.sample(made, len(made)):
        groups[claim_of(change)].append(change)
    rounds = itertools.zip_longest(*groups.values())
    return [change for one in rounds for change in one if change is not None][:count]


class Walk:
    """One kind: what is changed, and what came of it."""

    def __init__(self, kind, lekalo, source, draw, count):
        self.kind, self.lekalo = kind, lekalo
        self.home = tempfile.TemporaryDirectory()
        folder = Folder(lekalo, self.home.name)
        folder.make(kind, source)
        self.faults, self.weak_words = [], collections.Counter()
        self.count, self.excused = collections.Counter(), collections.Counter()
        ran = folder.run(kind.verify)
        if ran.returncode != kind.base:
            self.faults.append(f"as it is it gives {ran.returncode}: {ran.stderr.decode()[:600]}")
        self.text = folder.read(kind.target)
        # Half of the numbers of a program or a table are told to more digits than anything claims.
        count = (count + 1) // 2 if kind.form not in ("json", "stl") else count
        self.oracle = kind.oracle(truth.Context(folder, kind, self.text))
        self.changes = [c for c in kinds.all_changes(kind, self.text)]
        if count:
            self.changes = by_claims(self.changes, count, draw)
        self.others = self.of_inputs(folder)
        if count:
            self.others = draw.sample(self.others, min(count // 2 + 1, len(self.others)))
        self.swaps = list(self.of_strangers(folder))
        if count:
            self.swaps = draw.sample(self.swaps, min((count + 3) // 4, len(self.swaps)))

    def of_inputs(self, folder):
        """Every input as bytes: changed, cut off, empty, another file of the set, gone."""
        made = []
        for name in self.kind.inputs:
            text = folder.read(name)
            at = len(text) // 2
            bit = text[:at] + chr(ord(text[at]) ^ 1) + text[at + 1:]
            for how, other in (("a bit turned", bit), ("a blank more", text + " "), ("cut off", text[:-2]),
                               ("empty", ""), ("{}", "{}")):
                made.append((name, how, other))
            for other in self.kind.inputs:
                if other != name and folder.read(other) != text:
                    made.append((name, "exchanged for " + other, folder.read(other)))
            made.append((name, "gone", None))
        return made

    def of_strangers(self, folder):
        """Every file that the result was made from, or is held against, exchanged for another of its kind; and where
        the result says its digest, that with it, so that nothing but the meaning is amiss."""
        named = self.kind.inputs + [word for word in self.kind.verify[1:] if (folder.path / word).is_file()]
        for name in dict.fromkeys(named):
            if name in (self.kind.target, self.kind.report_of):
                continue
            text = folder.read(name)
            for how, other in strangers.of(name, text):
                if other == text:
                    continue
                yield name, how, other, None
                said = self.kind.report_of or self.kind.target
                result = folder.read(said)
                # A layout with a piece elsewhere may keep all that a report says of it, and of where a search
                # began nothing is claimed (docs/formats.md).
                if kinds.digest(text) in result and how != "a piece elsewhere" and \
                        not strangers.is_start(kinds.digest(text), result):
                    yield name, how + ", and its digest", other, (said, result.replace(kinds.digest(text),
                                                                                       kinds.digest(other)))

    def tell(self, folder, change):
        """Exit status and words of verify after a change."""
        text = change.text()
        if text == self.text:
            return None
        before = folder.read(self.kind.report_of) if self.kind.report_of else None
        folder.write(self.kind.target, text)
        if before is not None:
            old, new = kinds.digest(self.text), kinds.digest(text)
            folder.write(self.kind.report_of, before.replace(old, new))
        ran = folder.run(self.kind.verify)
        folder.write(self.kind.target, self.text)
        if before is not None:
            folder.write(self.kind.report_of, before)
        return ran

    def take(self, where, claim, ran, judge):
        if ran is None:
            return
        status, words = ran.returncode, ran.stderr.decode(errors="replace")
        confirmed = status == 0 or self.kind.unproved and status == 1 and "not rechecked" not in words
        verdict = judge() if confirmed else None
        if verdict == "information":
            self.count["information"] += 1
            return
        self.count["changes"] += 1
        if status in (2, 3, 4):
            self.count["refused"] += 1
        elif status == 1 and not confirmed and any(word in words for word in ("not rechecked", "unchecked", "not there", "no certificate")):
            self.count["weak"] += 1
        elif confirmed and verdict:
            self.count["excused"] += 1
            self.excused[claim] += 1
        else:
            self.count["missed"] += 1
            self.faults.append(f"{where}: {status}")

    def run(self, jobs):
        def work(share):
            with tempfile.TemporaryDirectory() as path:
                shutil.copytree(self.home.name, path, dirs_exist_ok=True)
                folder = Folder(self.lekalo, path)
                told = [(change, self.tell(folder, change)) for change in self.changes[share::jobs]]
                others = []
                for name, how, text in self.others[share::jobs]:
                    before = folder.read(name)
                    (folder.path / name).unlink()
                    if text is not None:
                        folder.write(name, text)
                    others.append((name, how, folder.run(self.kind.verify)))
                    folder.write(name, before)
                for name, how, text, result in self.swaps[share::jobs]:
                    before = {name: folder.read(name)}
                    folder.write(name, text)
                    if result:
                        before[result[0]] = folder.read(result[0])
                        folder.write(*result)
                    others.append((name, how, folder.run(self.kind.verify)))
                    for one, old in before.items():
                        folder.write(one, old)
                return told, others

        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            for told, others in pool.map(work, range(jobs)):
                for change, ran in told:
                    self.take(f"{change.path} {change.how} (was {str(change.old).strip()[:60]})",
                              " ".join(claim_of(change)), ran, lambda: self.oracle(change))
                for name, how, ran in others:
                    self.take(f"{name} {how}", name, ran, lambda: None)
        self.home.cleanup()


COLUMNS = ("changes", "refused", "weak", "excused", "missed")


def row(name, count):
    print("| " + " | ".join([name] + [f"{count[column]:,}" for column in COLUMNS]) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lekalo")
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--excused", action="store_true", help="tell what was confirmed and left every claim true")
    words = parser.parse_args()
    count, seed = int(os.environ.get("LEKALO_CASES", "4")), int(os.environ.get("LEKALO_SEED", "1"))
    count = min(count, 4 * int(os.environ.get("LEKALO_TIMES", "1000000")))
    whole, faults = collections.Counter(), []
    print("| kind | " + " | ".join(COLUMNS) + " |\n|---" * 1 + "|---:" * len(COLUMNS) + "|")
    for kind in kinds.kinds():
        if not re.search(words.only, kind.name):
            continue
        walk = Walk(kind, os.path.abspath(words.lekalo), words.source, random.Random(f"{seed} {kind.name}"), count)
        walk.run(words.jobs)
        row(kind.name, walk.count)
        whole += walk.count
        for claim, number in walk.excused.most_common() if words.excused else ():
            print(f"  {number} excused: {claim}", flush=True)
        for fault in walk.faults:
            print(f"  {fault}", file=sys.stderr, flush=True)
        faults += [f"{kind.name}: {fault}" for fault in walk.faults]
    row("all", whole)
    changes = max(1, whole["changes"])
    share, chance = whole["excused"] / changes, 2 * math.sqrt(0.1 * 0.9 / changes) if count else 0
    print(f"\n{whole['information']} changes of information besides; {100 * share:.1f} % of the others leave every "
          "claim true and are confirmed")
    if share > 0.1 + chance:
        faults.append("more than a tenth of the changes are excused")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
