"""What exports show: a DXF, an SVG and a plot, read by readers of this test's own, and whether a change has left it."""

import math
import re
import xml.etree.ElementTree as ElementTree

import cuts

WITHIN = 2e-6  # mm
LAYERS = {"CUT", "SHEET", "DEFECT", "ZONE", "AREA", "MARK", "LABEL"}


class Strange(Exception):
    """Nobody knows what this shows."""


def require(*conditions):
    if not all(conditions):
        raise Strange


def same(one, other):
    if isinstance(one, (list, tuple)):
        return isinstance(other, (list, tuple)) and len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, float) and isinstance(other, float):
        return abs(one - other) <= WITHIN
    return one == other


def same_in_any_order(some, others):
    left = list(others)
    for one in some:
        k = next((k for k, other in enumerate(left) if same(one, other)), None)
        if k is None:
            return False
        del left[k]
    return not left


# What a group means that is not there, by its code.
MEANT = {30: 0.0, 31: 0.0, 38: 0.0, 39: 0.0, 43: 0.0, 50: 0.0, 51: 0.0, 41: 1.0, 48: 1.0, 60: 0, 62: 256, 67: 0, 71: 0, 72: 0,
         73: 0, 6: "BYLAYER", 370: -1, 7: "STANDARD"}
# Handles, who owns an entity, and names of classes: they are held by programs, and say nothing of what is shown.
PASSED = {5, 330, 100}
SECTIONS = {"HEADER", "CLASSES", "TABLES", "BLOCKS", "ENTITIES", "OBJECTS"}


def value_of(code, value):
    if 10 <= code < 60 or 140 <= code < 150 or 210 <= code < 240:
        return float(value)
    if 60 <= code < 100 or 170 <= code < 180 or 270 <= code < 300 or 370 <= code < 390 or 420 <= code < 460:
        return int(value)
    return value


def entity_of(kind, groups):
    """What an entity says, without what goes without saying."""
    said, vertices = {}, []
    for code, value in groups:
        if code in PASSED:
            continue
        value = value_of(code, value)
        if kind == "LWPOLYLINE" and code == 10:
            vertices.append([value, 0.0, 0.0])
        elif kind == "LWPOLYLINE" and code in (20, 42) and vertices:
            vertices[-1][1 if code == 20 else 2] = value
        else:
            require(code not in said)
            said[code] = value
    if kind == "LWPOLYLINE":
        require(said.pop(90) == len(vertices))
    layer = said.pop(8, "0")
    if kind == "TEXT" and layer == "LABEL":
        return None
    require(kind in ("LWPOLYLINE", "CIRCLE", "LINE", "TEXT"), kind == "LWPOLYLINE" or not 40 in said or said[40] > 0)
    said = {code: value for code, value in said.items() if MEANT.get(code) != value}
    if kind == "TEXT" and 72 not in said:
        said.pop(11, None), said.pop(21, None)
    return [kind, layer if layer in LAYERS else layer.upper(), sorted(said.items()), vertices]


def dxf(text):
    lines = text.replace("\r\n", "\n").split("\n")
    require(lines[-1] == "", len(lines) % 2 == 1)
    pairs = [(int(code), value if int(code) == 1 else value.strip()) for code, value in zip(lines[:-1:2], lines[1::2])]
    require(pairs[-1] == (0, "EOF"), pairs.count((0, "EOF")) == 1)
    begins = [k for k, (code, _) in enumerate(pairs) if code == 0]
    section, met, entities, hidden, unit, version = "", set(), [], [], None, None
    for begin, end in zip(begins, begins[1:]):
        kind, groups = pairs[begin][1], pairs[begin + 1:end]
        if kind == "SECTION":
            require(not section, groups[0][0] == 2)
            section = groups[0][1]
            require(section in SECTIONS, section not in met)
            met.add(section)
            if section == "HEADER":
                names = [value for code, value in groups if code == 9]
                require(len(set(names)) == len(names))
                for (code, name), (_, value) in zip(groups, groups[1:]):
                    if (code, name) == (9, "$INSUNITS"):
                        unit = value
                    if (code, name) == (9, "$ACADVER"):
                        version = value.strip()
            else:
                require(len(groups) == 1)
        elif kind == "ENDSEC":
            require(section, not groups)
            section = ""
        elif section == "ENTITIES":
            entities.append(entity_of(kind, groups))
        elif section == "BLOCKS":
            require(kind in ("BLOCK", "ENDBLK"))
        elif kind == "LAYER":
            said = [code for code, _ in groups]
            require(said.count(62) <= 1, said.count(70) <= 1, said.count(2) == 1)
            hidden += [(dict(groups)[2].upper(), code, value) for code, value in groups
                       if code == 70 and value != "0" or code == 62 and value.startswith("-") or code in (290, 440, 60)]
    require(not section, unit is not None, version in ("AC1021", "AC1015"), version == "AC1021" or text.isascii())
    return [unit, sorted(hidden)], [one for one in entities if one is not None]


