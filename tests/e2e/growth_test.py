"""Twice the input may cost 2.5 times the work, and no megabyte more than ten seconds or a gigabyte.

    growth_test.py LEKALO [NAME...]

Runs the families of growth_families.py at n and at 2 n, or those named, and compares what the two cost in
processor time of the command alone, the least of six runs where the first ones say too much. Without names
those of QUICK are run; `all` runs every family (docs/measurements/verify.md). With --table it prints a line for each.
"""

import os
import resource
import subprocess
import sys
import tempfile
import time

from growth_families import FAMILIES

QUICK = ["dxf-equal-circles", "dxf-concentric", "dxf-nested-squares", "dxf-slanting-slots", "svg-styles",
         "region-holes-in-a-row", "region-square-holes-in-a-row", "tree-half-planes", "program-comments"]
RATIO, SECONDS, ALLOWED_BYTES = 2.5, 10, 1 << 30
# A command that takes no longer than this at n has done nothing but start.
START = 0.06
WAIT = 60  # seconds of processor time, after which a command is ended


def run(lekalo, words, files):
    """Returns exit status, seconds of processor time and until the end, bytes of memory and what was said."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        with open(os.path.join(folder, "said"), "w+", encoding="utf-8", errors="replace") as said:
            begun = time.monotonic()
            process = subprocess.Popen([lekalo, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=said, stderr=said)
            # Processor time, of which a machine that does other things too takes nothing away.
            resource.prlimit(process.pid, resource.RLIMIT_CPU, (WAIT, WAIT))
            _, status, used = os.wait4(process.pid, 0)
            waited = time.monotonic() - begun
            process.returncode = os.waitstatus_to_exitcode(status)
            said.seek(0)
            return process.returncode, used.ru_utime + used.ru_stime, waited, used.ru_maxrss * 1024, said.read()


def judge(lekalo, name, n, words, make):
    """Returns what is wrong with a family, and a line that says what it cost."""
    small, large = make(n), make(2 * n)
    size = sum(map(len, large.values()))
    first = second = longest = float("inf")
    for _ in range(6):
        status, seconds, _, _, said = run(lekalo, words, small)
        first = min(first, seconds)
        status, seconds, waited, memory, said = run(lekalo, words, large)
        second = min(second, seconds)
        # Who waits for two threads waits for less than they work; a busy machine makes nobody's command slower.
        longest = min(longest, seconds, waited)
        ratio = second / max(first, START)
        if ratio <= RATIO or longest > 2 * SECONDS:
            break
    line = f"{name:30} {n:7} {size / 1e6:6.2f} MB {first:7.2f} s {second:7.2f} s, {longest:.2f} s to the end {ratio:5.2f} {memory / 2**20:6.0f} MiB  exit {status}"
    wrong = []
    if status not in (0, 1, 3):
        wrong.append(f"exit status {status}: {said.strip()[-300:]}")
    if ratio > RATIO:
        wrong.append(f"twice the input costs {ratio:.2f} times as much")
    if longest > SECONDS * max(1, size / 1e6):
        wrong.append(f"{size} bytes take {longest:.1f} s")
    if memory > ALLOWED_BYTES * max(1, size / 1e6):
        wrong.append(f"{size} bytes take {memory >> 20} MiB")
    return wrong, line + "  " + said.strip().replace("\n", " ")[:100]


def main():
    words = [word for word in sys.argv[1:] if word != "--table"]
    lekalo, names = os.path.abspath(words[0]), words[1:]
    known = {family[0]: family for family in FAMILIES}
    if not names:
        names = QUICK
    if names == ["all"]:
        names = list(known)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    failed = 0
    for name in names:
        wrong, line = judge(lekalo, *known[name])
        if "--table" in sys.argv:
            print(line, flush=True)
        for sentence in wrong:
            print(f"{name}: {sentence}", flush=True)
        failed += bool(wrong)
    print(f"{len(names)} families, {failed} failed")
    return 1 if failed or len(known) < 60 else 0


sys.exit(main())
