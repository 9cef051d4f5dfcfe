#!/usr/bin/env python3
"""check_planted.py COMPILER: the check of the documentation must notice what it is for.

Makes a small clean project, demands that check_docs.py finds nothing in it, then plants one violation of each rule
after the other and demands that it is named, with its place.
"""
import os
import sys
import tempfile

from references import references
from voice import voice

PAGE = """# A page

## Goal
The goal is short. The type `PartShape` and `kLimit` are of `geom/shape.hpp`, see [the steps](#steps).

## Steps
1. The first step reads `src/geom/shape.cpp` by `read_shape()`.

```json
{"a": [1, 2]}
```

```cpp
const int a = 1;
static_assert(a == 1);
```

<!-- code of src/geom/shape.cpp -->
```cpp fragment
int read_shape() {
```

    lekalo place examples/part.csv --gap 1
"""
HEADER = """#pragma once
/// A shape of a part, as step 1 of docs/design/page.md reads it; docs/design/page.md,
/// "Goal", says why.
struct PartShape {};
constexpr int kLimit = 3;
"""
SOURCE = """// The function reads a shape.
int read_shape() {
  return 1;
}
"""
OPTIONS = """const char* const kGap = "--gap";
"""
LEKALO = """#!/bin/sh
echo "  --gap MM"
"""
CLEAN = {"docs/design/page.md": PAGE, "README.md": "# Name\n\nThe [page](docs/design/page.md#goal) tells more.\n",
         "include/lekalo/geom/shape.hpp": HEADER, "src/geom/shape.cpp": SOURCE, "apps/cli/options.cpp": OPTIONS,
         "tests/unit/shape_test.cpp": "// The shape has a test.\n", "examples/part.csv": "0 0\n",
         ".clang-format": "ColumnLimit: 110\n"}

LONG = "This sentence has far too many words, " + "and " * 40 + "it ends here."

# (the file, the text that is replaced, the text in its place, what must be said); no text: added at the end.
PLANTED = [
    ("docs/design/page.md", "The goal is short.", "x" * 120, "characters; prose has at most"),
    ("README.md", "", "\n" + "\n".join(LONG[i:i + 60] for i in range(0, len(LONG), 60)), "words; it may have 40"),
    ("docs/design/page.md", "## Steps", "## Idea", "no section \"## Steps\""),
    ("docs/design/page.md", "## Steps", "## Idea", "the section \"Idea\" is none of"),
    ("docs/design/page.md", "", "\n## Limits\nNone.\n\n## Bounds\nNone.\n", "the section \"Bounds\" stands too late"),
    ("src/geom/shape.cpp", "// The function", "// What the function", "begins with \"What\""),
    ("src/geom/shape.cpp", "// The function reads", "// Of the functions this reads", "begins with \"Of\""),
    ("src/geom/shape.cpp", "// The function reads a shape.", "// The same.", "begins with \"The same.\""),
    ("src/geom/shape.cpp", "a shape.", "a shape", "ends without a full stop"),
    ("src/geom/shape.cpp", "", "\n// ---- the shapes that are read ----------\n\nint read_no_shape();\n", ""),
    ("src/geom/shape.cpp", "", "\n// ---- the shapes that are read\n\nint read_no_shape();\n",
     "ends without a full stop"),
    ("src/geom/shape.cpp", "reads a shape.", "reads\n// a shape.", "wrap it anew"),
    ("include/lekalo/geom/shape.hpp", "as step 1", "as step 7", "has no step 7"),
    ("include/lekalo/geom/shape.hpp", "\"Goal\"", "\"Aim\"", "docs/design/page.md has no section \"Aim\""),
    ("include/lekalo/geom/shape.hpp", "page.md", "pages.md",
     "the comment names docs/design/pages.md, which does not exist"),
    ("README.md", "page.md#goal", "pages.md",
     "the link leads to docs/design/pages.md, which does not exist; the nearest is docs/design/page.md"),
    ("README.md", "#goal", "#goals", "no heading for the anchor #goals"),
    ("docs/design/page.md", "src/geom/shape.cpp` by", "src/shape.cpp` by",
     "`src/shape.cpp` does not exist; the nearest is src/geom/shape.cpp"),
    ("docs/design/page.md", "`geom/shape.hpp`", "`geom/{shape,form}.hpp`", "`geom/form.hpp` does not exist"),
    ("docs/design/page.md", "kLimit", "kLimits", "no source has the name `kLimits`; the nearest is kLimit"),
    ("docs/design/page.md", "`PartShape`", "`geom::PartForm`", "no source has the name `PartForm`"),
    ("docs/design/page.md", "", "\nIt is held by `unit_shape`.\n", ""),
    ("docs/design/page.md", "", "\nIt is held by `LEKALO_CASES=9 unit_form`.\n", "no program is called unit_form"),
    ("docs/design/page.md", "--gap 1", "--gaps 1", "no program has an option --gaps; the nearest is --gap"),
    ("docs/design/page.md", "--gap 1", "--gap-of-others 1", "lekalo place has no option --gap-of-others"),
    ("apps/cli/options.cpp", "", "\nconst char* const kHint = \"try --gaps\";\n",
     "no command has an option --gaps; the nearest is --gap"),
    ("docs/design/page.md", "examples/part.csv", "examples/parts.csv",
     "the example examples/parts.csv does not exist; the nearest is examples/part.csv"),
    ("docs/design/page.md", "[1, 2]", "[1, ...]", "this is no JSON"),
    ("docs/design/page.md", "a == 1", "b == 1", "this does not compile"),
    ("docs/design/page.md", "int read_shape() {\n```", "int read_form() {\n```",
     "does not stand in src/geom/shape.cpp"),
]


def write(root, files):
    for path, text in files.items():
        place = os.path.join(root, path)
        os.makedirs(os.path.dirname(place), exist_ok=True)
        with open(place, "w", encoding="utf-8") as file:
            file.write(text)


def findings(files, compiler):
    with tempfile.TemporaryDirectory() as root:
        write(root, files)
        lekalo = os.path.join(root, "lekalo.sh")
        write(root, {"lekalo.sh": LEKALO})
        os.chmod(lekalo, 0o755)
        found = voice(root) + references(root, lekalo, compiler)
    return [f"{f.path}:{f.line}: {f.text}" for f in found]


def planted(path, old, new):
    files = dict(CLEAN)
    if old and old not in files[path]:
        sys.exit(f"'{old}' does not stand in {path}")
    files[path] = files[path].replace(old, new) if old else files[path] + new
    if new.startswith("--gap-of-others"):
        files["tests/unit/shape_test.cpp"] += "// Another program has --gap-of-others.\n"
    return files


def main():
    compiler = sys.argv[1]
    failures = [f"a clean project is refused: {said}" for said in findings(CLEAN, compiler)]
    for path, old, new, says in PLANTED:
        said = findings(planted(path, old, new), compiler if "compile" in says else None)
        if says and not any(line.startswith(path + ":") and says in line for line in said):
            failures.append(f"planted '{new[:40]}' in {path}; expected '{says}', got {said}")
        if not says and said:
            failures.append(f"'{new[:40]}' in {path} is no violation, and yet: {said}")
    violations = sum(1 for *_, says in PLANTED if says)
    print("\n".join(failures) if failures else f"{violations} planted violations are noticed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
