"""Families of hostile input, each of a size n: the worst that we know for every reader and every check.

Each entry of FAMILIES is a name, a size n at which it is run (and at 2 n, about a megabyte unless the command
is dear), the words after `lekalo`, and a function that makes its files. growth_test.py runs them.
"""

import json
import math
import random

# ---- drawings ---------------------------------------------------------------------------------------------


def number(x):
    return repr(round(x, 9))


def dxf(entities, blocks=""):
    blocks = f"0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n" if blocks else ""
    return ("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n" + blocks + "0\nSECTION\n2\nENTITIES\n" +
            "".join(entities) + "0\nENDSEC\n0\nEOF\n")


def groups(kind, *pairs):
    return f"0\n{kind}\n8\n0\n" + "".join(f"{code}\n{value}\n" for code, value in pairs)


def line(a, b):
    return groups("LINE", (10, number(a[0])), (20, number(a[1])), (11, number(b[0])), (21, number(b[1])))


def circle(x, y, r):
    return groups("CIRCLE", (10, number(x)), (20, number(y)), (40, number(r)))


def arc(x, y, r, begin, end):
    return groups("ARC", (10, number(x)), (20, number(y)), (40, number(r)), (50, number(begin)), (51, number(end)))


def polyline(points, bulge=None):
    pairs = [(90, len(points)), (70, 1)]
    for x, y in points:
        pairs += [(10, number(x)), (20, number(y))] + ([(42, bulge)] if bulge else [])
    return groups("LWPOLYLINE", *pairs)


def square(x, y, side):
    return [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]


FRAME = polyline([(-10, -10), (100000, -10), (100000, 100000), (-10, 100000)])


def drawing(entities, blocks=""):
    return {"a.dxf": dxf(entities, blocks)}


def slot(x, y, length, width, angle):
    c, s = math.cos(angle), math.sin(angle)
    return [(x + c * u - s * v, y + s * u + c * v) for u, v in ((0, 0), (length, 0), (length, width), (0, width))]


def comb(n, pitch, height):
    points = [(k * pitch, height if k % 2 == 0 else 0) for k in range(n)]
    return points + [((n - 1) * pitch, -5), (0, -5)]


def broad_comb(n):
    teeth = [(4 * k + x, y) for k in range(n) for x, y in ((0, 0), (0, 10), (2, 10), (2, 0))]
    return teeth + [(4 * n, 0), (4 * n, -5), (0, -5)]


def spiral(n, pitch=0.02):
    def at(k, out):
        angle = 0.1 * k
        r = 5 + pitch * angle + out
        return r * math.cos(angle), r * math.sin(angle)
    return [at(k, 0) for k in range(n)] + [at(k, 0.4 * pitch * 6.28) for k in reversed(range(n))]


def crossing(n):
    draw = random.Random(1)
    at = lambda: (draw.uniform(0, 1000), draw.uniform(0, 1000))
    return [line(at(), at()) for _ in range(n)]


def shuffled_ring(n):
    corner = lambda k: (1000 * math.cos(2 * math.pi * k / n), 1000 * math.sin(2 * math.pi * k / n))
    lines = [line(corner(k), corner((k + 1) % n)) for k in range(n)]
    random.Random(1).shuffle(lines)
    return lines


