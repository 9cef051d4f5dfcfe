"""Changes of a file that was written, one at a time.

Of JSON: every number by its last place (or the least that a claim tells apart) up and down, by its sign and by more,
every text and truth, every member and item taken out, members given twice and members that are not known, neighbours
of a list exchanged and lists turned round. Of a text of lines: every number by one in its last digit and by its sign,
every word taken out, every line taken out, every two lines exchanged. Of a program besides: every cut taken out, made
once more at the end or moved, and of several passes the first once more, and the last not. Of a binary STL: every triangle taken out, given
twice, exchanged with the next or turned round, its normal and attribute, a corner of it alone, and every corner of the
surface in all of its triangles.
"""

import copy
import json
import math
import re
import struct
from dataclasses import dataclass, field


@dataclass
class Change:
    path: str  # "/inputs/0/sha256", or "line 7"
    how: str
    make: object = field(repr=False)  # gives the bytes of the file after the change
    old: object = field(default=None, repr=False)

    def text(self):
        return self.make()


def at_path(document, path):
    for key in path.split("/")[1:]:
        document = document[int(key)] if isinstance(document, list) else document[key]
    return document


def nodes(value, path=""):
    yield path, value
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from nodes(inner, f"{path}/{key}")
    elif isinstance(value, list):
        for k, inner in enumerate(value):
            yield from nodes(inner, f"{path}/{k}")


def of_number(value, step):
    yield "last place up", step(value, 1)
    yield "last place down", step(value, -1)
    yield "sign", -value if value else 1
    yield "more", value + 0.5
    yield "less", value - 0.5


def next_double(value, way, _path):
    return math.nextafter(float(value), way * math.inf)


def of_value(value, step):
    if isinstance(value, bool):
        yield "truth", not value
    elif isinstance(value, (int, float)):
        yield from of_number(value, step)
    elif isinstance(value, str):
        yield "text", value + "x"
        yield "no text", ""
    elif value is None:
        yield "not null", 1
    elif isinstance(value, list):
        if len(value) > 1 and value != value[::-1]:
            yield "turned round", value[::-1]
        for k in range(len(value) - 1):
            if value[k] != value[k + 1]:
                yield f"exchanged {k}", value[:k] + [value[k + 1], value[k]] + value[k + 2:]


TWICE = "given twice "


def of_json(text, step=next_double):
    """All changes of a JSON document. `step` gives the neighbour of a number of this document, by its path."""
    tree = json.loads(text)

    def with_change(path, change):
        def make():
            made = copy.deepcopy(tree)
            *around, last = path.split("/")[1:]
            parent = at_path(made, "".join("/" + key for key in around))
            change(parent, int(last) if isinstance(parent, list) else last)
            # A member of a dictionary cannot be there twice before it is text.
            return json.dumps(made).replace('"' + TWICE, '"')
        return make

    def put(value):
        return lambda parent, key: parent.__setitem__(key, value)

    def take_out(parent, key):
        del parent[key]

    def give_twice(parent, key):
        parent[TWICE + key] = parent[key]

    for path, value in nodes(tree):
        if path:
            yield Change(path, "deleted", with_change(path, take_out), value)
            if not isinstance(at_path(tree, path.rsplit("/", 1)[0]), list):
                yield Change(path, "given twice", with_change(path, give_twice), value)
            for how, changed in of_value(value, lambda number, way, path=path: step(number, way, path)):
                yield Change(path, how, with_change(path, put(changed)), value)
        if isinstance(value, dict):
            member = f"{path}/not_known"
            yield Change(member, "added", with_change(member, lambda parent, key: parent.__setitem__(key, 1)))


NUMBER = re.compile(r"-?\d+(?:\.\d*)?|-?\.\d+")


def of_text(text, skip=lambda line: False, decimals=None):
    """All changes of a text of lines. Of lines that `skip` names only the whole is changed. Of numbers with more
    decimals than claims tell apart the last digit is that of the last of these."""
    lines = text.splitlines(keepends=True)
    for number, line in enumerate(lines):
        def changed(made, number=number):
            return lambda: "".join(lines[:number] + made + lines[number + 1:])
        path = f"line {number + 1}"
        yield Change(path, "deleted", changed([]), line)
        if number + 1 < len(lines) and line != lines[number + 1]:
            other = lines[:number] + [lines[number + 1], line] + lines[number + 2:]
            yield Change(path, "exchanged", lambda other=other: "".join(other), line)
        if skip(line):
            continue
        for found in NUMBER.finditer(line):
            begin, end = found.span()
            last = end - 1 if line[end - 1] != "." else end - 2
            point = line.find(".", begin, end)
            if decimals is not None and point >= 0:
                last = min(last, point + decimals)
            digit = str(int(line[last]) + 1) if line[last] != "9" else "8"
            word = line[:begin], line[begin:end], line[end:]
            turned = word[1][1:] if word[1].startswith("-") else "-" + word[1]
            yield Change(path, "last digit", changed([line[:last] + digit + line[last + 1:]]), line)
            yield Change(path, "sign", changed([word[0] + turned + word[2]]), line)
            if "." in word[1]:
                more = f"{float(word[1]) + 0.05:.{len(word[1].split('.')[1])}f}"
                yield Change(path, "a bit more", changed([word[0] + more + word[2]]), line)
        for found in re.finditer(r"\S+", line):
            left = line[:found.start()] + line[found.end():]
            if left.strip():
                yield Change(path, "word deleted", changed([left]), line)


