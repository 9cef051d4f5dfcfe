"""Changes of exports beyond those of any text: what a drawing program, or a careless hand, does to whole entities,
elements and instructions, and what hides, mirrors or moves them."""

import re

from changes import Change, of_text

# Groups that hide an entity, mirror it, give it another look, or say something for the second time.
GROUPS = {"invisible": [(60, 1)], "in paper space": [(67, 1)], "mirrored": [(210, 0), (220, 0), (230, -1)],
          "colour": [(62, 1)], "true colour": [(420, 255)], "colour of its block": [(62, 0)], "dashed": [(6, "DASHED")],
          "without width": [(370, 0)], "thick": [(39, 5)], "high": [(38, 5)], "transparent": [(440, 33554432)],
          "layer twice": [(8, "SHEET")], "slanted": [(51, 20)], "upside down": [(71, 4)], "in another style": [(7, "BIG")],
          "extended data": [(1001, "ACAD"), (1000, "x")]}
OF_LAYERS = {"off": [(62, -7)], "frozen": [(70, 1)], "locked": [(70, 4)], "not plotted": [(290, 0)], "colour twice": [(62, 3)]}


def pairs_of(text):
    lines = text.splitlines()
    return list(zip(lines[::2], lines[1::2]))


def text_of(pairs):
    return "".join(f"{code}\n{value}\n" for code, value in pairs)


def blocks_of(pairs):
    """Where each group 0 begins, as (begin, end, its value, section)."""
    begins = [k for k, (code, _) in enumerate(pairs) if code.strip() == "0"] + [len(pairs)]
    section = ""
    for begin, end in zip(begins, begins[1:]):
        if pairs[begin][1] == "SECTION":
            section = pairs[begin + 1][1]
        yield begin, end, pairs[begin][1], section


def of_dxf(text, decimals=None):
    yield from of_text(text, decimals=decimals)
    pairs = pairs_of(text)
    blocks = list(blocks_of(pairs))
    at = {name: begin for begin, _, kind, name in blocks if kind == "SECTION"}
    ends = {name: begin for begin, _, kind, name in blocks if kind == "ENDSEC"}

    def put(begin, end, made):
        return lambda: text_of(pairs[:begin] + made + pairs[end:])

    def moved(begin, end, place):
        rest = pairs[:begin] + pairs[end:]
        place -= end - begin if place >= end else 0
        return lambda: text_of(rest[:place] + pairs[begin:end] + rest[place:])

    number = 0
    for begin, end, kind, section in blocks:
        there = pairs[begin:end]
        if section == "ENTITIES" and kind not in ("SECTION", "ENDSEC"):
            path, number = f"entity {number} {kind}", number + 1
            yield Change(path, "deleted", put(begin, end, []), there)
            yield Change(path, "given twice", put(end, end, there), there)
            yield Change(path, "moved into a block", moved(begin, end, ends["BLOCKS"] - 1), there)
            yield Change(path, "moved into objects", moved(begin, end, ends["OBJECTS"]), there)
            yield Change(path, "moved to the front", moved(begin, end, at["ENTITIES"] + 2), there)
            again = [("0", "ENDSEC"), ("0", "SECTION"), ("2", "ENTITIES")]
            yield Change(path, "in a second section", put(begin, end, again + there), there)
            yield Change(path, "as another entity", put(begin, begin + 1, [("0", "POINT")]), there)
            for how, groups in GROUPS.items():
                added = [(str(code), str(value)) for code, value in groups]
                yield Change(path, "with " + how, put(end, end, added), there)
            layer = next(k for k in range(begin, end) if pairs[k][0].strip() == "8")
            yield Change(path, "first on another layer", put(layer, layer, [("8", "SHEET")]), there)
            for name in ("SHEET", pairs[layer][1].lower(), pairs[layer][1] + "2"):
                yield Change(path, f"layer {name}", put(layer, layer + 1, [("8", name)]), there)
            for k in range(begin + 1, end):
                code = int(pairs[k][0])
                if code not in (5, 330, 100):
                    yield Change(path, f"group {code} twice", put(k, k, [pairs[k]]), there)
                    yield Change(path, f"group {code} as the next", put(k, k + 1, [(str(code + 1), pairs[k][1])]), there)
                if code == 1:
                    for how, letters in (("a blank before", " " + pairs[k][1]), ("capitals", pairs[k][1].swapcase()),
                                         ("twice", pairs[k][1] * 2)):
                        yield Change(path, "letters " + how, put(k, k + 1, [("1", letters)]), there)
                if code == 40:
                    yield Change(path, "radius or height below 0", put(k, k + 1, [("40", "-" + pairs[k][1])]), there)
        elif kind == "LAYER":
            path = "layer " + next(value for code, value in there if code.strip() == "2")
            yield Change(path, "deleted", put(begin, end, []), there)
            yield Change(path, "given twice", put(end, end, there), there)
            for how, groups in OF_LAYERS.items():
                added = [(str(code), str(value)) for code, value in groups]
                codes = [code for code, _ in added]
                yield Change(path, how, put(begin, end, [p for p in there if p[0].strip() not in codes] + added), there)
        elif kind == "SECTION":
            path, behind = "section " + section, ends[section] + 1
            yield Change(path, "deleted", put(begin, behind, []), section)
            yield Change(path, "given twice", put(behind, behind, pairs[begin:behind]), section)
            yield Change(path, "moved to the front", moved(begin, behind, 0), section)
            yield Change(path, "another name", put(begin + 1, begin + 2, [("2", section + "2")]), section)
    for k in range(at["HEADER"] + 2, ends["HEADER"]):
        if pairs[k][0].strip() == "9" and pairs[k][1] not in ("$EXTMIN", "$EXTMAX"):  # information
            name, value = pairs[k][1], pairs[k + 1]
            yield Change(f"header {name}", "deleted", put(k, k + 2, []), value)
            yield Change(f"header {name}", "given twice", put(k, k, [pairs[k], value]), value)
            yield Change(f"header {name}", "first another", put(k, k, [pairs[k], (value[0], "1")]), value)
    yield Change("header", "another version", lambda: text.replace("AC1021", "AC1009").replace("AC1015", "AC1009"))
    yield Change("file", "goes on", lambda: text + "  0\nEOF\n")


