#!/usr/bin/env python3
"""Line and branch coverage of the product, by module and room, after the tests of a build with --coverage.

    tools/coverage.py BUILD [--files]     --files: of every file too

Counts of a file that many objects hold (headers) are added up. A branch is an edge that the compiler left in the
program; edges that exceptions take are not counted.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def counted(data):
    """What gcov says of one object: its files, each with its lines."""
    done = subprocess.run(["gcov", "--json-format", "--stdout", "--branch-probabilities", data],
                          cwd=os.path.dirname(data), capture_output=True, text=True, check=True)
    return [one for line in done.stdout.splitlines() if line for one in json.loads(line)["files"]]


def product_file(path, build):
    """The path within the project, of files of the product alone."""
    path = os.path.relpath(os.path.realpath(os.path.join(build, path)), ROOT)
    return path if path.startswith(("src/", "include/", "apps/")) else None


def module_of(path):
    parts = path.replace("include/lekalo/", "src/").split("/")
    return "/".join(parts[1:-1] if parts[0] == "src" else parts[:-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--files", action="store_true")
    arguments = parser.parse_args()
    build = os.path.realpath(arguments.build)
    data = [os.path.join(folder, name) for folder, _, names in os.walk(build) for name in names
            if name.endswith(".gcda")]
    if not data:
        raise SystemExit(f"{build}: no counts; build with --coverage and run the tests first")

    lines = collections.defaultdict(collections.Counter)     # of a file: line: times
    branches = collections.defaultdict(collections.Counter)  # of a file: (line, which): times
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for files in pool.map(counted, sorted(data)):
            for one in files:
                path = product_file(one["file"], build)
                if path is None:
                    continue
                for line in one["lines"]:
                    lines[path][line["line_number"]] += line["count"]
                    edges = [edge for edge in line["branches"] if not edge["throw"]]
                    for which, edge in enumerate(edges):
                        branches[path][line["line_number"], which] += edge["count"]

    rows = collections.defaultdict(lambda: [0, 0, 0, 0])
    for path in sorted(lines):
        groups = [module_of(path).split("/")[0] if not path.startswith("apps/") else module_of(path), "all"]
        if "/" in module_of(path) and not path.startswith("apps/"):
            groups.append(module_of(path))
        if arguments.files:
            groups.append(module_of(path) + "/" + os.path.basename(path))
        ran, taken = sum(map(bool, lines[path].values())), sum(map(bool, branches[path].values()))
        for group in groups:
            rows[group] = [a + b for a, b in zip(rows[group], (ran, len(lines[path]), taken, len(branches[path])))]

    print(f"{'':44}{'lines':>16}{'branches':>20}")
    for group in sorted(rows, key=lambda name: (name == "all", name)):
        ran, every, taken, edges = rows[group]
        print(f"{group:44}{ran:7} {every:7} {100 * ran / every:5.1f} %{taken:8} {edges:7} "
              f"{100 * taken / max(edges, 1):5.1f} %")


if __name__ == "__main__":
    main()
