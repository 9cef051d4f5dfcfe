#!/usr/bin/env python3
"""Writes the files of this folder: one plate, drawn as different programs write it. Nothing here comes from these
programs; it follows their habits: sections, order and padding of groups, digits, line ends, units, ways to draw.

The plate is 100 x 60 mm with corners of radius 10 and a hole of radius 8 about (30, 30).
"""
import math
import pathlib

HERE = pathlib.Path(__file__).parent
T = math.tan(math.pi / 8)  # bulge of a quarter turn
K = 4 / 3 * T              # a cubic's quarter circle


class File:
    def __init__(self, code="{}", real="{}", end="\n"):
        self.text, self.code, self.real, self.end = "", code, real, end

    def put(self, *pairs):
        for code, value in zip(pairs[::2], pairs[1::2]):
            value = self.real.format(value) if isinstance(value, float) else str(value)
            self.text += self.code.format(code) + self.end + value + self.end
        return self

    def write(self, name, encoding="utf-8"):
        (HERE / name).write_bytes(self.text.encode(encoding))


OUTLINE = [(10, 0, 0), (90, 0, T), (100, 10, 0), (100, 50, T), (90, 60, 0), (10, 60, T), (0, 50, 0), (0, 10, T)]
SIDES = [((10, 0), (90, 0)), ((100, 10), (100, 50)), ((90, 60), (10, 60)), ((0, 50), (0, 10))]
CORNERS = [((90, 10), 270, 0), ((90, 50), 0, 90), ((10, 50), 90, 180), ((10, 10), 180, 270)]


def autocad_r12():
    f = File("{:>3}", "{:.6f}", "\r\n")
    f.put(0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1009", 9, "$DWGCODEPAGE", 3, "ansi_1251", 9, "$EXTMIN",
          10, 0.0, 20, 0.0, 30, 0.0, 9, "$LUNITS", 70, "     2", 0, "ENDSEC")
    f.put(0, "SECTION", 2, "TABLES", 0, "TABLE", 2, "LAYER", 70, "     2", 0, "LAYER", 2, "0", 70, "     0", 62,
          "     7", 6, "CONTINUOUS", 0, "LAYER", 2, "РЕЗ", 70, "    64", 62, "     1", 6, "CONTINUOUS", 0, "ENDTAB", 0, "ENDSEC")
    f.put(0, "SECTION", 2, "BLOCKS", 0, "ENDSEC", 0, "SECTION", 2, "ENTITIES")
    f.put(0, "POLYLINE", 5, "3A", 8, "РЕЗ", 66, "     1", 10, 0.0, 20, 0.0, 30, 0.0, 70, "     1")
    for x, y, bulge in OUTLINE:
        f.put(0, "VERTEX", 5, "3B", 8, "РЕЗ", 10, float(x), 20, float(y), 30, 0.0)
        if bulge:
            f.text += f.code.format(42) + f.end + repr(bulge) + f.end
    f.put(0, "SEQEND", 5, "44", 8, "РЕЗ", 0, "CIRCLE", 5, "45", 8, "РЕЗ", 10, 30.0, 20, 30.0, 30, 0.0, 40, 8.0)
    f.put(0, "TEXT", 5, "46", 8, "0", 10, 1.0, 20, 70.0, 30, 0.0, 40, 5.0, 1, "Плита", 0, "ENDSEC", 0, "EOF")
    f.write("autocad_r12.dxf", "cp1251")