ADDED = {"display": "none", "visibility": "hidden", "opacity": "0", "style": "display:none", "transform": "scale(-1 1)",
         "stroke": "#ff0000", "fill": "#ff0000", "stroke-width": "0", "stroke-opacity": "0", "stroke-dasharray": "1 9",
         "clip-path": "url(#a)", "class": "a", "id": "a", "xml:space": "preserve"}
ATTRIBUTE = re.compile(r' ([\w:-]+)="([^"]*)"')
ELEMENT = re.compile(r"<(path|circle|line|text|g|svg)\b")


def of_svg(text, decimals=None):
    yield from of_text(text, decimals=decimals)
    lines = text.splitlines(keepends=True)

    def put(k, made):
        return lambda: "".join(lines[:k] + made + lines[k + 1:])

    for k, line in enumerate(lines):
        found = ELEMENT.match(line)
        if not found:
            continue
        kind, open_tag = found[1], line[:line.index(">")]
        path, behind = f"{kind} in line {k + 1}", line[line.index(">"):]
        alone = "/" * open_tag.endswith("/")
        head = open_tag.rstrip("/")
        said = dict(ATTRIBUTE.findall(head))
        for name, value in ADDED.items():
            without = ATTRIBUTE.sub(lambda m, name=name: "" if m[1] == name else m[0], head)
            yield Change(path, f"{name} {value}", put(k, [f'{without} {name}="{value}"{alone}{behind}']), line)
        for name, value in said.items():
            one = f' {name}="{value}"'
            yield Change(path, f"without {name}", put(k, [line.replace(one, "", 1)]), line)
            others = {"": "empty", "none": "none", value + "x": "longer", value.upper(): "capitals", "#00f000": "green"}
            for other, how in others.items():
                yield Change(path, f"{name} {how}", put(k, [line.replace(one, f' {name}="{other}"', 1)]), line)
            for number in re.findall(r"(?<![\w.-])[\d.]+(?![\w.-])", value)[:3]:
                turned = one.replace(number, "-" + number, 1)
                yield Change(path, f"{name} below 0", put(k, [line.replace(one, turned, 1)]), line)
        if kind not in ("g", "svg"):
            yield Change(path, "deleted", put(k, []), line)
            yield Change(path, "given twice", put(k, [line, line]), line)
            closes = next(i for i in range(k, len(lines)) if lines[i].startswith("</g"))
            begins = next(i for i in range(k, 0, -1) if lines[i].startswith("<g"))
            for place, how in ((closes + 1, "moved out of its group"), (begins, "moved before its group"),
                               (closes + 2, "moved into the next group"), (len(lines), "moved behind all"),
                               (begins + 1, "moved to the front of its group")):
                if begins + 1 == place == k or place > len(lines):
                    continue
                rest = lines[:k] + lines[k + 1:]
                here = place - (place > k)
                yield Change(path, how, lambda rest=rest, here=here, line=line: "".join(rest[:here] + [line] + rest[here:]),
                             line)
            for around, end in (('<g transform="scale(-1 1)">', "</g>"), ("<g>", "</g>"), ("<defs>", "</defs>"),
                                ("<!-- ", " -->"), ('<a href="a">', "</a>"), ("<svg>", "</svg>"), ("<symbol>", "</symbol>"),
                                ("<switch>", "</switch>"), ("<![CDATA[", "]]>")):
                yield Change(path, "within " + around, put(k, [around, line.rstrip("\n"), end + "\n"]), line)
        if kind == "text":
            yield Change(path, "closed early", put(k, [head + "/>" + re.sub(r"</text>\n$", "", behind[1:])]), line)
            yield Change(path, "letters in another element", put(k, [line.replace(">", "><tspan>", 1).replace(
                "</text>", "</tspan></text>")]), line)
            yield Change(path, "more blanks", put(k, [line.replace(behind, "> " + behind[1:], 1)]), line)
    first = lines[0]
    for how, made in (("without its prolog", []), ("in another encoding", [first.replace("UTF-8", "ISO-8859-1")]),
                      ("with a style sheet", [first, '<?xml-stylesheet type="text/css" href="a.css"?>\n']),
                      ("with a document type", [first, '<!DOCTYPE svg [<!ENTITY a "b">]>\n']),
                      ("with its prolog twice", [first, first])):
        yield Change("file", how, put(0, made))
    yield Change("file", "with a style", put(1, [lines[1], "<style>path{display:none}</style>\n"]))
    yield Change("file", "with a script", put(1, [lines[1], "<script>document.documentElement.remove()</script>\n"]))
    yield Change("file", "goes on", lambda: text + "x")
    size = re.search(r' width="([\d.]+)mm" height="([\d.]+)mm" viewBox="(\S+) (\S+) ([\d.]+) ([\d.]+)"', lines[1])
    wide, tall = float(size[1]), float(size[2])
    x, y = float(size[3]), float(size[4])
    for how, (left, top, across, down) in (("half as wide", (x, y, wide / 2, tall)), ("half as high", (x, y, wide, tall / 2)),
                                           ("without its left", (x + wide / 2, y, wide / 2, tall)),
                                           ("larger", (x, y, wide + 7, tall)),
                                           ("elsewhere", (x + 3 * wide, y, wide, tall))):
        made = lines[1].replace(size[0], f' width="{across}mm" height="{down}mm" viewBox="{left} {top} {across} {down}"')
        made = re.sub(r' data-lekalo-corner="[^"]*"', "", made)
        made = made.replace(">", f' data-lekalo-corner="{left} {-top - down}">')
        yield Change("page", how, put(1, [made]), size[0])


