"""The kinds of results, each made by the program itself from the examples."""

import functools
import hashlib
import itertools
import json
import re
from dataclasses import dataclass, field

import changes
import common
import cuts
import demands
import drawn
import drawn_changes
import layouts
import solids
import stocks
import truth

BENT = ('<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="40mm" viewBox="0 0 80 40"><path d="M0 0H80V40H0Z"/>'
        '<path d="M0 10H80"/><path d="M30 20L50 30"/><circle cx="20" cy="25" r="5"/></svg>')
BENT_FROM = ('<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60">'
             '<path d="M0 0H100V60H0Z"/></svg>')
PLATE = '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40">' \
        '<g id="WALL"><path d="M0 0H60V40H0"/></g><g id="OPEN"><path d="M0 40V0"/></g>' \
        '<g id="ISLAND"><circle cx="30" cy="20" r="6"/></g></svg>'
TREE = {"units": "mm", "shape": {"difference": [
    {"rectangle": {"corner": [0, 0], "size": [60, 40]}, "name": "frame"},
    {"circle": {"centre": [30, 20], "radius": 6}, "name": "stud"}]}}
POCKET = {"units": "mm", "outer": [
    {"line": {"from": [0, 0], "to": [40, 0]}}, {"line": {"from": [40, 0], "to": [40, 24]}},
    {"line": {"from": [40, 24], "to": [0, 24]}}, {"line": {"from": [0, 24], "to": [0, 0]}}]}
SQUARE = '<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="30mm" viewBox="0 0 30 30">' \
         '<rect width="30" height="30"/></svg>'
LETTERED = "\n".join(
    ["0", "SECTION", "2", "ENTITIES", "0", "LWPOLYLINE", "8", "CUT", "90", "4", "70", "1", "10", "0", "20", "0", "10", "30", "20",
     "0", "10", "30", "20", "20", "10", "0", "20", "20", "0", "LINE", "8", "BEND", "62", "5", "10", "2", "20", "3", "11", "28",
     "21", "3", "0", "TEXT", "8", "NAME", "10", "5", "20", "8", "40", "3", "1", "N 7", "0", "ENDSEC", "0", "EOF", ""])
LAYERS = {"format": "lekalo-layers/1", "layers": [{"name": "ENG", "role": "engrave"}, {"name": "BEND", "role": "bend"}]}
SMALL = '<svg xmlns="http://www.w3.org/2000/svg" width="14mm" height="10mm" viewBox="0 0 14 10">' \
        '<rect width="14" height="10"/></svg>'
ORDER = "file,quantity,material,thickness,customer,due,label\na.svg,1,steel,2,Orlova,2026-12-01,7\n" \
        "b.svg,2,birch,9,,,\nb.svg,1,steel,2,,2026-12-02,\n"
SHEET = "steel 2 mm#1"
RATES = {"format": "lekalo-rates/1", "currency": "EUR", "decimals": 2, "margin_percent": 12.5, "tax_percent": 19,
         "machine": {"rapid_mm_per_min": 20000, "acceleration_mm_per_s2": [3000, 2500, 500], "junctions": "exact path",
                     "settle_s": 0.01, "setup_s_once": 600, "setup_s_per_sheet": 120},
         "rates": {"per_hour": 85, "setup_per_hour": 48, "per_pierce": 0.02, "per_m_cut": 0.14},
         "materials": [{"material": "steel", "thickness_mm": 2, "per_m2": 31.5, "least_remnant_mm": 5},
                       {"material": "birch", "thickness_mm": 9, "per_sheet": 7.75, "sheet_mm": [40, 40],
                        "remnant_percent": 60, "least_remnant_mm": 5}]}
PROGRAM = "G21 G90 G17 G54 F90\nT1 M6\nG0 X0. Y0.\nG43 H1 Z80.\nG1 Z40.\nG2 X10. Y0. I5. Z38.\nG91 G1 X2. Z-1.5\nG90\n" \
          "G98 G81 X1. Y2. Z-3. R42.\nX5.\nG80\nG0 Z80.\nM30\n"


# Contacts and multipliers are claims to a millionth of the blank's size, and of 1 (docs/formats.md).
TO_A_MILLIONTH = ((r"/contacts/\d+/(part_at|blank_at|distance)", 1e-3), (r"/.*/multiplier$", 4e-6))
# Placements of solids leave room for roundings in their poses and windows, and their certificates are looser still. A
# point of contact may move along its face by what changes no distance.
OF_SOLIDS = ((r"/contacts/\d+/(part|blank)_point", 0.05), (r"/certificate/trees/\d+/(x|y|z|turn)", 1e-9),
             (r"/certificate/(part|blank)_balls|/certificate/planes|/certificate/.*/nodes/\d+/1$", 0.02),
             (r"/certificate/.*/quaternion|/(window/)?(quaternion|x$|y$|z$)|/(upper_bound|gap)$", 1e-6),
             (r"/window/(shift|turn_deg)$", 1e-9),
             (r"/scan/(widest|guard|min_radius|max_dip)$|/unknown_area_mm2$", 1e-4),
             (r"/scan/touches/(balls/|cuts/\d+/at|ways/\d+/at|around/|x/|y/|z/|moved/[xyz])", 0.02),
             (r"/scan/touches/(turn_.|quaternion|moved/quaternion|pivot)/", 1e-3),
             (r"/scan/touches/(ball|form)$", 1e-3))