def inserts(n):
    block = "0\nBLOCK\n8\n0\n2\nb\n70\n0\n10\n0\n20\n0\n" + circle(0, 0, 0.3) + "0\nENDBLK\n8\n0\n"
    return drawing([groups("INSERT", (2, "b"), (10, k % 300), (20, k // 300)) for k in range(n)], block)


def array(n):
    block = "0\nBLOCK\n8\n0\n2\nb\n70\n0\n10\n0\n20\n0\n" + circle(0, 0, 0.3) + "0\nENDBLK\n8\n0\n"
    return drawing([groups("INSERT", (2, "b"), (10, 0), (20, 0), (70, n), (71, 100), (44, 1), (45, 1))], block)


def spline(n):
    knots = [0] * 4 + list(range(1, n - 3)) + [n - 3] * 4
    pairs = [(70, 8), (71, 3), (72, len(knots)), (73, n)] + [(40, k) for k in knots]
    for k in range(n):
        angle = 2 * math.pi * k / (n - 1)
        pairs += [(10, number(1000 * math.cos(angle))), (20, number(1000 * math.sin(angle)))]
    return [groups("SPLINE", *pairs)]


def ellipses(n):
    return [groups("ELLIPSE", (10, 10 * (k % 100)), (20, 10 * (k // 100)), (11, 4), (21, 0), (40, 0.5), (41, 0),
                   (42, 6.283185307179586)) for k in range(n)]


def layers(n):
    return [circle(3 * (k % 200), 3 * (k // 200), 1).replace("8\n0\n", f"8\nlayer{k}\n", 1) for k in range(n)]


def svg(body, style=""):
    style = f"<style>{style}</style>" if style else ""
    return {"a.svg": '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
                     f'width="1000mm" height="1000mm" viewBox="0 0 1000 1000">{style}{body}</svg>\n'}


PLATE = '<rect x="1" y="1" width="900" height="900"/>'


def svg_styles(n):
    rules = "".join(f".c{k}{{display:none}}" for k in range(n))
    return svg(PLATE + "".join(f'<circle class="c{k}" r="1"/>' for k in range(n)), rules)


def svg_equal_rules(n):
    return svg(PLATE + '<circle class="a b" r="1"/>' * n, ".a{display:none}.b{visibility:hidden}" * n)


def svg_classes(n):
    names = " ".join(f"c{k}" for k in range(n))
    return svg(PLATE + f'<circle class="{names}" r="1"/>', "".join(f".c{k}{{display:none}}" for k in range(n)))


def svg_attributes(n):
    return svg(PLATE + "<g " + " ".join(f'a{k}="1"' for k in range(n)) + '><circle cx="5" cy="5" r="1"/></g>')


def svg_uses(n):
    uses = "".join(f'<use xlink:href="#p{k % 100}" x="{2 * (k % 400)}" y="{2 * (k // 400)}"/>' for k in range(n))
    return svg("<defs>" + "".join(f'<circle id="p{k}" r="0.5"/>' for k in range(100)) + "</defs>" + uses)


def svg_ids(n):
    return svg("<defs>" + "".join(f'<circle id="p{k}" r="0.5"/>' for k in range(n)) + "</defs>" +
               "".join(f'<use xlink:href="#p{k}" x="{2 * (k % 400)}" y="{2 * (k // 400)}"/>' for k in range(n)))


def svg_beziers(n):
    return svg("".join(f'<path d="M{8 * (k % 100)} {2 * (k // 100)}c1 1 2 1 3 0c-1 .5 -2 .5 -3 0z"/>' for k in range(n)))


def svg_subpaths(n):
    return svg('<path d="' + "M5 5h9v9h-9z" * n + '"/>')


def svg_path(n):
    wave = "".join(f"l{1000 / n:.6f} {'1' if k % 2 else '-1'}" for k in range(n))
    return svg(f'<path d="M0 50{wave}V900H0z"/>')


def svg_arcs(n):
    return svg('<path d="M0 50' + f"a1 1 0 0 {n % 2} {900 / n:.6f} 0" * n + 'V900H0z"/>')


def svg_groups(n):
    return svg("".join(f'<g transform="translate({2 * (k % 400)} {2 * (k // 400)})"><circle r=".5"/></g>'
                       for k in range(n)))


# ---- regions, trees, contours -----------------------------------------------------------------------------


def edges(points):
    return [{"line": {"from": list(a), "to": list(b)}} for a, b in zip(points, points[1:] + points[:1])]


def ring(x, y, r):
    return [{"arc": {"from": [x + r, y], "to": [x + r, y], "centre": [x, y], "ccw": True}}]


def region(outer, holes=()):
    return json.dumps({"units": "mm", "outer": outer, "holes": list(holes)})


def holed(holes, size=4000):
    return {"a.json": region(edges(square(-1, -1, size)), holes)}


def rings(n):
    pieces = [{"outer": ring(0, 0, 10 + 2 * k + 1), "holes": [ring(0, 0, 10 + 2 * k)]} for k in range(n)]
    return {"a.json": json.dumps({"units": "mm", "pieces": pieces})}


def tree(shape):
    return {"a.json": json.dumps({"units": "mm", "shape": shape})}


def disc(x, y, r):
    return {"circle": {"centre": [x, y], "radius": r}}


def deep(n):
    shape = {"circle": {"radius": 100}}
    for k in range(n):
        shape = {"difference": [shape, disc(0.5 * (k % 100), 0.5 * (k // 100), 0.2)]}
    return tree(shape)


def half_planes(n):
    planes = []
    for k in range(n):
        a, b = 2 * math.pi * k / n, 2 * math.pi * (k + 1) / n
        planes.append({"half_plane": {"from": [100 * math.cos(a), 100 * math.sin(a)],
                                      "to": [100 * math.cos(b), 100 * math.sin(b)]}})
    return tree({"intersection": planes})


def contour(points):
    return {"a.csv": "".join(f"{x:.9f},{y:.9f}\n" for x, y in points)}


def on_circle(n, r=500):
    return [(r * math.cos(2 * math.pi * k / n), r * math.sin(2 * math.pi * k / n)) for k in range(n)]


# ---- layouts ----------------------------------------------------------------------------------------------


def layout(outline, placements=(), size=1000.0):
    parts = [{"id": "p", "demand": len(placements), "outline": outline}]
    return {"a.json": json.dumps({
        "format": "lekalo-layout/1", "units": "mm", "name": "o", "rules": {"gap": 0},
        "stocks": [{"id": "s", "kind": "sheet", "count": 1,
                    "outline": {"polygon": {"outer": square(0, 0, size)}}}],
        "parts": parts, "placements": list(placements)})}


def polygon(points):
    return {"polygon": {"outer": [list(p) for p in points]}}


def placed(n, place):
    return [{"id": k + 1, "part": "p", "stock": "s", "x": place(k)[0], "y": place(k)[1], "rotation_deg": 0}
            for k in range(n)]


# ---- programs ---------------------------------------------------------------------------------------------

POCKET = region(edges(square(0, 0, 100)))


def program(lines):
    return {"a.ngc": "G21 G90\nG0 X50 Y50 Z5\nG1 Z-1 F100\n" + "".join(lines) + "G0 Z5\nM2\n", "p.json": POCKET}


SHOW = ["show", "a.dxf"]
SHOW_SVG = ["show", "a.svg"]
READ = ["locate", "--part", "a.json", "--blank", "a.json", "--window", "0", "0", "--lock-x", "0", "--lock-y", "0",
        "--work", "1", "-o", "r.json"]
CUT = ["simulate", "a.ngc", "--pocket", "p.json", "--tool", "6"]

FAMILIES = [
    ("dxf-equal-lines", 10000, SHOW, lambda n: drawing([line((0, 0), (100, 50))] * n)),
    ("dxf-near-copies", 8000, SHOW,
     lambda n: drawing([line((0, 1e-9 * k), (100, 50)) for k in range(n)])),
    ("dxf-equal-circles", 10000, SHOW, lambda n: drawing([circle(0, 0, 5)] * n)),
    ("dxf-concentric", 10000, SHOW, lambda n: drawing([circle(0, 0, 1 + 0.1 * k) for k in range(n)])),
    ("dxf-nested-squares", 4000, SHOW,
     lambda n: drawing([polyline(square(-0.1 * k, -0.1 * k, 1 + 0.2 * k)) for k in range(n)])),
    ("dxf-crossing-lines", 8000, SHOW, lambda n: drawing(crossing(n))),
    ("dxf-slanting-slots", 4000, SHOW,
     lambda n: drawing([polyline(slot(k, 0, 2.0 * n, 0.3, 0.7)) for k in range(n)])),
    ("dxf-grid-of-circles", 10000, SHOW,
     lambda n: drawing([circle(2 * (k % 100), 2 * (k // 100), 0.5) for k in range(n)])),
    ("dxf-circles-in-a-row", 10000, SHOW, lambda n: drawing([circle(2 * k, 0, 0.5) for k in range(n)])),
    ("dxf-star", 8000, SHOW,
     lambda n: drawing([line((0, 0), (100 * math.cos(k), 100 * math.sin(k))) for k in range(n)])),
    ("dxf-shuffled-ring", 8000, SHOW, lambda n: drawing(shuffled_ring(n))),
    ("dxf-collinear", 8000, SHOW, lambda n: drawing([line((k, 0), (k + 1.5, 0)) for k in range(n)])),
    ("dxf-one-circle-in-arcs", 8000, SHOW,
     lambda n: drawing([arc(0, 0, 50, 360 * k / n, 360 * (k + 1.5) / n) for k in range(n)])),
    ("dxf-bulges", 10000, SHOW, lambda n: drawing([polyline(on_circle(n), 0.1)])),
    ("dxf-comb", 15000, SHOW, lambda n: drawing([polyline(comb(n, 0.05, 50))])),
    ("dxf-tall-comb", 15000, SHOW,
     lambda n: drawing([polyline([(y, x) for x, y in comb(n, 0.05, 50)])])),
    ("dxf-spiral", 10000, SHOW, lambda n: drawing([polyline(spiral(n))])),
    ("dxf-spline", 5000, SHOW, lambda n: drawing(spline(n))),
    ("dxf-ellipses", 1500, SHOW, lambda n: drawing(ellipses(n))),
    ("dxf-inserts", 8000, SHOW, inserts),
    ("dxf-array", 1000, SHOW, array),
    ("dxf-layers", 8000, SHOW, lambda n: drawing(layers(n))),
    ("dxf-retraced-polyline", 10000, SHOW, lambda n: drawing([polyline([(0, 0), (10, 0), (10, 10)] * n)])),
    ("svg-styles", 8000, SHOW_SVG, svg_styles),
    ("svg-equal-rules", 8000, SHOW_SVG, svg_equal_rules),
    ("svg-classes-of-one", 20000, SHOW_SVG, svg_classes),
    ("svg-attributes-of-one", 30000, SHOW_SVG, svg_attributes),
    ("svg-uses", 8000, SHOW_SVG, svg_uses),
    ("svg-uses-of-many", 6000, SHOW_SVG, svg_ids),
    ("svg-beziers", 5000, SHOW_SVG, svg_beziers),
    ("svg-equal-subpaths", 20000, SHOW_SVG, svg_subpaths),
    ("svg-wave", 20000, SHOW_SVG, svg_path),
    ("svg-arcs", 10000, SHOW_SVG, svg_arcs),
    ("svg-groups", 8000, SHOW_SVG, svg_groups),
    ("region-holes", 3000, READ,
     lambda n: holed([ring(3 * (k % 100) + 2, 3 * (k // 100) + 2, 1) for k in range(n)])),
    ("region-holes-in-a-row", 3000, READ, lambda n: holed([ring(3 * k + 2, 5, 1) for k in range(n)], 3 * n + 10)),
    ("region-holes-in-a-comb", 1500, READ,
     lambda n: {"a.json": region(edges(broad_comb(n)), [ring(4 * k + 1, 5, 0.5) for k in range(n)])}),
    ("region-square-holes-in-a-row", 1500, READ,
     lambda n: holed([edges(square(3 * k + 2, 5, 1)) for k in range(n)], 3 * n + 10)),
    ("region-rings", 2000, READ, rings),
    ("region-comb", 5000, READ, lambda n: {"a.json": region(edges(comb(n, 0.02, 50)))}),
    ("region-spiral", 2500, READ, lambda n: {"a.json": region(edges(spiral(n)))}),
    ("region-slanting-holes", 1500, READ,
     lambda n: holed([edges(slot(k, 0, 2.0 * n, 0.3, 0.7)) for k in range(n)], 5 * n)),
    ("tree-discs-in-a-row", 5000, READ,
     lambda n: tree({"union": [disc(1.5 * k, 0, 1) for k in range(n)]})),
    ("tree-apart-discs-in-a-row", 2500, READ,
     lambda n: tree({"union": [disc(3 * k, 0, 1) for k in range(n)]})),
    ("tree-nested-discs", 5000, READ, lambda n: tree({"union": [disc(0, 0, 1 + 0.1 * k) for k in range(n)]})),
    ("tree-equal-discs", 5000, READ, lambda n: tree({"union": [disc(0, 0, 1)] * n})),
    ("tree-crossing-bars", 2000, READ,
     lambda n: tree({"union": [{"rotate": {"by_deg": 180 * k / n, "shape": {"rectangle": {"size": [1000, 1]}}}}
                               for k in range(n)]})),
    ("tree-plate-less-discs", 4900, READ,
     lambda n: tree({"difference": [{"rectangle": {"size": [1000, 1000]}}] +
                     [disc(3 * (k % 100) - 200, 3 * (k // 100) - 200, 1) for k in range(n)]})),
    ("tree-half-planes", 400, READ, half_planes),
    ("contour-circle", 20000,
     ["locate", "--part", "a.csv", "--blank", "a.csv", "--window", "0", "0", "--work", "1", "-o", "r.json"],
     lambda n: contour(on_circle(n))),
    ("contour-comb", 20000,
     ["locate", "--part", "a.csv", "--blank", "a.csv", "--window", "0", "0", "--lock-x", "0", "--lock-y", "0",
      "--work", "1", "-o", "r.json"], lambda n: contour(comb(n, 0.01, 50))),
    ("scan-circle", 10000,
     ["locate", "--part", "p.csv", "--blank", "a.csv", "--uncertainty", "0.01", "--max-dip", "0.1", "--window",
      "0", "0", "--work", "1", "-o", "r.json"],
     lambda n: contour(on_circle(n)) | {"p.csv": "0,0\n10,0\n0,10\n"}),
    ("layout-comb", 20000, ["check", "a.json"], lambda n: layout(polygon(comb(n, 0.002, 50)))),
    ("layout-tall-comb", 20000, ["check", "a.json"],
     lambda n: layout(polygon([(y, x) for x, y in comb(n, 0.002, 50)]))),
    ("layout-spiral", 6000, ["check", "a.json"], lambda n: layout(polygon(spiral(n)))),
    ("layout-round-holes", 5000, ["check", "a.json"],
     lambda n: layout({"curves": json.loads(holed([ring(12 * (k % 300) + 6, 12 * (k // 300) + 6, 1)
                                                    for k in range(n)])["a.json"])})),
    ("layout-side-by-side", 4000, ["check", "a.json"],
     lambda n: layout(polygon(square(0, 0, 2)), placed(n, lambda k: (3 * (k % 300), 3 * (k // 300))))),
    ("layout-in-a-row", 4000, ["check", "a.json"],
     lambda n: layout(polygon(square(0, 0, 2)), placed(n, lambda k: (3 * k, 5)), 3.0 * n + 10)),
    ("program-above-the-stock", 15000, CUT,
     lambda n: program(["G0 Z5\n"] + [f"G1 X{20 + 60 * (k % 2)} Y{20 + 60 * k / n:.4f}\n" for k in range(n)])),
    ("program-retraced", 1000, CUT, lambda n: program(["G1 X20\n", "G1 X80\n"] * (n // 2))),
    ("program-arcs", 1000, CUT, lambda n: program(["G2 X50 Y50 I10 J0\n"] * n)),
    ("program-far-lines", 5000, CUT,
     lambda n: program([f"G1 X{900000 if k % 2 else -900000}\n" for k in range(n)])),
    ("program-far-arcs", 20, CUT,
     lambda n: program([f"G2 X50 Y50 I{100000 + k} J0\n" for k in range(n)])),
    ("program-comments", 40000, CUT, lambda n: program(["(nothing)\n"] * n)),
]