INSERTED = ("PD1000,1000;", "PU0,0;PD400,400;", "RO90;", "SC0,1,0,1;", "IP0,0,100,100;", "LT1;", "PR;", "SP1;", "SP3;", "SP8;",
            "LBx\x03;", "IN;", "DF;", "PA;", "VS1;", "PT5;", "IW0,0,1,1;", "CI40;")


def of_hpgl(text, decimals=None):
    yield from of_text(text, decimals=decimals)
    words = re.findall(r"\s*LB[^\x03]*\x03;|[^;]*;", text)
    rest = text[sum(map(len, words)):]

    def put(begin, end, made):
        return lambda: "".join(words[:begin] + made + words[end:]) + rest

    for k, word in enumerate(words):
        path = f"instruction {k} {word.strip()[:2]}"
        yield Change(path, "deleted", put(k, k + 1, []), word)
        yield Change(path, "given twice", put(k, k + 1, [word, word]), word)
        if k + 1 < len(words):
            yield Change(path, "exchanged", put(k, k + 2, [words[k + 1], word]), word)
        yield Change(path, "before " + INSERTED[k % len(INSERTED)][:2], put(k, k, [INSERTED[k % len(INSERTED)]]), word)
        if word.strip().startswith("LB"):
            yield Change(path, "letters that end early", put(k, k + 1, [word.replace("\x03;", "\x03PD0,0;\x03;")]), word)
            place = next(i for i, other in enumerate(words) if other.strip().startswith("PD"))
            yield Change(path, "moved to the front", lambda k=k, word=word, place=place: "".join(
                words[:place] + [word] + words[place:k] + words[k + 1:]) + rest, word)
        if word.strip().startswith("SP"):
            for pen in range(9):
                yield Change(path, f"pen {pen}", put(k, k + 1, [f"\nSP{pen};"]), word)
            yield Change(path, "and a line", put(k, k + 1, [word, "PU0,0;PD400,400;"]), word)
            yield Change(path, "and a label", put(k, k + 1, [word, "LBx\x03;"]), word)