def least_step(value, way, path):
    """The next double, or the least change of a number that its claim tells apart."""
    for rule, step in TO_A_MILLIONTH:
        if re.match(rule, path):
            return value + way * step
    return changes.next_double(value, way, path)


def step_of_solids(value, way, path):
    # A multiplier of a term, of any scale.
    if re.match(r"/certificate/.*/nodes/\d+/\d+/3$|/scan/touches/.*/(terms/\d+/2|multiplier)$", path):
        return value * (1 + 0.1 * way)
    return next((value + way * step for rule, step in OF_SOLIDS if re.match(rule, path)),
                least_step(value, way, path))


@dataclass
class Kind:
    name: str
    files: list  # copied, paths in the source tree
    commands: list  # that make the result; the last may end with a file for its standard output
    target: str  # the file that is changed
    verify: list
    oracle: object  # of (truth.Context); gives a function of a change: "information", "true" or None
    written: dict = field(default_factory=dict)  # files written beforehand
    inputs: list = field(default_factory=list)  # also changed, exchanged and taken away
    base: int = 0  # exit status of verify on the untouched result
    step: object = least_step
    form: str = "json"
    decimals: object = None  # of a text: as many as claims tell apart
    unproved: bool = False  # the untouched result claims no bound, and 1 confirms the rest
    report_of: str = ""  # the document whose digests follow the target, so that nothing but its meaning is amiss
    skip: object = lambda line: False


def digest(text):
    return hashlib.sha256(text.encode(errors="surrogateescape")).hexdigest()


def all_changes(kind, text):
    if kind.form == "json":
        return list(changes.of_json(text, kind.step))
    if kind.form == "stl":
        return list(changes.of_stl(text))
    ways = {"program": changes.of_program, "dxf": drawn_changes.of_dxf, "svg": drawn_changes.of_svg,
            "hpgl": drawn_changes.of_hpgl}
    if kind.form in ways:
        return list(ways[kind.form](text, kind.decimals))
    return list(changes.of_text(text, kind.skip, kind.decimals))


def kinds():
    loc, reg = "examples/localisation/", "examples/regions/"
    plate = [loc + "example-1-part.csv", loc + "example-1-blank.csv", loc + "part.nc"]
    bracket = [reg + "bracket.json", reg + "casting.json", reg + "bracket-features.json", reg + "bracket.nc"]
    flange = [reg + "flange.json", reg + "flange-scan.csv"]
    convex = ["locate", "--part", "example-1-part.csv", "--blank", "example-1-blank.csv"]
    region = ["locate", "--part", "bracket.json", "--blank", "casting.json", "--gap", "0.05"]
    first = convex + ["-o", "first.json"]
    full = convex + ["-o", "r.json", "--compare", "first.json", "--nc", "part.nc", "--nc-out", "o.nc",
                     "--deviations", "d.csv", "--alternatives", "0.5"]
    of_r = ["verify", "r.json"]
    yield Kind("placement, convex", plate, [first, full], "r.json", of_r, truth.convex,
               inputs=["example-1-part.csv", "example-1-blank.csv", "part.nc", "first.json", "o.nc", "d.csv"])
    yield Kind("placement, convex, proof in a file", plate, [convex + ["-o", "r.json", "--certificate", "c.json"]],
               "c.json", of_r, truth.convex_certificate, report_of="r.json")
    for role in ("part", "blank"):
        yield Kind(f"placement, convex, another {role}", plate, [convex + ["-o", "r.json"]],
                   f"example-1-{role}.csv", of_r, truth.convex_input(role), form="text", report_of="r.json")
    yield Kind("placement, convex, trimmed", [], [["locate", "--part", "part.csv", "--blank", "blank.csv", "--trim",
                                                   "0.05", "-o", "r.json"]], "r.json", of_r, truth.convex,
               written={"part.csv": "0 0\n80 0\n80 40\n0 40\n",
                        "blank.csv": "100 100\n145 100.03\n190 100\n190 150\n100 150\n"},
               inputs=["part.csv", "blank.csv"])
    yield Kind("table of deviations", plate, [first, full], "d.csv", of_r, truth.deviations, form="text",
               decimals=9, report_of="r.json")
    yield Kind("placement, regions", bracket, [region + ["-o", "r.json", "--nc", "bracket.nc", "--nc-out", "o.nc"]],
               "r.json", of_r, truth.regions, inputs=["bracket.json", "casting.json", "bracket.nc", "o.nc"])
    yield Kind("placement, regions, window and mirror", bracket,
               [region + ["-o", "r.json", "--window", "-10", "10", "--mirror", "either", "--min-allowance", "1"]],
               "r.json", of_r, truth.regions, inputs=["bracket.json", "casting.json"])
    for role, file in (("part", "bracket.json"), ("blank", "casting.json")):
        yield Kind(f"placement, regions, another {role}", bracket, [region + ["-o", "r.json"]], file, of_r,
                   truth.region_input(role), report_of="r.json")
    yield Kind("placement, demands", bracket,
               [region + ["-o", "r.json", "--features", "bracket-features.json"]], "r.json", of_r, demands.oracle,
               inputs=["bracket.json", "casting.json", "bracket-features.json"])
    yield Kind("placement, demands, largest", bracket,
               [region + ["-o", "r.json", "--features", "bracket-features.json", "--criterion", "largest",
                          "--give-up", "0.1", "--trade-off", "2"]], "r.json", of_r, demands.oracle,
               inputs=["bracket-features.json"])
    yield Kind("placement, demands, another features file", bracket,
               [region + ["-o", "r.json", "--features", "bracket-features.json"]], "bracket-features.json", of_r,
               truth.features_input, report_of="r.json")
    yield Kind("placement, scan", flange,
               [["locate", "--part", "flange.json", "--blank", "flange-scan.csv", "--uncertainty", "0.01",
                 "--min-radius", "4", "--min-allowance", "1", "--gap", "0.2", "-o", "r.json"]], "r.json", of_r,
               truth.regions, inputs=["flange.json", "flange-scan.csv"])
    yield Kind("placement, drawing", bracket,
               [region + ["--drawing", "placed.dxf"],
                ["locate", "--part", "placed.dxf", "--part-layers", "PART", "--blank", "placed.dxf",
                 "--blank-layers", "BLANK", "--window", "-2", "2", "--gap", "0.05", "-o", "r.json"]], "r.json",
               of_r, truth.regions, inputs=["placed.dxf"])
    yield Kind("placement, drawing with lines that enclose nothing", [],
               [["locate", "--part", "part.svg", "--blank", "blank.svg", "--window", "-2", "2", "--gap", "0.05", "-o",
                 "r.json"]], "r.json", of_r, truth.regions, inputs=["part.svg", "blank.svg"],
               written={"part.svg": BENT, "blank.svg": BENT_FROM})
    yield Kind("program, rewritten", bracket,
               [region + ["-o", "r.json", "--nc", "bracket.nc", "--nc-out", "o.nc"]], "o.nc", of_r,
               truth.rewritten, form="text", report_of="r.json")
    yield from of_solids()
    yield from of_layouts()
    yield from of_cuts()
    yield from of_drawn()
    yield from of_stocks()
    yield from of_pockets()
    yield from of_fits()
    yield from of_heat()