def cuts_of(lines):
    """The cuts of a profile program, from the way there to the way to the next, as (first line, line behind it), and the
    line of the way home. Marks have no comment before them."""
    begins = [k for k, line in enumerate(lines) if re.match(r"G0 X", line)]
    heads = [k - lines[k - 1].startswith("(PLACEMENT") for k in begins]
    return list(zip(heads, heads[1:])), heads[-1]


def of_program(text, decimals=None):
    """All changes of a profile program, as of any text, and of whole cuts."""
    yield from of_text(text, decimals=decimals)
    lines = text.splitlines(keepends=True)
    cuts, last = cuts_of(lines)

    def moved(begin, end, place):
        rest = lines[:begin] + lines[end:]
        place -= end - begin if place >= end else 0
        return lambda: "".join(rest[:place] + lines[begin:end] + rest[place:])

    def put(made, begin, end):
        return lambda: "".join(lines[:begin] + made + lines[end:])

    for k, (begin, end) in enumerate(cuts):
        there, is_mark = lines[begin:end], not lines[begin].startswith("(PLACEMENT")
        path = f"mark {k}" if is_mark else f"cut {k}"
        if k + 1 < len(cuts):
            yield Change(path, "moved to the end", moved(begin, end, last), there)
        yield Change(path, "once more at the end", put(there, last, last), there)
        if is_mark:
            continue
        yield Change(path, "deleted", put([], begin, end), there)
        if k + 1 < len(cuts):
            yield Change(path, "moved behind the next", moved(begin, end, cuts[k + 1][1]), there)
        passes = [i for i, line in enumerate(there) if line.startswith("G1 Z")]
        if len(passes) > 1:
            yield Change(path, "first pass once more at the end",
                         put(there[:passes[1]] + [line for line in there if line.startswith("G0 Z")], last, last), there)
            yield Change(path, "no last pass", put(there[:passes[-1]] + there[-1:], begin, end), there)


def of_stl(text):
    """All changes of a binary STL but for those that change no shape: its head, normals, attributes, order and turns."""
    data = text.encode(errors="surrogateescape")
    head, rows = data[:80], [struct.unpack_from("<12fH", data, at) for at in range(84, len(data), 50)]

    def packed(changed, count=None):
        body = b"".join(struct.pack("<12fH", *row) for row in changed)
        return (head + struct.pack("<I", len(changed) if count is None else count) + body).decode(
            errors="surrogateescape")

    def put(k, *others):
        return lambda: packed(rows[:k] + list(others) + rows[k + 1:])

    def move(corner, other):
        return lambda: packed([row[:3] + sum((other if row[at:at + 3] == corner else row[at:at + 3]
                                              for at in (3, 6, 9)), ()) + row[12:] for row in rows])

    for step in (1, -1):
        yield Change("count", f"{step:+}", lambda step=step: packed(rows, len(rows) + step), len(rows))
    for k, row in enumerate(rows):
        path = f"triangle {k}"
        yield Change(path, "deleted", put(k), row)
        yield Change(path, "twice", put(k, row, row), row)
        yield Change(path, "corner", put(k, row[:3] + (row[3] + 0.5,) + row[4:]), row)
    for k, corner in enumerate(sorted({row[at:at + 3] for row in rows for at in (3, 6, 9)})):
        for axis in range(3):
            # By less than the stock a corner may often move.
            for how, value in (("last place up", next_single(corner[axis], 1)), ("far more", corner[axis] + 64),
                               ("far less", corner[axis] - 64)):
                other = corner[:axis] + (value,) + corner[axis + 1:]
                yield Change(f"corner {k}/{axis}", how, move(corner, other), corner)


def next_single(value, way):
    """The next number of single precision."""
    word = struct.unpack("<i", struct.pack("<f", value))[0]
    return struct.unpack("<f", struct.pack("<i", word + (way if value > 0 else -way)))[0] if value else way * 1e-30
