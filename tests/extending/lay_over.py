"""Lays the additions of this folder over a copy of the sources that they touch.

  lay_over.py SOURCES OVERLAY

An addition is a folder: its files stand where they would stand in the tree, and lines.txt says which existing lines
it touches. A path begins the changes of that file; `-LINE` and `+LINE` replace a line, `+LINE` and `after LINE` add
one. Printed are the changed files, a path each. It fails where an addition touches more than two existing lines, or
one that is not there, or brings a file that is there already.
"""
import pathlib
import sys

MOST_LINES = 2
ENDINGS = {".cpp", ".hpp"}


def changes_of(lines):
    """(path, old line, new lines) of every change."""
    path = old = new = None
    for line in lines:
        if line.startswith("-"):
            old = line[1:]
        elif line.startswith("+") and old is not None:
            yield path, old, [line[1:]]
            old = None
        elif line.startswith("+"):
            new = line[1:]
        elif line.startswith("after "):
            yield path, line[6:], [line[6:], new]
        else:
            path = line


def lay_over(addition, sources, overlay):
    for file in sorted(p for p in addition.rglob("*") if p.suffix in ENDINGS):
        name = file.relative_to(addition)
        if (sources / name).exists():
            sys.exit(f"{addition.name}: {name} is there already")
        write(overlay / name, file.read_text())
    changes = list(changes_of((addition / "lines.txt").read_text().splitlines()))
    if len(changes) > MOST_LINES:
        sys.exit(f"{addition.name} touches {len(changes)} existing lines; an addition may touch {MOST_LINES}")
    for path, old, new in changes:
        at = overlay / path if (overlay / path).exists() else sources / path
        lines = at.read_text().split("\n")
        if lines.count(old) != 1:
            sys.exit(f"{addition.name}: {path} has not one line {old!r}")
        place = lines.index(old)
        lines[place : place + 1] = new
        write(overlay / path, "\n".join(lines))
    return {path for path, _, _ in changes}


def write(path, text):
    """Leaves alone what is the same already, so that nothing is built again."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def main(sources, overlay):
    fresh = overlay.with_suffix(".new")
    changed = set()
    for addition in sorted(p.parent for p in pathlib.Path(__file__).parent.glob("*/lines.txt")):
        changed |= lay_over(addition, sources, fresh)
    for file in sorted(p for p in fresh.rglob("*") if p.is_file()):
        write(overlay / file.relative_to(fresh), file.read_text())
    for file in sorted(p for p in overlay.rglob("*") if p.is_file()):
        if not (fresh / file.relative_to(overlay)).exists():
            file.unlink()
    for file in sorted(fresh.rglob("*"), reverse=True):
        file.rmdir() if file.is_dir() else file.unlink()
    print("\n".join(sorted(changed)))


main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