def box(low, high):
    """An OBJ of a box, two triangles a side."""
    corners = [f"v {x} {y} {z}" for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    sides = ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4))
    return "\n".join(corners + [f"f {a} {b} {c}\nf {a} {c} {d}" for a, b, c, d in sides]) + "\n"


def measured_box(x, y, z):
    """The points that a scanner sees of a box that stands at z = 0, 2 mm apart."""
    return "".join(f"{a} {b} {c}\n" for a in range(0, x + 1, 2) for b in range(0, y + 1, 2) for c in range(0, z + 1, 2)
                   if c == z or a in (0, x) or b in (0, y))


def touched_box(x, y, z, directions=False):
    """The centres of a ball of a radius of 1 that touches a box at four places of each side, maybe with the
    directions in which it has left the box."""
    made = []
    for axis, length in enumerate((x, y, z)):
        for at in (-1, length + 1):
            others = [(0.2 * side, 0.8 * side) for k, side in enumerate((x, y, z)) if k != axis]
            for a, b in itertools.product(*others):
                place = [a, b]
                place.insert(axis, at)
                made.append("{:g} {:g} {:g}".format(*place))
                if directions:
                    made[-1] += "".join(" {}".format((-2 if at < 0 else 2) * (k == axis)) for k in range(3))
                made[-1] += "\n"
    return "".join(made)


# The top is held to less than lies over it where the part is in the middle.
MAXIMA = """{"units": "mm", "minimum": 0.5, "features": [
  {"name": "top", "plane": {"normal": [0, 0, 1], "at": 9, "within": 0.001}, "minimum": 0.25, "maximum": 1.5}]}
"""
# The top may stick out of the blank, by no more than half a millimetre, and so may what is near it.
FINISHED = """{"units": "mm", "minimum": 0.25, "features": [
  {"name": "top", "plane": {"normal": [0, 0, 1], "at": 9, "within": 0.001}, "finished": 0.5, "rim": 3},
  {"name": "underside", "plane": {"normal": [0, 0, 1], "at": 2, "within": 0.001}, "minimum": 0.5}]}
"""


# Top and underside have 4 mm together, and should have one much more than the other.
TARGETS = """{"units": "mm", "minimum": 0.25, "features": [
  {"name": "top", "plane": {"normal": [0, 0, 1], "at": 9, "within": 0.001}, "target": 2.25},
  {"name": "underside", "plane": {"normal": [0, 0, 1], "at": 2, "within": 0.001}, "minimum": 0.5, "target": 1.75}]}
"""


