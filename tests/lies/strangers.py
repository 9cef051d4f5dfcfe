"""Other files in the place of those that a result was made from: another layout, another part, another program."""

import json

SQUARE = [[0, 0], [70, 0], [70, 30], [0, 30]]
PLAIN = "".join(f"{x} {y}\n" for x, y in SQUARE)
REGION = json.dumps({"units": "mm", "outer": [{"line": {"from": a, "to": b}}
                                              for a, b in zip(SQUARE, SQUARE[1:] + SQUARE[:1])]})
SOLID = [f"{x} {y} {z}\n" for x in (0, 5) for y in (0, 4) for z in (0, 3)]
FACES = ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4))
MESH = "".join("v " + place for place in SOLID) + "".join(f"f {a} {b} {c}\nf {a} {c} {d}\n" for a, b, c, d in FACES)
DRAWING = ('<svg xmlns="http://www.w3.org/2000/svg" width="70mm" height="30mm" viewBox="0 0 70 30">'
           '<rect width="70" height="30"/></svg>')
ENTITIES = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\nCUT\n90\n4\n70\n1\n" + \
    "".join(f"10\n{x}\n20\n{y}\n" for x, y in SQUARE) + "0\nENDSEC\n0\nEOF\n"
PROGRAM = "G21 G17 G90 G40 G49 G54 G94 G91.1 G61\nG0 X1 Y1 Z5\nM3 S900\nG1 Z-1 F200\nG1 X40 F500\nG1 Y20\nG0 Z5\nM5\nM2\n"
BY_ENDING = {"csv": [PLAIN], "txt": [PLAIN], "xyz": ["".join(SOLID)], "obj": [MESH], "svg": [DRAWING], "dxf": [ENTITIES],
             "nc": [PROGRAM], "ngc": [PROGRAM]}


def scaled(value, by):
    if isinstance(value, list):
        return [scaled(inner, by) for inner in value]
    if isinstance(value, dict):
        return {key: scaled(inner, by) for key, inner in value.items()}
    return value * by if isinstance(value, (int, float)) and not isinstance(value, bool) else value


def of_layout(layout):
    """Other parts, fewer pieces, and the same ones elsewhere."""
    other = json.loads(json.dumps(layout))
    for part in other["parts"]:
        part["outline"] = scaled(part["outline"], 0.9375)
        if "chord_tolerance" in part["outline"]:
            part["outline"]["chord_tolerance"] = layout["parts"][0]["outline"].get("chord_tolerance", 0.01)
    yield "parts smaller", other
    if not layout.get("placements"):
        return
    other = json.loads(json.dumps(layout))
    other["placements"][0]["x"] += 1.5
    yield "a piece elsewhere", other
    other = json.loads(json.dumps(layout))
    del other["placements"][-1]
    yield "a piece less", other


def is_start(digest, result):
    """Says whether a result names a file with this digest as the one that its search began from."""
    try:
        inputs = json.loads(result)["inputs"]
    except (ValueError, KeyError, TypeError):
        return False
    return any(one.get("role") == "start" and one.get("sha256") == digest for one in inputs)


def of(name, text):
    """Files that may be named in the place of this one, each with what it is."""
    ending = name.rsplit(".", 1)[-1].lower()
    if ending == "json":
        try:
            document = json.loads(text)
        except ValueError:
            document = None
        if isinstance(document, dict) and str(document.get("format", "")).startswith("lekalo-layout"):
            for how, other in of_layout(document):
                yield how, json.dumps(other)
            return
        yield "another region", REGION
        if isinstance(document, dict):
            yield "numbers smaller", json.dumps(scaled(document, 0.9375))
        return
    for other in BY_ENDING.get(ending, []):
        yield "another " + ending, other