def autocad_2018():
    f = File("{:>3}", "{!r}", "\r\n")
    head = lambda kind, handle, layer, sub: f.put(0, kind, 5, handle, 102, "{ACAD_REACTORS", 330, "5F", 102, "}", 330,
                                                  "1F", 100, "AcDbEntity", 8, layer, 100, sub)
    f.put(0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1032", 9, "$ACADMAINTVER", 90, "    20", 9, "$DWGCODEPAGE", 3,
          "ANSI_1251", 9, "$INSUNITS", 70, "     4", 9, "$INSBASE", 10, 0.0, 20, 0.0, 30, 0.0, 0, "ENDSEC")
    f.put(0, "SECTION", 2, "CLASSES", 0, "CLASS", 1, "ACDBDICTIONARYWDFLT", 2, "AcDbDictionaryWithDefault", 3,
          "ObjectDBX Classes", 90, "        0", 91, "        1", 280, "     0", 281, "     0", 0, "ENDSEC")
    f.put(0, "SECTION", 2, "TABLES", 0, "TABLE", 2, "LAYER", 5, "2", 330, "0", 100, "AcDbSymbolTable", 70, "     3")
    for name, flags, colour in (("0", 0, 7), ("Контур", 0, 1), ("Оси", 1, -3)):
        f.put(0, "LAYER", 5, "10", 330, "2", 100, "AcDbSymbolTableRecord", 100, "AcDbLayerTableRecord", 2, name, 70,
              f"{flags:>6}", 62, f"{colour:>6}", 6, "Continuous", 370, "    -3", 390, "F", 347, "9B")
    f.put(0, "ENDTAB", 0, "ENDSEC", 0, "SECTION", 2, "BLOCKS")
    for name in ("*Model_Space", "*Paper_Space"):
        f.put(0, "BLOCK", 5, "20", 330, "1F", 100, "AcDbEntity", 8, "0", 100, "AcDbBlockBegin", 2, name, 70, "     0", 10,
              0.0, 20, 0.0, 30, 0.0, 3, name, 1, "", 0, "ENDBLK", 5, "21", 330, "1F", 100, "AcDbEntity", 8, "0", 100,
              "AcDbBlockEnd")
    # A quarter of the outline about the middle of the plate, mirrored into four.
    f.put(0, "BLOCK", 5, "A0", 330, "9F", 100, "AcDbEntity", 8, "0", 100, "AcDbBlockBegin", 2, "Quarter", 70, "     0",
          10, 50.0, 20, 30.0, 30, 0.0, 3, "Quarter", 1, "")
    head("LWPOLYLINE", "A2", "0", "AcDbPolyline")
    f.put(90, "        4", 70, "     0", 43, 0.0, 10, 50.0, 20, 0.0, 91, 0, 10, 90.0, 20, 0.0, 42, T, 91, 0, 10, 100.0, 20,
          10.0, 91, 0, 10, 100.0, 20, 30.0, 91, 0)
    f.put(0, "ENDBLK", 5, "A1", 330, "9F", 100, "AcDbEntity", 8, "0", 100, "AcDbBlockEnd", 0, "ENDSEC")
    f.put(0, "SECTION", 2, "ENTITIES")
    for k, (sx, sy) in enumerate(((1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0))):
        head("INSERT", f"B{k}", "Контур", "AcDbBlockReference")
        f.put(2, "QUARTER", 10, 50.0, 20, 30.0, 30, 0.0, 41, sx, 42, sy)
    head("CIRCLE", "C0", "Контур", "AcDbCircle")
    f.put(10, -30.0, 20, 30.0, 30, 0.0, 40, 8.0, 210, 0.0, 220, 0.0, 230, -1.0)
    head("LINE", "C1", "Оси", "AcDbLine")
    f.put(10, 20.0, 20, 30.0, 30, 0.0, 11, 40.0, 21, 30.0, 31, 0.0)
    f.put(0, "VIEWPORT", 5, "D0", 330, "1B", 100, "AcDbEntity", 67, "     1", 8, "0", 100, "AcDbViewport", 10, 128.5, 20,
          97.5, 30, 0.0, 40, 314.2, 41, 222.18, 68, "     2", 69, "     1")
    f.put(0, "ENDSEC", 0, "SECTION", 2, "OBJECTS", 0, "DICTIONARY", 5, "C", 330, "0", 100, "AcDbDictionary", 281, "     1",
          0, "ENDSEC", 0, "EOF")
    f.write("autocad_2018.dxf")


def librecad():
    f = File("{:>3}", "{:.10g}")
    head = lambda kind, handle, sub: f.put(0, kind, 5, handle, 100, "AcDbEntity", 8, "Contour", 6, "ByLayer", 62, "  256",
                                           370, "   -1", 100, sub)
    f.put(999, "dxfrw 0.6.3", 0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1021", 9, "$DWGCODEPAGE", 3, "ANSI_1252", 9,
          "$INSUNITS", 70, "    4", 9, "$GRIDMODE", 70, "    1", 0, "ENDSEC", 0, "SECTION", 2, "BLOCKS", 0, "BLOCK", 5, "1F",
          330, "1E", 100, "AcDbEntity", 8, "0", 100, "AcDbBlockBegin", 2, "*Model_Space", 70, "    0", 10, 0, 20, 0, 30, 0,
          3, "*Model_Space", 1, "", 0, "ENDBLK", 5, "20", 330, "1E", 100, "AcDbEntity", 8, "0", 100, "AcDbBlockEnd", 0,
          "ENDSEC", 0, "SECTION", 2, "ENTITIES")
    head("LWPOLYLINE", "4D", "AcDbPolyline")
    f.put(90, "    8", 70, "    1", 43, 0)
    for x, y, bulge in OUTLINE:
        f.put(10, float(x), 20, float(y))
        if bulge:
            f.text += f" 42\n{bulge:.16g}\n"
    head("ELLIPSE", "4E", "AcDbEllipse")
    f.put(10, 30, 20, 30, 11, 8, 21, 0, 40, 1, 41, 0, 42, 6.283185307179586)
    head("POINT", "4F", "AcDbPoint")
    f.put(10, 30, 20, 30, 0, "ENDSEC", 0, "EOF")
    f.write("librecad.dxf")