def of_solids():
    meshes = ["examples/solid/part.stl", "examples/solid/casting.stl"]
    climb = ["locate", "--part", "part.stl", "--blank", "casting.stl", "--method", "climb"]
    near = climb[:5] + ["--start", "s.json", "-o", "r.json"]
    start, of_r, stl = climb + ["-o", "s.json"], ["verify", "r.json"], ["part.stl", "casting.stl"]
    placed = functools.partial(Kind, target="r.json", verify=of_r, oracle=solids.result, step=step_of_solids)
    turned = near + ["--tilt", "1", "--shift", "0.5"]
    yield placed("placement, solids", meshes, [start, turned + ["--gap", "0.05", "--min-allowance", "1"]],
                 inputs=stl + ["s.json"])
    about_z = near + ["--freedom", "c-xyz", "--window", "-1", "2", "--shift", "0.5", "--gap", "0.05"]
    yield placed("placement, solids, c-xyz", meshes, [start, about_z], inputs=stl)
    words = ["--nc", "p.nc", "--nc-out", "o.nc", "--offset", "siemens", "--offset-out", "lines.txt"]
    upright = climb + ["--freedom", "c-xyz", "-o", "s.json"]
    program = functools.partial(placed, files=meshes, commands=[upright, about_z + words], written={"p.nc": PROGRAM})
    yield program("placement, solids, program", inputs=["p.nc", "o.nc", "lines.txt"])
    yield program("program of solids, rewritten", target="o.nc", oracle=truth.rewritten, form="text",
                  report_of="r.json")
    yield program("work offset of solids", target="lines.txt", oracle=truth.offset_lines, form="text",
                  report_of="r.json")
    moved = [start, near + ["--freedom", "xyz", "--shift", "5", "--gap", "0.003", "--certificate", "c.json"]]
    yield placed("placement, solids, xyz", meshes, moved, inputs=stl + ["c.json"])
    yield placed("placement, solids, proof in a file", meshes, moved, target="c.json", oracle=solids.certificate,
                 report_of="r.json")
    none = climb[:5] + ["--freedom", "xyz", "--shift", "0.3", "-o", "r.json"]
    yield placed("placement, solids, none", meshes, [none], inputs=stl)
    yield placed("placement, solids, climb", meshes, [climb + ["--min-allowance", "2", "-o", "r.json"]], inputs=stl,
                 base=1, unproved=True)
    measured = ["--uncertainty", "0.01", "--max-dip", "0.05"]
    yield placed("placement, solids, a scan", meshes, [climb + measured + ["-o", "r.json"]], inputs=stl, base=1,
                 unproved=True)
    yield placed("placement, solids, points", [], [
        ["locate", "--part", "part.obj", "--blank", "scan.xyz", "--mesh", "mesh.ply", "--method", "climb",
         "--uncertainty", "0.01", "--min-radius", "6", "--underside", "z=0", "--flat", "0.2", "--drop-outliers", "4", "-o",
         "r.json"]], written={"part.obj": box((2, 2, 2), (18, 14, 9)), "scan.xyz": measured_box(20, 16, 12) + "10 8 5\n"},
        inputs=["part.obj", "scan.xyz", "mesh.ply"], base=1, unproved=True)
    touched = {"part.obj": box((2, 2, 2), (18, 14, 9)), "rough.obj": box((0, 0, 0), (20, 16, 12)),
               "touches.xyz": touched_box(20, 16, 12) + "10 8 15\n"}
    yield placed("placement, solids, touches", [], [
        ["locate", "--part", "part.obj", "--blank", "touches.xyz", "--nominal-blank", "rough.obj", "--mesh", "mesh.ply",
         "--form", "0.1", "--ball", "2", "--uncertainty", "0.01", "--drop-outliers", "0.5", "--nominal-window", "0.3",
         "0.3", "--method", "climb", "-o", "r.json"]], written=touched, inputs=list(touched) + ["mesh.ply"], base=1,
        unproved=True)
    along = dict(touched, **{"touches.xyz": touched_box(20, 16, 12, True)})
    yield placed("placement, solids, touches with directions", [], [
        ["locate", "--part", "part.obj", "--blank", "touches.xyz", "--nominal-blank", "rough.obj", "--mesh", "mesh.ply",
         "--form", "0.2", "--ball", "2", "--uncertainty", "0.01", "--nominal-window", "0.3", "0.3", "--method", "climb",
         "-o", "r.json"]], written=along, inputs=list(along) + ["mesh.ply"], base=1, unproved=True)
    boxes = {"part.obj": box((0, 0, 0), (1, 0.75, 0.5)),
             "blank.obj": box((-0.0625, -0.0625, -0.03125), (1.125, 0.875, 0.625))}
    inches = [["locate", "--part", "part.obj", "--blank", "blank.obj", "--units", "inch", "--shift", "1", "--tilt", "1",
               "--gap", "0.1", "-o", "r.json"]]
    yield placed("placement, solids, inches", [], inches, written=boxes, inputs=list(boxes))
    any_turn = inches[0][:7] + ["--freedom", "c-xyz", "--window", "-180", "180", "--find-start", "--gap", "0.1", "-o",
                                "r.json"]
    yield placed("placement, solids, all turns", [], [any_turn], written=boxes, inputs=list(boxes))
    asked = near + ["--shift", "0.5", "--tilt", "0.1", "--features", "datums.json", "--gap", "0.3"]
    demanded = functools.partial(placed, files=meshes + ["examples/solid/datums.json"], commands=[start, asked])
    yield demanded("placement, solids, demands", inputs=stl + ["datums.json"])
    yield demanded("features of solids", target="datums.json", oracle=solids.features, report_of="r.json")
    deep = {"part.obj": box((2, 2, 2), (18, 14, 9)), "blank.obj": box((0, 0, 0), (20, 16, 12)), "f.json": MAXIMA}
    shallow = functools.partial(placed, files=[], written=deep, commands=[
        ["locate", "--part", "part.obj", "--blank", "blank.obj", "--freedom", "c-xyz", "--window", "-1", "1", "--shift", "2",
         "--features", "f.json", "--gap", "0.05", "-o", "r.json"]])
    yield shallow("placement, solids, maxima", inputs=list(deep))
    yield shallow("maxima of solids", target="f.json", oracle=solids.features, report_of="r.json")
    smooth = functools.partial(placed, files=[], written=dict(deep, **{"f.json": FINISHED}), commands=[
        ["locate", "--part", "part.obj", "--blank", "blank.obj", "--freedom", "xyz", "--shift", "4", "--features", "f.json",
         "--gap", "0.05", "-o", "r.json"]])
    yield smooth("placement, solids, finished", inputs=list(deep))
    yield smooth("finished faces of solids", target="f.json", oracle=solids.features, report_of="r.json")
    evened = ["--criterion", "largest", "--give-up", "0.2"]
    whole = ["locate", "--part", "part.obj", "--blank", "blank.obj", "--freedom", "xyz", "--shift", "2", "--gap", "0.1", "-o",
             "r.json"]
    yield placed("placement, solids, largest", [], [whole + evened], inputs=["part.obj", "blank.obj"], written={
        "part.obj": box((2, 2, 2), (18, 14, 9)), "blank.obj": box((0, 0, 0), (20, 16, 13))})
    aimed = functools.partial(
        placed, files=[], inputs=["part.obj", "blank.obj", "f.json"],
        commands=[whole + ["--features", "f.json", "--criterion", "even", "--give-up", "0.3"]],
        written={"part.obj": box((2, 2, 2), (18, 14, 9)), "blank.obj": box((0, 0, 0), (20, 16, 13)), "f.json": TARGETS})
    yield aimed("placement, solids, even")
    yield aimed("targets of solids", target="f.json", oracle=solids.features, report_of="r.json")
    yield smooth("placement, solids, finished, largest", commands=[smooth.keywords["commands"][0] + evened])
    for role, file in (("part", "part.stl"), ("blank", "casting.stl")):
        yield Kind(f"placement, solids, another {role}", meshes, [start, turned + ["--gap", "0.1"]], file, of_r,
                   solids.mesh(role), form="stl", report_of="r.json")
        yield Kind(f"placement, solids, another {role} in inches", [], inches, f"{role}.obj", of_r, solids.mesh(role),
                   written=boxes, form="text", report_of="r.json")


