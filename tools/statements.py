#!/usr/bin/env python3
"""Counts the statements of the production code of a checkout, a row for each folder.

  tools/statements.py [CHECKOUT...]

A statement is a `;` outside parentheses or the `{` that opens a body, after comments, texts, preprocessor lines,
namespaces and imports are taken out, so that neither the formatter nor comments nor the cut into files change the
figure. Folders: include, src, apps,
bindings and web/src. With several checkouts they stand side by side, which shows whether a change made the
code larger.
"""
import pathlib
import re
import sys

FOLDERS = ("include", "src", "apps", "bindings", "web/src")
ENDINGS = {".cpp", ".hpp", ".ts", ".mjs"}
NOT_CODE = re.compile(
    r'R"(\w*)\((?:.|\n)*?\)\1"'  # raw texts
    r"|//[^\n]*|/\*(?:.|\n)*?\*/"  # comments
    r'|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])*\'|`(?:\\.|[^`\\])*`'  # texts
    r"|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*"  # preprocessor lines
    r"|^(?:inline )?namespace[^;{]*\{"
    r"|^(?:import|export) (?:type )?(?:\{[^}]*\}|\* as \w+|\w+) from[^;]*;|^import [^;]*;",
    re.MULTILINE,
)


def statements(text):
    depth = count = 0
    for character in NOT_CODE.sub(" ", text):
        if character == "(":
            depth += 1
        elif character == ")":
            depth -= 1
        elif character == "{" or (character == ";" and depth <= 0):
            count += 1
            depth = max(depth, 0)
    return count


def rows_of(checkout):
    rows = {}
    for folder in FOLDERS:
        for path in sorted((checkout / folder).rglob("*")):
            if path.suffix in ENDINGS and path.is_file():
                parts = path.relative_to(checkout).parts
                if parts[0] == "include":
                    parts = parts[:1] + parts[2:]
                name = "/".join(parts[:2])
                rows[name] = rows.get(name, 0) + statements(path.read_text())
    return rows


def main(arguments):
    checkouts = [pathlib.Path(a) for a in arguments] or [pathlib.Path(__file__).parent.parent]
    columns = [rows_of(c) for c in checkouts]
    for name in sorted(set().union(*columns)):
        print(f"{name:20}" + "".join(f"{c.get(name, 0):8}" for c in columns))
    print(f"{'all':20}" + "".join(f"{sum(c.values()):8}" for c in columns))


main(sys.argv[1:])
