#!/usr/bin/env python3
"""Prints the files of a build that the compiler needs longest for, in processor seconds, each compiled alone and
without a cache.

    tools/slowest_files.py BUILD [COUNT]

BUILD is a folder that Ninja has built; its log proposes three times COUNT files (10), which are compiled again.
"""
import json
import os
import resource
import shlex
import subprocess
import sys


def proposed(build, count):
    """The objects that took longest when Ninja made them, the longest first."""
    took = {}
    with open(os.path.join(build, ".ninja_log"), encoding="utf-8") as log:
        for line in log:
            fields = line.split("\t")
            if len(fields) == 5 and fields[3].endswith(".o"):
                took[fields[3]] = int(fields[1]) - int(fields[0])
    return sorted(took, key=took.get, reverse=True)[:count]


def seconds(entry):
    words = shlex.split(entry["command"])
    compiler = next(i for i, word in enumerate(words) if os.path.basename(word) in ("c++", "g++", "clang++"))
    words = words[compiler:]
    words[words.index("-o") + 1] = os.devnull
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(words, cwd=entry["directory"], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    build = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) == 3 else 10
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as commands:
        entries = {shlex.split(e["command"])[shlex.split(e["command"]).index("-o") + 1]: e for e in json.load(commands)}
    times = [(seconds(entries[name]), entries[name]["file"]) for name in proposed(build, 3 * count) if name in entries]
    for time, file in sorted(times, reverse=True)[:count]:
        print(f"{time:6.1f}  {os.path.relpath(file)}")


main()