def of_layouts():
    frames = ["examples/orders/frames.json"]
    nest = ["nest", "frames.json", "--work", "3000", "--threads", "1", "-o", "nested.json", "--json", ">report.json"]
    step = lambda value, way, _: value + way * 2 ** -20
    against = ["--layout", "nested.json"]
    yield Kind("layout", frames, [nest], "nested.json", ["verify", "nested.json", "--layout", "frames.json"],
               layouts.kept, step=step)
    order = ["--order", "o.csv", "--sheet", "60x50@steel:2", "--sheet", "40x40=2@birch:9"]
    made = {"o.csv": ORDER, "a.svg": SQUARE, "b.svg": SQUARE.replace("30", "20")}
    steel = ["nest", "job-steel-2.json", "--work", "1000", "-o", "nested.json"]
    yield Kind("layout, of an order", [], [["new", "-o", "job.json"] + order, steel], "nested.json",
               ["verify", "nested.json", "--layout", "job-steel-2.json"], layouts.kept, step=step, written=made)
    lettered = ["nest", "job.json", "--work", "1000", "-o", "nested.json"]
    yield Kind("layout, with marks and texts", [],
               [["new", "--part", "t.dxf", "--units", "mm", "--sheet", "60x50", "--gap", "1", "-o", "job.json"], lettered], "nested.json",
               ["verify", "nested.json", "--layout", "job.json"], layouts.kept, step=step, written={"t.dxf": LETTERED})
    yield Kind("report of an order", [], [["nest", "-o", "out.json", "--work", "1000", "--json", ">r.json"] + order],
               "r.json", ["verify", "r.json"], lambda context: lambda change: None, base=1, written=made,
               inputs=["a.svg", "b.svg", "out-steel-2.json", "out-birch-9.json"])
    # The seconds are never rechecked, so that what is confirmed is incomplete.
    quoted = dict(made, **{"rates.json": json.dumps(RATES)})
    nested = ["nest", "-o", "out.json", "--work", "1000", "--gap", "1", "--json", ">r.json"] + order
    for more in ([], ["--gcode", "cut.nc"]):
        quote = ["quote", "r.json", "--rates", "rates.json", "--kerf", "0.2", "--feed", "3000", "--pierce", "0.2", "--json",
                 ">q.json"]
        yield Kind("quote, with programs" if more else "quote", [], [nested, quote + more], "q.json", ["verify", "q.json"],
                   lambda context: lambda change: None, base=1, written=quoted,
                   inputs=["rates.json", "out-steel-2.json"] + ["cut-1.nc", "cut-2.nc"] * bool(more))
    yield Kind("report of nest", frames, [nest], "report.json", ["verify", "report.json"], truth.nest_report,
               inputs=["frames.json", "nested.json"])
    yield Kind("report of check", frames, [nest, ["check", "nested.json", "--json", ">c.json"]], "c.json",
               ["verify", "c.json"], truth.check_report, inputs=["nested.json"])
    yield Kind("report of check, rules broken", frames,
               [nest, truth.push_one, ["check", "nested.json", "--json", ">c.json"]], "c.json", ["verify", "c.json"],
               truth.check_report, inputs=["nested.json"], base=1)
    yield Kind("report of show", frames, [nest, ["show", "nested.json", "--json", ">s.json"]], "s.json",
               ["verify", "s.json"], truth.check_report, inputs=["nested.json"], base=1)
    for words in (["--process", "laser", "--pierce", "0.3"], ["--process", "router", "--depth", "4", "--pass", "3",
                                                              "--plunge", "200", "--speed", "9000"]):
        cut = [nest, ["export", "nested.json", "--format", "gcode", "--kerf", "0.3", "--feed", "2000", "--lead-in",
                      "2", "--sheet", SHEET, "-o", "cut.nc"] + words]
        of_cut = ["verify", "cut.nc", "--kerf", "0.3", "--sheet", SHEET] + against
        yield Kind("program, profile, " + words[1], frames, cut, "cut.nc", of_cut, truth.profile, form="text",
                   decimals=1)
    # A step is told where the program may not be off by as much.
    yield Kind("program, profile, another layout", frames, cut, "nested.json", of_cut, layouts.program,
               step=lambda value, way, _: value + way * 2 ** -5)
    for form, within, step in (("dxf", 2e-6, 2 ** -18), ("svg", 2e-6, 2 ** -18), ("hpgl", 0.04, 2 ** -3)):
        sheet = ["--sheet", SHEET] if form == "hpgl" else []
        drawn = [nest, ["export", "nested.json", "--format", form, "-o", "out"] + sheet]
        of_drawn = ["verify", "out"] + against + sheet
        yield Kind("export, " + form.upper(), frames, drawn, "out", of_drawn, truth.export(form), form="text",
                   decimals=5)
        yield Kind(f"export, {form.upper()}, another layout", frames, drawn, "nested.json", of_drawn,
                   layouts.export(within, ("steel 2 mm", 0) if sheet else None),
                   step=lambda value, way, _, step=step: value + way * step)


