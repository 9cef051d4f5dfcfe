"""Lines and texts inside parts, as ezdxf reads them from exports: ezdxf knows nothing of lekalo.

    marks_ezdxf.py LEKALO FOLDER...

Every drawing of the folders that makes parts becomes a layout in which each part lies once, turned by an angle of its
own and every other mirrored. Each mark and text of the layout has to be in its export in DXF, where the definition of
a placement puts it. Where ezdxf is not installed the test is skipped with a sentence.
"""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

WAIT = 120


def run(lekalo, folder, *words):
    return subprocess.run([lekalo, *words], cwd=folder, capture_output=True, text=True, timeout=WAIT, check=False)


def near(a, b, off=2e-6):
    return abs(a[0] - b[0]) <= off and abs(a[1] - b[1]) <= off


def placed(point, placement):
    """The definition of a placement: mirrored in x first, then turned, then moved."""
    x, y = -point[0] if placement.get("mirrored") else point[0], point[1]
    c, s = placement["c"], placement["s"]
    return (c * x - s * y + placement["x"], s * x + c * y + placement["y"])


def ends_of(mark):
    first, last = mark["edges"][0], mark["edges"][-1]
    return next(iter(first.values()))["from"], next(iter(last.values()))["to"]


def axes(height, degrees, width, mirrored):
    """Along the letters and up, as vectors of the sheet."""
    angle = math.radians(degrees)
    along = (-1 if mirrored else 1) * height * width
    return ((along * math.cos(angle), along * math.sin(angle)), (-height * math.sin(angle), height * math.cos(angle)))


def turned(vector, placement):
    at = placed((0, 0), placement)
    end = placed(vector, placement)
    return (end[0] - at[0], end[1] - at[1])


def drawn(path, ezdxf):
    """Ends of open lines and circles, and texts with their axes, of an exported DXF."""
    lines, texts = [], []
    for entity in ezdxf.readfile(path).modelspace():
        kind = entity.dxftype()
        if kind == "LWPOLYLINE":
            points = list(entity.get_points("xy"))
            lines.append((points[0], points[0] if entity.closed else points[-1]))
        elif kind == "CIRCLE":
            at = (entity.dxf.center.x + entity.dxf.radius, entity.dxf.center.y)
            lines.append((at, at))
        elif kind == "TEXT" and entity.dxf.layer != "LABEL":
            texts.append((entity.dxf.text, (entity.dxf.insert.x, entity.dxf.insert.y),
                          *axes(entity.dxf.height, entity.dxf.rotation, entity.dxf.width,
                                bool(entity.dxf.text_generation_flag & 2))))
    return lines, texts


def inner_texts(path, ezdxf):
    """The letters and places of the texts of a drawing, those of blocks among them, in mm."""
    document = ezdxf.readfile(path)
    found = []

    def walk(entities, depth):
        for entity in entities:
            kind = entity.dxftype()
            if kind == "INSERT" and depth < 8:
                found.extend((a.dxf.text, a.dxf.insert) for a in entity.attribs if not a.is_invisible)
                try:
                    walk(entity.virtual_entities(), depth + 1)
                except (ArithmeticError, TypeError, ValueError):
                    pass
            elif kind == "TEXT":
                found.append((entity.dxf.text, entity.dxf.insert))
            elif kind == "MTEXT":
                found.append((entity.plain_text().split("\n")[0], entity.dxf.insert))

    walk(document.modelspace(), 0)
    return found


def main():
    try:
        import ezdxf
    except ImportError:
        print("ezdxf is not installed (Debian: python3-ezdxf), so that nothing was compared")
        return 77
    lekalo = os.path.abspath(sys.argv[1])
    faults, drawings, lines, texts, kept, there = [], 0, 0, 0, 0, 0
    for path in sorted(p for folder in sys.argv[2:] for p in pathlib.Path(folder).rglob("*") if p.suffix.lower() == ".dxf"):
        with tempfile.TemporaryDirectory() as folder:
            made = run(lekalo, folder, "new", "--part", str(path.resolve()), "--sheet", "100000x100000", "-o", "l.json")
            if made.returncode != 0 or not os.path.exists(folder + "/l.json"):
                continue
            layout = json.loads(pathlib.Path(folder, "l.json").read_text())
            drawings += 1
            # One piece of each part, turned by an angle of its own, every other mirrored.
            layout["placements"] = []
            del layout["next_id"]
            for i, part in enumerate(layout["parts"]):
                part["mirror"] = True
                layout["placements"].append({"part": part["id"], "stock": layout["stocks"][0]["id"], "x": 20000 + 5000.0 * (i % 10),
                                             "y": 20000 + 5000.0 * (i // 10), "mirrored": i % 2 == 1, "rotation_deg": 37.0 * i + 11})
            pathlib.Path(folder, "p.json").write_text(json.dumps(layout))
            told = run(lekalo, folder, "export", "p.json", "--format", "dxf", "-o", "o.dxf")
            if told.returncode != 0:
                faults.append(f"{path.name}: {told.stderr.strip()}")
                continue
            seen_lines, seen_texts = drawn(folder + "/o.dxf", ezdxf)
            for part, placement in zip(layout["parts"], layout["placements"]):
                angle = math.radians(placement["rotation_deg"])
                placement["c"], placement["s"] = math.cos(angle), math.sin(angle)
                for mark in part.get("marks", ()):
                    lines += 1
                    a, b = (placed(p, placement) for p in ends_of(mark))
                    # ezdxf says of a circle where it is on the right of its centre.
                    circle = len(mark["edges"]) == 1 and "arc" in mark["edges"][0] and ends_of(mark)[0] == ends_of(mark)[1]
                    if circle:
                        arc = mark["edges"][0]["arc"]
                        centre = placed(arc["centre"], placement)
                        a = b = (centre[0] + math.dist(arc["centre"], arc["from"]), centre[1])
                    if not any(near(a, p, 1e-5) and near(b, q, 1e-5) for p, q in seen_lines):
                        faults.append(f"{path.name}: the mark from {a} to {b} is not drawn")
                for text in part.get("texts", ()):
                    texts += 1
                    at = placed(text["at"], placement)
                    right, up = (turned(v, placement) for v in axes(text["height"], text.get("deg", 0), text.get("width_factor", 1),
                                                                    text.get("mirrored", False)))
                    if not any(letters == text["text"] and near(p, at, 1e-5) and near(r, right, 1e-5) and near(u, up, 1e-5)
                               for letters, p, r, u in seen_texts):
                        faults.append(f"{path.name}: the text {text['text']!r} is not drawn at {at}")
            kept += sum(len(part.get("texts", ())) for part in layout["parts"])
            try:
                there += len(inner_texts(path, ezdxf))
            except (ezdxf.DXFError, ArithmeticError, OSError, UnicodeError):
                pass
    for fault in faults[:50]:
        print(fault)
    print(f"{drawings} drawings: {lines} lines and {texts} texts on parts are drawn where their placements put them; "
          f"the drawings have {there} texts in all, inside and outside of parts, of which {kept} lie on parts")
    return 1 if faults or drawings == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
