"""Holds the tables of docs/formats.md, "What verify does with each field", against the fields that results have.

    field_table.py LEKALO SOURCE_DIR

Every field at the top of a result is in the table of its kind, or in the words before the tables, and every field of
a table is in some result. Fields further down are named somewhere on the page.
"""

import json
import os
import pathlib
import re
import sys
import tempfile

import changes
import kinds
import verify_lies

# The kinds of results, and the words with which their table begins.
TABLES = {"placement, solids": "Placements of solids:", "placement": "Placements:", "layout": "**Layouts.**",
          "report of an order": "**Reports of orders.**", "report of nest": "**Reports of nest and check.**", "report of check": "**Reports of nest and check.**",
          "report of pocket": "**Reports of simulate and pocket", "report of simulate": "**Reports of simulate and pocket",
          "quote": "**Quotes.**", "stock": "**Stocks.**", "result of fit": "**Results of fit.**", "result of heat": "**Results of heat.**"}


def named(text):
    return set(re.findall(r'`"?(\w+)"?`', text))


def tables_of(page):
    """The names in the first column of each table, by the words before it."""
    found = {}
    for words in set(TABLES.values()):
        rest = page[page.index(words):]
        rows = re.search(r"(?m)^\|[^|]*\| kind[^\n]*\n\|[-|]+\n((?:\|.*\n)+)", rest)[1]
        column = "\n".join(row.split("|")[1] for row in rows.splitlines())
        if "the figures" in column:
            figures = page[page.index("[design/simulate.md](design/simulate.md):\n"):]
            column += figures[:figures.index("of a pocket")]
        found[words] = named(column.replace("`name`s", "`name`")) | set(re.findall(r"`(\w+)\[\{", column))
    return found


def main(lekalo, source):
    page = (source / "docs/formats.md").read_text()
    begin = page.index("## What verify does with each field\n\nFields are of three kinds")
    everywhere = named(page[begin:page.index("**Layouts.**")])
    tables, written, faults = tables_of(page), {}, []
    words_of_page = set(re.findall(r"\w+", page))
    for kind in kinds.kinds():
        table = next((words for name, words in TABLES.items() if kind.name.startswith(name)), None)
        if kind.form != "json" or table is None or not kind.target.endswith(".json") or kind.report_of:
            continue
        with tempfile.TemporaryDirectory() as path:
            folder = verify_lies.Folder(lekalo, path)
            folder.make(kind, source)
            document = json.loads(folder.read(kind.target))
        written.setdefault(table, set()).update(document)
        for key in sorted(set(document) - tables[table] - everywhere):
            faults.append(f"{kind.name}: the field {key} is in no table of docs/formats.md")
        for path, value in changes.nodes(document):
            for key in value if isinstance(value, dict) else ():
                if key not in words_of_page:
                    faults.append(f"{kind.name}: {path}/{key} is not named in docs/formats.md")
    for table, keys in written.items():
        nested = {"kind", "a", "b", "stock", "copy", "feature", "amount_mm", "at", "direction", "part", "count", "parts", "remnant",
                  "length", "unplaced", "reason", "name", "marks", "texts", "material", "thickness", "customer", "due", "label", "finish_mm", "rounds", "visits", "moved_um",
                  "from", "rectangle", "cost"}
        for key in sorted(tables[table] - keys - nested - OPTIONAL):
            faults.append(f"{table} names {key}, which no result has")
    for fault in sorted(set(faults)):
        print(fault)
    print(f"{sum(map(len, written.values()))} fields of {len(written)} kinds of documents were looked up")
    return 1 if faults or not written else 0


# Fields that only options make which no result here has, or that stand within another.
OPTIONAL = {"unsaid", "largest_certificate", "rest_of_mm", "common_line", "supposed_program", "after", "program", "pocket", "nested", "tool_mm",
            "certificate_file", "disagreements", "x", "y", "width_mm", "distance_mm", "area_mm2"}

if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])))