def entity(kind, layer, *numbers, colour=None):
    """An entity of a DXF: its numbers are those of the codes 10, 20, 40 and so on that the kind has."""
    codes = {"LINE": (10, 20, 11, 21), "CIRCLE": (10, 20, 40), "ARC": (10, 20, 40, 50, 51), "TEXT": (10, 20, 40)}[kind]
    groups = [(0, kind), (8, layer)] + [(62, colour)] * (colour is not None) + list(zip(codes, numbers))
    groups += [(1, text) for text in numbers[len(codes):]]
    return "".join(f"{code}\n{value}\n" for code, value in groups)


def plate_with_marks():
    """A plate with a window that holds another part, lines and letters to engrave in colours of their own, a bend."""
    sides = [(x, y) for x0, y0, x1, y1 in ((0, 0, 60, 40), (30, 10, 54, 34))
             for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]
    rings = [entity("LINE", "CUT", *a, *b) for k in (0, 4) for a, b in zip(sides[k:k + 4], sides[k + 1:k + 4] + sides[k:k + 1])]
    marks = [entity("LINE", "ENG", 4, 4, 20, 4, colour=5), entity("LINE", "MARKS", 4, 24, 20, 36),
             entity("LINE", "BEND", 0, 8, 60, 8, colour=3), entity("CIRCLE", "ENG", 10, 30, 3),
             entity("ARC", "MARKS", 15, 22, 4, 10, 140), entity("TEXT", "ENG", 4, 12, 5, "N 7", colour=1),
             entity("TEXT", "MARKS", 4, 18, 3, "ab")]
    return ("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" +
            "".join(rings + marks) + "0\nENDSEC\n0\nEOF\n")


MARKED = {"plate.dxf": plate_with_marks(), "small.svg": SMALL, "layers.json": json.dumps(LAYERS)}
MARKED_NEST = [["new", "--part", "plate.dxf=2", "--part", "small.svg=2", "--sheet", "140x60=1", "--gap", "4",
                "--layer-rules", "layers.json", "-o", "job.json"], ["nest", "job.json", "--work", "1000", "-o", "nested.json"]]
# Of nine squares the kerfs run into each other, so that the eight around the middle free it.
NINE = {"s.svg": SMALL.replace("14", "10")}
NINE_NEST = [["new", "--part", "s.svg=9", "--sheet", "36x36=1", "--gap", "1", "-o", "job.json"],
             ["nest", "job.json", "--work", "1000", "-o", "nested.json"]]