def qcad():
    f = File("{:>3}", "{:.16g}")
    head = lambda kind, handle, sub: f.put(0, kind, 5, handle, 100, "AcDbEntity", 100, sub, 8, "CUT", 62, "    256", 370,
                                           "    -1", 6, "ByLayer")
    f.put(999, "dxflib 2.2.0.0", 0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1015", 9, "$HANDSEED", 5, "FFFF", 9,
          "$INSUNITS", 70, "     1", 0, "ENDSEC", 0, "SECTION", 2, "TABLES", 0, "TABLE", 2, "LAYER", 5, "2", 100,
          "AcDbSymbolTable", 70, "     2", 0, "LAYER", 5, "50", 100, "AcDbSymbolTableRecord", 100,
          "AcDbLayerTableRecord", 2, "CUT", 70, "     0", 62, "     1", 420, "   16711680", 6, "CONTINUOUS", 370, "    25",
          390, "F", 0, "ENDTAB", 0, "ENDSEC", 0, "SECTION", 2, "ENTITIES")
    handle = 0x60
    for (ax, ay), (bx, by) in SIDES:
        head("LINE", f"{handle:X}", "AcDbLine")
        f.put(10, ax / 25.4, 20, ay / 25.4, 30, 0.0, 11, bx / 25.4, 21, by / 25.4, 31, 0.0)
        handle += 1
    for (x, y), begin, end in CORNERS:
        head("ARC", f"{handle:X}", "AcDbCircle")
        f.put(10, x / 25.4, 20, y / 25.4, 30, 0.0, 40, 10 / 25.4, 100, "AcDbArc", 50, float(begin), 51, float(end))
        handle += 1
    head("CIRCLE", f"{handle:X}", "AcDbCircle")
    f.put(10, 30 / 25.4, 20, 30 / 25.4, 30, 0.0, 40, 8 / 25.4, 0, "ENDSEC", 0, "EOF")
    f.write("qcad_inch.dxf")


def cubic(f, head, points):
    head()
    f.put(70, 8, 71, 3, 72, 8, 73, 4, 74, 0)
    for knot in (0, 0, 0, 0, 1, 1, 1, 1):
        f.put(40, knot)
    for x, y in points:
        f.put(10, float(x), 20, float(y), 30, 0.0)


def quarter(x, y, radius, begin):
    """The control points of a cubic's quarter circle."""
    a = math.radians(begin)
    at = lambda u, v: (x + radius * (u * math.cos(a) - v * math.sin(a)), y + radius * (u * math.sin(a) + v * math.cos(a)))
    return [at(1, 0), at(1, K), at(K, 1), at(0, 1)]


def inkscape():
    f = File("{}", "{:.6f}")
    f.put(999, "DXF of the outlines", 0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1014", 9, "$HANDSEED", 5, "FFFF", 9,
          "$MEASUREMENT", 70, "     1", 0, "ENDSEC", 0, "SECTION", 2, "TABLES", 0, "TABLE", 2, "LAYER", 5, "2", 100,
          "AcDbSymbolTable", 70, 1, 0, "LAYER", 5, "10", 100, "AcDbSymbolTableRecord", 100, "AcDbLayerTableRecord", 2,
          "Ebene 1", 70, 0, 6, "CONTINUOUS", 0, "ENDTAB", 0, "ENDSEC", 0, "SECTION", 2, "BLOCKS", 0, "ENDSEC", 0, "SECTION",
          2, "ENTITIES")
    number = [255]

    def head(kind="SPLINE"):
        number[0] += 1
        f.put(0, kind, 5, f"{number[0]:x}", 100, "AcDbEntity", 8, "Ebene 1", 62, 7, 100, "AcDb" + kind.capitalize())
    for (ax, ay), (bx, by) in SIDES:
        head("LINE")
        f.put(10, float(ax), 20, float(ay), 30, 0.0, 11, float(bx), 21, float(by), 31, 0.0)
    for (x, y), begin, _ in CORNERS:
        cubic(f, head, quarter(x, y, 10, begin))
    for begin in (0, 90, 180, 270):
        cubic(f, head, quarter(30, 30, 8, begin))
    f.put(0, "ENDSEC", 0, "SECTION", 2, "OBJECTS", 0, "DICTIONARY", 5, "C", 0, "ENDSEC", 0, "EOF")
    f.write("inkscape.dxf")