SVG, INKSCAPE = "{http://www.w3.org/2000/svg}", "{http://www.inkscape.org/namespaces/inkscape}"
# What these attributes say depends on others, or is information: numbers beside arcs, the layer's colour and width.
NEUTRAL = {"data-lekalo-arcs"}
KNOWN = {"path": {"d", "stroke"}, "circle": {"cx", "cy", "r", "stroke"}, "line": {"x1", "y1", "x2", "y2"},
         "text": {"transform", "font-family", "font-size", "text-anchor", "fill", "stroke"}}
COLOUR = re.compile(r"#[0-9a-f]{6}$")


def numbers_of(text):
    return [float(n) if re.match(r"[-\d.]", n) else n for n in re.findall(r"[A-Za-z]|-?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?", text)]


def svg(text):
    # Whoever reads a style sheet may show anything.
    prolog = '<?xml version="1.0" encoding="UTF-8"?>'
    require(text.count("<?") == text.startswith(prolog), "<!" not in text)
    root = ElementTree.fromstring(text.encode(errors="surrogateescape"))
    require(root.tag == SVG + "svg", not (root.text or "").strip())
    page = dict(root.attrib)
    require(set(page) <= {"version", "width", "height", "viewBox", "data-lekalo-corner"},
            page["width"].endswith("mm"), page["height"].endswith("mm"))
    wide, tall = float(page["width"][:-2]), float(page["height"][:-2])
    view = [float(n) for n in page["viewBox"].split()]
    corner = [float(n) for n in page.get("data-lekalo-corner", "0 0").split()]
    require(len(view) == 4, len(corner) == 2, view[2:] == [wide, tall], corner == [view[0], -view[1] - tall])
    shown = []
    for group in root:
        require(group.tag == SVG + "g", group.attrib.pop(INKSCAPE + "groupmode", "") == "layer",
                not (group.text or "").strip(), not (group.tail or "").strip())
        layer = group.attrib.pop(INKSCAPE + "label")
        require(set(group.attrib) == {"fill", "stroke", "stroke-width"}, group.attrib["fill"] == "none",
                COLOUR.match(group.attrib["stroke"]), float(group.attrib["stroke-width"]) > 0)
        for one in group:
            kind = one.tag.replace(SVG, "")
            require(kind in KNOWN, len(one) == 0, not (one.tail or "").strip())
            said = {key: value for key, value in one.attrib.items() if key not in NEUTRAL}
            if kind == "text" and layer == "LABEL":
                require(set(said) <= {"x", "y"} | KNOWN["text"] - {"transform"})
                continue
            require(set(said) <= KNOWN[kind], kind == "text" or not (one.text or "").strip(),
                    all(COLOUR.match(said[key]) for key in ("stroke", "fill") if key in said and kind != "text"))
            where = layer if layer in LAYERS else layer.upper()
            shown.append([kind, where] + geometry_of(kind, said, one.text or "", view))
    return [], shown


def geometry_of(kind, said, letters, view):
    (x0, y0), (x1, y1) = view[:2], (view[0] + view[2], view[1] + view[3])

    def on_page(x, y, by=0.0):
        require(x - by >= x0 - WITHIN, x + by <= x1 + WITHIN, y - by >= y0 - WITHIN, y + by <= y1 + WITHIN)

    if kind == "text":
        require(letters, COLOUR.match(said["fill"]), said["stroke"] == "none", said["font-family"] == "sans-serif")
        place = numbers_of(re.fullmatch(r"matrix\(([^()]*)\)", said["transform"])[1])
        require(len(place) == 6, float(said["font-size"]) > 0)
        on_page(*place[4:])
        return [said["fill"], said["text-anchor"], float(said["font-size"]), place, letters]
    if kind == "path":
        data = numbers_of(said["d"])
        require(re.fullmatch(r"[MLAZ\s\d.,e+-]*", said["d"]), data[0] == "M")
        for k, word in enumerate(data):
            if word in ("M", "L"):
                on_page(*data[k + 1:k + 3])
            elif word == "A":
                on_page(*data[k + 6:k + 8])
        return [said.get("stroke"), data]
    numbers = [float(said[key]) for key in sorted(KNOWN[kind] - {"stroke"})]
    if kind == "circle":
        require(numbers[2] > 0)
        on_page(numbers[0], numbers[1], numbers[2])
    return [said.get("stroke"), numbers]