ROWS_NEST = [["nest", "--part", "s.svg=4", "--sheet", "60x24", "--kerf", "0.8", "--gap", "3", "--border", "4", "--rotations",
              "0,90", "--common-line", "--work", "20000", "-o", "nested.json"]]


def of_cuts():
    """Programs with pierces, joints, tabs and marks."""
    laser = ["--process", "laser", "--lead-in", "3"]
    router = ["--process", "router", "--depth", "4", "--pass", "2", "--plunge", "200", "--speed", "9000"]
    joints = ["--joints", "2", "--joint-width", "0.8"]
    tipping = ["--joints", "tipping", "--joint-width", "0.5", "--slat-pitch", "30"]
    beam = ["--engrave-feed", "4000", "--engrave-speed", "300", "--speed", "900"]
    tool = ["--engrave-feed", "1000", "--engrave-depth", "0.3", "--tool", "2", "--engrave-tool", "7"]
    disc = ["--pierce-diameter", "2"]
    for name, kerf, words, stated in (
            ("pierces", 0.3, laser + disc, {"pierce": 2}),
            ("joints", 0.3, laser + disc + joints, {"pierce": 2, "joint": 0.8}),
            ("joints, tipping", 0.5, laser + tipping + ["--unit", "inch", "--lead", "arc"], {"joint": 0.5}),
            ("tabs", 2, router + joints + ["--tab-height", "1"], {"joint": 0.8}),
            ("engraved", 0.3, laser + beam + disc, {"pierce": 2}),
            ("engraved by a router", 2, router + tool, {})):
        asked = [word for option, value in (("--pierce-diameter", stated.get("pierce")),
                                            ("--joint-width", stated.get("joint"))) if value
                 for word in (option, str(value))]
        cut = ["export", "nested.json", "--format", "gcode", "--kerf", str(kerf), "--feed", "2000", "-o", "cut.nc"]
        yield Kind("program, profile with " + name, [], MARKED_NEST + [cut + words], "cut.nc",
                   ["verify", "cut.nc", "--kerf", str(kerf), "--layout", "nested.json"] + asked,
                   cuts.program("140x60", kerf, **stated), form="program", decimals=1, written=MARKED)
    nine = ["export", "nested.json", "--format", "gcode", "--kerf", "0.8", "--feed", "2000", "-o", "cut.nc"]
    yield Kind("program, profile, kerfs that meet", [], NINE_NEST + [nine + ["--process", "laser"]], "cut.nc",
               ["verify", "cut.nc", "--kerf", "0.8", "--layout", "nested.json"],
               cuts.program("36x36", 0.8, heaps=True), form="program", decimals=1, written=NINE)
    shared = ["export", "nested.json", "--format", "gcode", "--kerf", "0.8", "--feed", "2000", "--common-line", "-o", "cut.nc"]
    yield Kind("program, profile with common lines", [], ROWS_NEST + [shared + ["--process", "laser"]],
               "cut.nc", ["verify", "cut.nc", "--kerf", "0.8", "--layout", "nested.json", "--common-line"],
               common.program("60x24", 0.8), form="program", decimals=1, written={"s.svg": SMALL})


def of_drawn():
    """Exports of layouts with lines and texts on their parts, in colours and on layers of their own."""
    for form in ("dxf", "svg", "hpgl"):
        yield Kind(f"export with marks, {form.upper()}", [], MARKED_NEST + [["export", "nested.json", "--format", form, "-o", "out"]],
                   "out", ["verify", "out", "--layout", "nested.json"], drawn.export(form), form=form, decimals=5,
                   written=MARKED)
    # The marks and labels of such a plot are those of others.
    pair = [["new", "--part", "s.svg=2", "--sheet", "30x20=1", "--gap", "2", "-o", "job.json"],
            ["nest", "job.json", "--work", "1000", "-o", "nested.json"]]
    for process, words, known in (("drag-knife", ["--blade-offset", "0.5"], drawn.knife(0.5)),
                                  ("tangential-knife", ["--turn-above", "20"], drawn.knife())):
        plot = ["export", "nested.json", "--format", "hpgl", "--process", process, "-o", "out"]
        yield Kind(f"plot, {process}", [], pair + [plot + words], "out", ["verify", "out", "--layout", "nested.json"] + words,
                   known, form="hpgl", written=NINE)


def of_stocks():
    """Two sheets and one of another material: an order that was cut, with its remnant, one that is allocated on it, and one
    that was cancelled."""
    nest = ["--stock", "shop", "--rotations", "0", "--gap", "3", "--kerf", "1", "--work", "1000"]
    order = lambda part, name: ["nest", "--part", part + "@steel:2", "--allocate", name, "-o", name + ".json"] + nest
    commands = [["stock", "add", "shop", "--sheet", "200x100=2@steel:2", "--sheet", "90x60@birch:9", "--cost", "7",
                 "--remnant-min", "50x30"],
                order("a.svg=3", "A1"), ["stock", "cut", "shop", "A1"], order("b.svg=2", "A2"), order("b.svg", "A3"),
                ["stock", "cancel", "shop", "A3"], ["stock", "list", "shop", "--json", ">s.json"]]
    yield Kind("stock", [], commands, "s.json", ["verify", "s.json"], stocks.oracle,
               step=lambda value, way, _: value + way * 2 ** -20,
               written={"a.svg": SQUARE, "b.svg": SQUARE.replace("30", "20")})


