"""Labels as a printer prints them, read by programs that nobody here wrote: poppler makes the pages black and
white dots, ZBar reads the QR codes from them, and poppler's words say where the texts stand.

    labels.py LEKALO PDFTOPPM PDFTOTEXT ZBARIMG

Expected texts are made here from the layout's bytes, as docs/formats.md says.
"""

import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile

LEKALO, PDFTOPPM, PDFTOTEXT, ZBARIMG = sys.argv[1:5]
LEKALO = os.path.abspath(LEKALO)
WAIT = 120
POINT = 25.4 / 72
EDGE = 1.5  # mm of a label that stay white, but for the code's own light margin

LONG = ("Боковина шкафа для верхней одежды, левая, с отверстиями под полкодержатели и направляющие, "
        "вариант для правой стены № 4711")
NAMES = ["Полка", LONG, "Seitenwand links \"groß\"", "", "Donaudampfschifffahrtsgesellschaftskapitänsmütze-0042",
         "Крышка <верх> & дно", "x"]


def run(folder, *words):
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=WAIT, check=False)


def rectangle(width, height):
    return {"polygon": {"outer": [[0, 0], [width, 0], [width, height], [0, height]]}}


def layout():
    """Parts with names of all kinds on two copies of one sheet and on another, with ids of one to sixteen digits."""
    parts, placements = [], []
    for i, name in enumerate(NAMES):
        part = {"id": f"part-{i}", "outline": rectangle(40 + 0.1 * i, 20 + i), "mirror": True}
        if name:
            part["name"] = name
        part.update({"material": "фанера", "thickness": 18})
        parts.append(part)
    parts[0].update({"customer": "Иванов", "due": "2026-12-01", "label": "A-117"})
    ids = [1, 2, 3, 7, 10, 42, 99, 100, 101, 1234, 5000, 12345, 99999, 123456, 123457]
    for i, number in enumerate(ids):
        placements.append({"id": number, "part": f"part-{i % len(NAMES)}", "stock": "плита" if i % 3 else "rest",
                           "copy": i % 2 if i % 3 else 0, "rotation_deg": 90 * (i % 4), "mirrored": i % 5 == 0,
                           "x": 60 + 60 * (i % 5), "y": 60 + 60 * (i // 5)})
    of = {"material": "фанера", "thickness": 18}
    stocks = [{"id": "плита", "kind": "sheet", "count": 3, "outline": rectangle(600, 400), **of},
              {"id": "rest", "kind": "sheet", "outline": rectangle(380, 300), **of}]
    return {"format": "lekalo-layout/1", "units": "mm", "name": "Шкаф 12/7", "stocks": stocks, "parts": parts,
            "placements": placements}


def expected(folder, name, document, least_remnant):
    """For each label in its order: what the code says, and the number that is printed."""
    with open(os.path.join(folder, name), "rb") as file:
        code = "LK/" + hashlib.sha256(file.read()).hexdigest()[:10].upper()
    order = [stock["id"] for stock in document["stocks"]]
    shown = json.loads(run(folder, LEKALO, "show", name, "--json").stdout)
    labels = []
    for number, sheet in enumerate(shown["sheets"], 1):
        on_sheet = [p for p in document["placements"] if (p["stock"], p["copy"]) == (sheet["stock"], sheet["copy"])]
        for placement in sorted(on_sheet, key=lambda p: p["id"]):
            labels.append((f"{code}/{placement['id']}", str(placement["id"])))
        remnant = sheet.get("remnant") or {"width": 0, "height": 0}
        if min(remnant["width"], remnant["height"]) >= least_remnant:
            labels.append((f"{code}/R{number}", f"R{number}"))
    places = [(order.index(s["stock"]), s["copy"]) for s in shown["sheets"]]
    assert places == sorted(places), "the sheets are not in the order of the document"
    return labels


def codes_of(folder, name, dots_per_inch, *which):
    """What ZBar reads on each page of the PDF, printed in black and white; `which` chooses a part of a page."""
    for old in os.listdir(folder):
        if old.startswith("page"):
            os.remove(os.path.join(folder, old))
    run(folder, PDFTOPPM, "-r", str(dots_per_inch), "-mono", *which, name, "page").check_returncode()
    pages = sorted(file for file in os.listdir(folder) if file.startswith("page"))
    return [run(folder, ZBARIMG, "--raw", "-q", page).stdout.split() for page in pages]


def code_on(folder, name, page, box, dots_per_inch):
    """What ZBar reads on one label of a sheet, as who holds a reader to it."""
    left, top, right, bottom = [round(mm / 25.4 * dots_per_inch) for mm in box]
    [codes] = codes_of(folder, name, dots_per_inch, "-f", str(page), "-l", str(page), "-x", str(left), "-y", str(top),
                       "-W", str(right - left), "-H", str(bottom - top))
    return codes


def words_of(folder, name):
    """Pages as their size, and their words with boxes, mm from the upper left."""
    text = run(folder, PDFTOTEXT, "-bbox", name, "-").stdout
    pages = []
    for page in re.findall(r"<page .*?</page>", text, re.S):
        size = [POINT * float(n) for n in re.search(r'width="([\d.]+)" height="([\d.]+)"', page).groups()]
        found = re.findall(r'<word xMin="([\d.-]+)" yMin="([\d.-]+)" xMax="([\d.-]+)" yMax="([\d.-]+)">(.*?)</word>',
                           page)
        pages.append((size, [([POINT * float(n) for n in word[:4]], word[4].replace("\u00a0", " ")) for word in found]))
    return pages


def export(folder, name, *words):
    ran = run(folder, LEKALO, "export", name, "--format", "labels", "-o", "labels.pdf", *words)
    assert ran.returncode == 0, ran.stderr
    with open(os.path.join(folder, "labels.pdf"), "rb") as file:
        return file.read()


def check_words(words, label, number, where):
    """All words of a label stand on it, and the first says its number.

    Boxes of words are as high as the font's tallest letters, which stand above capitals."""
    left, top, right, bottom = label
    assert words, f"{where}: no words"
    for (x0, y0, x1, y1), text in words:
        assert left + EDGE - 0.1 <= x0 and x1 <= right + 0.1, f"{where}: \"{text}\" stands out sideways"
        assert top <= y0 and y1 <= bottom, f"{where}: \"{text}\" stands out above or below"
    assert words[0][1] == number, f"{where}: the first word is \"{words[0][1]}\" and not \"{number}\""


def check_roll(folder, name, labels, size, dots_per_inch, *more):
    width, height = size
    export(folder, name, "--label-size", f"{width}x{height}", *more)
    where = f"roll {width} x {height} at {dots_per_inch} dots an inch"
    assert codes_of(folder, "labels.pdf", dots_per_inch) == [[code] for code, _ in labels], \
        f"{where}: {codes_of(folder, 'labels.pdf', dots_per_inch)}"
    pages = words_of(folder, "labels.pdf")
    for (page, words), (_, number) in zip(pages, labels):
        assert abs(page[0] - width) < 0.01 and abs(page[1] - height) < 0.01, f"{where}: the page has {page} mm"
        check_words(words, (0, 0, width, height), number, where)
    return pages


def check_sheet(folder, name, labels, columns, rows, margin, gap, *more):
    export(folder, name, "--label-sheet", f"A4:{columns}x{rows}", "--label-margin", f"{margin[0]}x{margin[1]}",
           "--label-gap", f"{gap[0]}x{gap[1]}", *more)
    where = f"sheets of {columns} x {rows}"
    groups = [labels[i:i + columns * rows] for i in range(0, len(labels), columns * rows)]
    width = (210 - 2 * margin[0] - (columns - 1) * gap[0]) / columns
    height = (297 - 2 * margin[1] - (rows - 1) * gap[1]) / rows
    pages = words_of(folder, "labels.pdf")
    assert len(pages) == len(groups), f"{where}: {len(pages)} pages"
    for page, ((_, words), group) in enumerate(zip(pages, groups), 1):
        places = [(margin[0] + (i % columns) * (width + gap[0]), margin[1] + (i // columns) * (height + gap[1]))
                  for i in range(len(group))]
        boxes = [(x, y, x + width, y + height) for x, y in places]
        on_label = [[w for w in words if box[0] <= w[0][0] < box[2] and box[1] <= (w[0][1] + w[0][3]) / 2 < box[3]]
                    for box in boxes]
        assert sum(map(len, on_label)) == len(words), f"{where}: a word stands between labels"
        for box, own, (code, number) in zip(boxes, on_label, group):
            check_words(own, box, number, f"{where}, label {number}")
            read = code_on(folder, "labels.pdf", page, box, 203)
            assert read == [code], f"{where}, label {number}: {read}"


def main():
    document = layout()
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "layout.json"), "w", encoding="utf-8") as file:
            json.dump(document, file, ensure_ascii=False)
        labels = expected(folder, "layout.json", document, 100)
        remnants = [number for _, number in labels if number.startswith("R")]
        assert len(labels) == len(document["placements"]) + len(remnants) and remnants, "no remnant in the case"
        assert export(folder, "layout.json") == export(folder, "layout.json"), "other bytes the second time"

        pages = check_roll(folder, "layout.json", labels, (62, 29), 203)
        texts = [" ".join(word for _, word in words) for _, words in pages]
        for text in ("Полка", "Шкаф 12/7", "плита #2", "40 x 20 mm", "mirrored", "Remnant", "part-0",
                     "фанера, 18 mm", "A-117, Иванов, due 2026-12-01, part-0, "):
            assert any(text in page for page in texts), f"\"{text}\" is on no label"
        pages = check_roll(folder, "layout.json", labels, (54, 17), 203)
        long = next(text for words in pages for text in [" ".join(word for _, word in words[1])] if "Боковина" in text)
        assert "…" in long and "4711" in long, long

        # A layout that is called by its material says it once.
        with open(os.path.join(folder, "called.json"), "w", encoding="utf-8") as file:
            json.dump(dict(document, name="фанера, 18 mm"), file, ensure_ascii=False)
        export(folder, "called.json")
        called = [" ".join(word for _, word in words) for _, words in words_of(folder, "labels.pdf")]
        assert any("фанера, 18 mm" in page for page in called) and all(page.count("фанера") < 2 for page in called), called

        refused = run(folder, LEKALO, "export", "layout.json", "--format", "labels", "--label-size", "10x10")
        assert refused.returncode == 2, refused
        least = tuple(float(n) for n in re.search(r"need ([\d.]+) x ([\d.]+) mm", refused.stderr).groups())
        check_roll(folder, "layout.json", labels, least, 203)
        check_roll(folder, "layout.json", labels, (29, 90), 300)
        few = expected(folder, "layout.json", document, 1e6)
        check_roll(folder, "layout.json", few, (100, 50), 203, "--label-remnant", "1000m")
        check_sheet(folder, "layout.json", labels, 3, 8, (7.2, 12.9), (2.5, 0))
        check_sheet(folder, "layout.json", labels, 2, 3, (0, 0), (0, 0))

        # The largest id needs a larger code.
        document["placements"][-1]["id"] = 9007199254740991
        with open(os.path.join(folder, "large.json"), "w", encoding="utf-8") as file:
            json.dump(document, file)
        check_roll(folder, "large.json", expected(folder, "large.json", document, 100), (40, 30), 203)
    print(f"{len(labels)} labels, read back from 8 kinds of paper")


if __name__ == "__main__":
    main()