def freecad():
    f = File("{}", "{:.15g}")
    f.put(999, "DXF of a sketch", 0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1009", 9, "$INSUNITS", 70, 4, 0, "ENDSEC",
          0, "SECTION", 2, "ENTITIES")
    # Sketches leave noise in the last digits.
    for (ax, ay), (bx, by) in SIDES:
        f.put(0, "LINE", 8, "Sketch001", 10, ax + 1e-14 * ay, 20, float(ay), 30, 0.0, 11, float(bx), 21, by - 1e-15 * bx, 31,
              0.0)
    for (x, y), begin, end in CORNERS:
        f.put(0, "ARC", 8, "Sketch001", 10, float(x), 20, float(y), 30, 0.0, 40, 10.0, 50, begin - 1e-13, 51, end + 1e-13)
    f.put(0, "CIRCLE", 8, "Sketch001", 10, 30.0, 20, 30.0, 30, 0.0, 40, 8.0, 0, "ENDSEC", 0, "EOF")
    f.write("freecad.dxf")


def rhino():
    """Rational splines and polylines in space."""
    f = File("{:>3}", "{:.15g}", "\r\n")
    f.put(0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1018", 9, "$INSUNITS", 70, "     5", 9, "$DWGCODEPAGE", 3,
          "ANSI_1252", 0, "ENDSEC", 0, "SECTION", 2, "ENTITIES")
    handle = [0x30]

    def head(kind, sub):
        handle[0] += 1
        f.put(0, kind, 5, f"{handle[0]:X}", 100, "AcDbEntity", 8, "Default", 62, "     7", 100, sub)
    for side in SIDES:
        head("POLYLINE", "AcDb3dPolyline")
        f.put(66, "     1", 10, 0.0, 20, 0.0, 30, 0.0, 70, "     8")
        for x, y in side:
            f.put(0, "VERTEX", 8, "Default", 10, x / 10, 20, y / 10, 30, 0.25, 70, "    32")
        f.put(0, "SEQEND", 8, "Default")
    w = math.sqrt(0.5)
    circle = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    for (x, y), begin, _ in CORNERS:
        head("SPLINE", "AcDbSpline")
        f.put(210, 0.0, 220, 0.0, 230, 1.0, 70, "    12", 71, "     2", 72, "     6", 73, "     3", 74, "     0")
        for knot in (0.0, 0.0, 0.0, 5 * math.pi, 5 * math.pi, 5 * math.pi):
            f.put(40, knot / 10)
        k = begin // 45 % 8
        for (u, v), weight in zip((circle + circle[1:])[k:k + 3], (1.0, w, 1.0)):
            f.put(10, (x + 10 * u) / 10, 20, (y + 10 * v) / 10, 30, 0.25, 41, weight)
    head("SPLINE", "AcDbSpline")
    f.put(70, "    13", 71, "     2", 72, "    12", 73, "     9", 74, "     0")
    for knot in (0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4):
        f.put(40, float(knot))
    for k, (u, v) in enumerate(circle):
        f.put(10, (30 + 8 * u) / 10, 20, (30 + 8 * v) / 10, 30, 0.25, 41, w if k % 2 else 1.0)
    f.put(0, "ENDSEC", 0, "EOF")
    f.write("rhino_cm.dxf")


def coreldraw():
    """One POLYLINE of the outline as lines and cubics, layers of long names, no EOF."""
    f = File("{:>3}", "{:.8f}", "\r\n")
    f.put(0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1014", 9, "$DWGCODEPAGE", 3, "ANSI_1252", 9, "$MEASUREMENT", 70,
          "     1", 0, "ENDSEC", 0, "SECTION", 2, "TABLES", 0, "TABLE", 2, "LAYER", 70, "     1", 0, "LAYER", 2,
          "Layer_1_CorelLayer_été", 70, "     0", 62, "     7", 6, "CONTINUOUS", 0, "ENDTAB", 0, "ENDSEC", 0, "SECTION", 2,
          "ENTITIES")

    def head():
        f.put(0, "SPLINE", 100, "AcDbEntity", 8, "Layer_1_CorelLayer_été", 100, "AcDbSpline", 210, 0.0, 220, 0.0, 230, 1.0)
    for (ax, ay), (bx, by) in SIDES:
        f.put(0, "LWPOLYLINE", 100, "AcDbEntity", 8, "Layer_1_CorelLayer_été", 100, "AcDbPolyline", 90, "     2", 70, "     0",
              10, float(ax), 20, float(ay), 10, float(bx), 20, float(by))
    for (x, y), begin, _ in CORNERS:
        cubic(f, head, quarter(x, y, 10, begin))
    for begin in (0, 90, 180, 270):
        cubic(f, head, quarter(30, 30, 8, begin))
    f.put(0, "ENDSEC")
    f.write("coreldraw.dxf", "cp1252")


for program in (autocad_r12, autocad_2018, librecad, qcad, inkscape, freecad, rhino, coreldraw):
    program()