def of_pockets():
    cut = ["--tool", "10", "--depth", "2", "-o", "p.ngc", "--json", ">r.json"]
    made = {"pocket.json": json.dumps(POCKET)}
    plain = ["pocket", "pocket.json"] + cut
    of_r = ["verify", "r.json"]
    yield Kind("report of pocket", [], [plain], "r.json", of_r, truth.pocket_report, written=made,
               inputs=["pocket.json", "p.ngc"])
    yield Kind("report of pocket, after another tool", ["tests/corpus/pockets/L.json"],
               [["pocket", "L.json", "--tool", "20", "--depth", "2", "-o", "rough.ngc"],
                ["pocket", "L.json", "--tool", "8", "--depth", "2", "--after", "rough.ngc:20", "-o", "p.ngc", "--json",
                 ">r.json"]], "r.json", of_r, truth.pocket_report, inputs=["L.json", "p.ngc", "rough.ngc"])
    yield Kind("report of pocket, from a tree", [], [["pocket", "tree.json"] + cut], "r.json", of_r,
               truth.pocket_report, written={"tree.json": json.dumps(TREE)}, inputs=["tree.json"])
    yield Kind("report of pocket, from a drawing", [],
               [["pocket", "p.svg", "--island-layer", "ISLAND", "--open-layer", "OPEN"] + cut], "r.json", of_r,
               truth.pocket_report, written={"p.svg": PLATE}, inputs=["p.svg"])
    yield Kind("report of pocket, another tree", [], [["pocket", "tree.json"] + cut], "tree.json", of_r,
               truth.tree_input, written={"tree.json": json.dumps(TREE)}, report_of="r.json")
    yield Kind("report of simulate", [], [plain, ["simulate", "p.ngc", "--pocket", "pocket.json", "--tool", "10",
                                                  "--json", ">s.json"]], "s.json", ["verify", "s.json"],
               truth.pocket_report, written=made, inputs=["pocket.json", "p.ngc"])
    yield Kind("program, pocket, in its report", [], [plain], "p.ngc", of_r, truth.pocket_program, written=made,
               form="text", report_of="r.json")


def of_fits():
    """What finite elements say is never confirmed, so that verify gives 1 and no change needs an excuse."""
    sizes = ["--hub-outer", "36", "--length", "18", "--material", "C45", "--bore", "6", "-o", "r.json"]
    yield Kind("result of fit", [], [["fit", "--fit", "18H8/z8", "--friction", "0.08,0.12", "--clearance", "18"] + sizes],
               "r.json", ["verify", "r.json"], lambda context: lambda change: None, base=1)
    for surface in ("outside", "seat"):
        turned = ["fit", "--diameter", "18", "--interference", "0.04", "--cylindrical", surface, "--profile", "p.csv", "--drawing",
                  "p.dxf", "--program", "p.ngc"] + sizes + ["--from-end", "4"] * (surface == "seat")
        yield Kind("result of fit, turned" + ", seat" * (surface == "seat"), [], [turned], "r.json", ["verify", "r.json"],
                   lambda context: lambda change: None, base=1, inputs=["p.csv", "p.dxf", "p.ngc"])


def of_heat():
    """What voxels say is never confirmed, either."""
    program = "G21 G90 G17 G94 G54\nG0 X5 Y5 Z5\nG1 Z-2 F200\nG1 X35 F600\nG1 Y19\nG1 X5\nG1 Y5\nG1 Y12\nG1 X35\nG0 Z5\nM2\n"
    yield Kind("result of heat", [],
               [["heat", "p.ngc", "--pocket", "pocket.json", "--stock", "60x44x8", "--tool", "10", "--teeth", "3", "--spindle", "6000",
                 "--material", "C45", "--share", "0.05..0.2", "--voxel", "8", "--measured", "23,20,12,-6,8,8", "-o",
                 "r.json"]], "r.json", ["verify", "r.json"],
               lambda context: lambda change: None, base=1, inputs=["p.ngc", "pocket.json"],
               written={"p.ngc": program, "pocket.json": json.dumps(POCKET)})
    sides = ((0, 0), (40, 0), (40, 30), (0, 30), (0, 0))
    pocket = {"units": "mm", "outer": [{"line": {"from": a, "to": b}} for a, b in zip(sides, sides[1:])]}
    yield Kind("result of heat, corrected", [],
               [["pocket", "pocket.json", "--tool", "6", "--depth", "4", "--stepdown", "2", "-o", "p.ngc"],
                ["heat", "p.ngc", "--pocket", "pocket.json", "--stock", "60x50x12", "--tool", "6", "--teeth", "3", "--spindle", "8000",
                 "--material", "6061-T6", "--share", "0.3", "--cutting-force", "700", "--force-exponent", "0.25", "--cooling", "20",
                 "--voxel", "3", "--corrected", "c.ngc", "-o", "r.json"]], "r.json", ["verify", "r.json"],
               lambda context: lambda change: None, base=1, inputs=["p.ngc", "pocket.json", "c.ngc"],
               written={"pocket.json": json.dumps(pocket)})