def hpgl(text):
    """The lines of a plot by their pen, in its units; labels are drawn with their own pen."""
    require(text.startswith("IN;PA;"))
    shown, pen, at, k = [], 0, None, 0
    while k < len(text):
        if text[k] in "\r\n;":
            k += 1
            continue
        kind = text[k:k + 2]
        if kind == "LB":
            end = text.index("\x03", k)
            require(pen == 3)
            k = end + 1
            continue
        end = text.index(";", k)
        values, k = text[k + 2:end], end + 1
        if kind in ("SI", "LO"):
            require(pen == 3)
            continue
        numbers = [int(n) for n in values.split(",")] if values else []
        if kind == "SP":
            require(len(numbers) == 1, 0 <= numbers[0] <= 7)
            pen = numbers[0]
        elif kind in ("PU", "PD"):
            require(len(numbers) % 2 == 0)
            places = list(zip(numbers[::2], numbers[1::2]))
            if kind == "PD":
                require(pen not in (0, 3), at is not None)
                shown.append((pen, [at] + places))
            at = (places or [at])[-1]
        else:
            require(kind in ("IN", "PA"), not shown, not numbers)
    require(pen == 0)
    return [], shown


def same_lines(some, others):
    """What is claimed of a plot holds within half a unit, so that a line may be off by one."""
    if len(some) != len(others):
        return False
    return all(a[0] == b[0] and len(a[1]) == len(b[1]) and
               all(max(abs(p[0] - q[0]), abs(p[1] - q[1])) <= 1 for p, q in zip(a[1], b[1]))
               for a, b in zip(sorted(some), sorted(others)))


def export(form):
    """All that is claimed is shown, and nothing else."""
    read = {"dxf": dxf, "svg": svg, "hpgl": hpgl}[form]

    def oracle(context):
        frame, shown = read(context.text)

        def answer(change):
            try:
                other_frame, after = read(change.text())
            except (Strange, ValueError, KeyError, TypeError, IndexError, ElementTree.ParseError):
                return None
            if (other_frame, after) == (frame, shown):
                return "information"
            if form == "hpgl":
                return same_lines(shown, after) or None
            return other_frame == frame and same_in_any_order(shown, after) or None
        return answer
    return oracle


UNIT = 0.025  # mm
STEP = 0.02  # mm along the way of a knife's axis


def tips_of(strokes, offset):
    """Where the tip of a trailing blade goes in each stroke, from a blade that points along +x; with no offset it is
    where the axis is."""
    forward, made = (1.0, 0.0), []
    for stroke in strokes:
        x, y = (UNIT * n for n in stroke[0])
        tip = (x - offset * forward[0], y - offset * forward[1])
        way = [tip]
        for place in stroke[1:]:
            u, v = UNIT * place[0] - x, UNIT * place[1] - y
            steps = max(1, math.ceil(math.hypot(u, v) / STEP))
            for k in range(1, steps + 1):
                axis = (x + u * k / steps, y + v * k / steps)
                if offset:
                    size = math.dist(axis, tip)
                    forward = ((axis[0] - tip[0]) / size, (axis[1] - tip[1]) / size)
                    tip = (axis[0] - offset * forward[0], axis[1] - offset * forward[1])
                else:
                    tip = axis
                way.append(tip)
            x, y = x + u, y + v
        made.append(way)
    return made


def knife(offset=0.0, tolerance=0.1):
    """The tip of a knife goes along all outlines and nowhere else. A drag knife makes a stroke for each."""
    def oracle(context):
        layout = context.json("nested.json")
        stock = layout["placements"][0]["stock"]
        contours = cuts.Judge(layout, stock, 1).contours
        _, before = hpgl(context.text)
        rest = [line for line in before if line[0] != 1]
        known = [line for line in before if line[0] == 1]

        def follows(strokes):
            if offset and len(strokes) != len(contours):
                return False
            ways = tips_of(strokes, offset)
            within = tolerance + 0.005
            if any(min(contour.near.off(p) for contour in contours) > within for way in ways for p in way[::5]):
                return False
            near = cuts.Near([way + way[-2:0:-1] for way in ways if len(way) > 1])
            return all(near.off(p) <= within for contour in contours
                       for p in cuts.samples_of(contour.ring + contour.ring[:1], 0.2))

        if not follows([line for _, line in known]):
            raise RuntimeError(context.kind.name + ": the plot is not right by drawn.py")

        def answer(change):
            try:
                _, after = hpgl(change.text())
            except (Strange, ValueError, KeyError, TypeError, IndexError):
                return None
            if after == before:
                return "information"
            if not same_lines(rest, [line for line in after if line[0] != 1]):
                return None
            return follows([line for pen, line in after if pen == 1]) or None
        return answer
    return oracle
