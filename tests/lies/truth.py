"""Decides which changes leave every claim true, by computing of its own.

An oracle gets the files of a kind as they were made, and gives a function of a change: "information" where it is of
a field without influence (docs/formats.md, "What verify does with each field"), True where all that is claimed is
true after it, else None.
"""

import csv
import io
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))

import changes
import exact
import nc_reader
import profile as profile_of
import shapes
from exact import D, number


class Context:
    """What an oracle may look at: the folder as it was made, the kind, and the file before the change."""

    def __init__(self, folder, kind, text):
        self.kind, self.text = kind, text
        self.lekalo = folder.lekalo
        self.files = {path.name: folder.read(path.name) for path in folder.path.iterdir() if path.is_file()}

    def json(self, name):
        return json.loads(self.files[name])

    def runs(self, text, words):
        """Another command takes the changed file with exit status 0."""
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write(text)
            file.flush()
            return subprocess.run([self.lekalo] + words + [file.name], capture_output=True).returncode == 0


def matches(rules, path):
    return any(re.match(rule, path) for rule in rules)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def same_form(a, b):
    """Two documents differ in numbers alone."""
    if isinstance(a, dict):
        return isinstance(b, dict) and a.keys() == b.keys() and all(same_form(a[k], b[k]) for k in a)
    if isinstance(a, list):
        return isinstance(b, list) and len(a) == len(b) and all(map(same_form, a, b))
    return is_number(a) and is_number(b) or a == b


# Items of lists that each say something for themselves: what is left says less.
MAY_GO = r"/(contacts|alternatives|certificate|intervals)/\d+$|/certificate/trees/\d+/nodes/\d+/contacts/\d+$"


def same_shape(text, region):
    """A file is a region in mm, and has the edges of this one, in whatever order and direction."""
    def edges(document):
        made = []
        for edge in shapes.edges_of(document):
            ways = [(edge.a, edge.b, edge.arc and edge.ccw), (edge.b, edge.a, edge.arc and not edge.ccw)]
            made.append((min(ways)[:2] if edge.full else min(ways), edge.arc and edge.c))
        return sorted(made, key=str)
    file = json.loads(text) if text.lstrip().startswith("{") else {}
    return ("outer" in file or "pieces" in file) and file.get("units", "mm") == "mm" and edges(file) == edges(region)


def may_hold(change, before, after, may_go=MAY_GO):
    """Only numbers are others, or the order of a list, or the sense of an arc, or an item is gone of which more are
    left: the rest of an oracle decides by computing."""
    return same_form(before, after) or change.path.endswith(("/ccw", "/scan/proved")) or change.path == "/scan/max_dip" or \
        change.how.startswith(("exchanged", "turned")) or \
        change.how == "deleted" and bool(re.match(may_go, change.path))


def document_of(change):
    """The document after a change, where no member is there twice. What lekalo 0.1 wrote has no drawings and names no
    control, and means that there are none and LinuxCNC's words."""
    if change.how == "given twice":
        return None
    document = json.loads(change.text())
    if isinstance(document, dict) and "regions" in document and "tolerances" in document:
        document.setdefault("drawings", {"part": None, "blank": None})
    if isinstance(document, dict) and isinstance(document.get("nc"), dict):
        document["nc"].setdefault("control", "linuxcnc")
    return document


def push_one(folder):
    """A placement pushed into its neighbours."""
    layout = json.loads(folder.read("nested.json"))
    layout["placements"][0]["x"] += 3
    folder.write("nested.json", json.dumps(layout))


# Placements. ---------------------------------------------------------------------------------------------------

OF_PLACEMENTS = [
    r"/(seed|work|version|method|run|warnings|alternatives_complete)(/.*)?$", r"/inputs/\d+/path$",
    r"/nc/(motions|scan_frame|notes)(/.*)?$", r"/nc/output/path$", r"/certificate_file/path$", r"/deviations/path$",
    r"/demands/deviation$", r"/demands/trade_off/\d+/(largest_bound)$",
    r"/scan/(median_spacing|widest|deepest|assumptions|unknown|dropped)(/.*)?$",
]


def derived(document):
    """The fields that follow from others: gap, shortfall, degrees, the program's clearance, the window."""
    clearance, least = number(document["clearance"]), number(document["min_allowance"])
    if document["upper_bound"] is not None:
        bound = number(document["upper_bound"])
        if bound < clearance or not exact.near(document["gap"], bound - clearance, "1e-15", [bound, clearance]):
            return False
        if (bound < least) != (document["status"] == "infeasible"):
            return False
        missing = max(D(0), least - clearance)
        if not exact.near(document["shortfall"], missing, "1e-15" if missing else 0, [least, clearance]):
            return False
    nc = document.get("nc")
    if nc and (number(nc["rounding_mm"]) < 0 or
               number(nc["clearance"]) > clearance - number(nc["rounding_mm"]) + D("1e-15") * abs(clearance)):
        return False
    return pose_is_allowed(document, document)


def pose_is_allowed(document, pose):
    degrees = number(pose["theta"]) * 180 / exact.PI
    if abs(number(pose["theta_deg"]) - degrees) > D("1e-14") * abs(degrees):
        return False
    low, high = map(number, document["window_deg"])
    slack = D("1e-14") * max(abs(low), abs(high), 1)
    return low <= high and (high - low >= 360 or low - slack <= degrees <= high + slack)


def pose_of(placement):
    return placement["x"], placement["y"], placement["theta"]


def convex_holds(document, files, certificate):
    """All that a placement of convex contours claims."""
    inputs = {entry["role"]: entry for entry in document["inputs"]}
    part, blank = (exact.points_of(files[inputs[role]["path"]]) for role in ("part", "blank"))
    for role, points in (("part", part), ("blank", blank)):
        if inputs[role]["points"] != len(points) or inputs[role]["dropped"]:
            return False
    whole = blank
    if document["trim"]:
        blank = [(number(x), number(y)) for x, y in document["trim"]["contour"]]
        if not trim_holds(document["trim"], blank, whole):
            return False
    if not derived(document):
        return False
    for placement in [document] + document["alternatives"]:
        if not pose_is_allowed(document, placement):
            return False
        if number(placement["clearance"]) > exact.convex_clearance(part, blank, pose_of(placement)):
            return False
    if not exact.certificate_proves(certificate, part, blank, document["window_deg"], document["upper_bound"]):
        return False
    sides = exact.edges(blank)
    there = exact.placed(part, *pose_of(document))
    slack = D("1e-6") * sum(max(p[k] for p in blank) - min(p[k] for p in blank) for k in (0, 1))
    for contact in document["contacts"]:
        k, v = contact["blank_edge"], contact["part_vertex"]
        if not (0 <= k < len(sides) and 0 <= v < len(part)):
            return False
        (a, n), p = sides[k], there[v]
        if n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1]) > number(document["clearance"]) + slack:
            return False
    if not contacts_balance(document["contacts"], sides):
        return False
    return (comparison_holds(document, part, blank, files) and deviations_hold(document, part, whole) and
            moved_holds(document, files))


def contacts_balance(contacts, sides):
    """The multipliers are not negative, make 1 together, and balance the normals within 1e-6."""
    shares = [number(contact["multiplier"]) for contact in contacts]
    sums = [sum(m * sides[contact["blank_edge"]][1][k] for m, contact in zip(shares, contacts)) for k in (0, 1)]
    return not contacts or min(shares) >= 0 and max(map(abs, sums + [sum(shares) - 1])) <= D("1e-6")


def trim_holds(trim, contour, whole):
    """The contour is convex, no side of it cuts or leaves the untrimmed one, and the loss is within what was allowed."""
    # Its corners are doubles, so it is convex but for their last places.
    if number(trim["loss"]) > number(trim["tolerance"]) or not exact.is_convex(contour, last_place(contour)):
        return False
    # A point of the contour is inside where its rays cross an odd number of sides, or it lies on one.
    return all(exact.is_in(p, whole, D("1e-11")) for p in contour)


def last_place(points):
    """The last place of doubles as large as the largest coordinate, twice."""
    return D("4.5e-16") * max(max(map(abs, p)) for p in points)


def comparison_holds(document, part, blank, files):
    said = document["comparison"]
    if said is None:
        return True
    last = json.loads(files["first.json"])
    if number(said["last_clearance"]) != number(last["clearance"]) or said["same_part"] is not True:
        return False
    for name, key in (("dx", "x"), ("dy", "y")):
        if not exact.near(said[name], number(document[key]) - number(last[key]), "1e-15",
                          [number(document[key]), number(last[key])]):
            return False
    turned = number(document["theta"]) - number(last["theta"])
    turned -= (turned / (2 * exact.PI)).to_integral_value() * 2 * exact.PI
    if abs(number(said["dtheta"]) - turned) > D("2e-14"):
        return False
    if abs(number(said["dtheta_deg"]) - number(said["dtheta"]) * 180 / exact.PI) > D("1e-14") * abs(turned) * 58:
        return False
    now, then = (exact.placed(part, *pose_of(one)) for one in (document, last))
    moved = max(((a - c) ** 2 + (b - d) ** 2).sqrt() for (a, b), (c, d) in zip(now, then))
    if number(said["largest_shift"]) < moved - D("1e-12"):
        return False
    return number(said["last_pose_clearance"]) <= exact.convex_clearance(part, blank, pose_of(last))


def deviations_of(document, part, blank):
    """The distances of the blank's points from the placed part, positive outside."""
    there = exact.placed(part, *pose_of(document))
    found = []
    for p in blank:
        off = min(exact.to_segment(p, a, b) for a, b in zip(there, there[1:] + there[:1]))
        found.append(-off if exact.is_in(p, there, D(0)) else off)
    return found


def deviations_hold(document, part, blank):
    said = document["deviations"]
    if said is None:
        return True
    found = deviations_of(document, part, blank)
    slack = D("2e-12") * max(max(map(abs, p)) for p in blank)
    return (said["points"] == len(found) and abs(number(said["least"]) - min(found)) <= slack and
            abs(number(said["greatest"]) - max(found)) <= slack)


def deviations(context):
    document = context.json("r.json")
    part, blank = (exact.points_of(context.files[f"example-1-{role}.csv"]) for role in ("part", "blank"))
    found = deviations_of(document, part, blank)
    slack = D("2e-12") * max(max(map(abs, p)) for p in blank)

    def holds(change):
        rows = list(csv.reader(io.StringIO(change.text())))
        if rows[0] != ["index", "x", "y", "deviation"] or len(rows) != len(blank) + 1:
            return None
        return all(len(row) == 4 and int(row[0]) == k and (D(row[1]), D(row[2])) == blank[k] and
                   abs(D(row[3]) - found[k]) <= slack for k, row in enumerate(rows[1:])) or None
    return holds


def convex(context):
    before = json.loads(context.text)

    def holds(change):
        if matches(OF_PLACEMENTS, change.path):
            return "information"
        after = document_of(change)
        if after is None or not may_hold(change, before, after) or after["format"] != before["format"]:
            return None
        try:
            return convex_holds(after, context.files, after["certificate"]) or None
        except (KeyError, TypeError, IndexError):
            return None
    return holds


def convex_certificate(context):
    document = context.json("r.json")

    def holds(change):
        after = document_of(change)
        if after is None or not may_hold(change, json.loads(context.text), after) or after["format"]["version"] != 1:
            return None
        return convex_holds(document, context.files, after["intervals"]) or None
    return holds


def convex_input(role):
    def oracle(context):
        document = context.json("r.json")
        points = exact.points_of(context.text)

        def holds(change):
            files = dict(context.files, **{context.kind.target: change.text()})
            # Comments and the head of the table are for people.
            if exact.points_of(files[context.kind.target]) == points:
                return "information"
            if not exact.is_convex(exact.points_of(files[context.kind.target])):
                return None
            return convex_holds(document, files, document["certificate"]) or None
        return holds
    return oracle


def moved_holds(document, files):
    """A program is the original, moved by the pose, by the second reader of the tests: no place is off by more than the
    rounding that is claimed, and the rest that is said of it is what was said before."""
    nc, last = document["nc"], json.loads(files["r.json"])["nc"]
    if nc is None or last is None:
        return nc is last
    if any(nc[k] != last[k] for k in last if k not in ("rounding_mm", "clearance", "motions", "notes", "scan_frame")):
        return False
    original, written = (files[next(one["path"] for one in list_ if one.get("role", "") == role)] for list_, role in
                         ((document["inputs"], "nc"), ([nc["output"]], "")))
    return not nc_reader.differences(original, written, nc["control"], pose_of(document), nc["rounding_mm"],
                                     mode=nc["mode"])


class Regions:
    """What a placement of regions claims, decided with the certificates that were looked at before kept."""

    def __init__(self, context):
        self.files, self.before = context.files, context.json("r.json")
        self.edges = self.edges_in(self.before)
        self.checked = {}
        certificate = self.before["certificate"]
        if isinstance(certificate, dict) and self.before["demands"] is None:
            for tree, cover in self.covers(self.before, self.edges):
                for contacts, box in cover.leaves(tree):
                    self.checked[self.key(contacts, box, tree, self.before)] = True

    @staticmethod
    def edges_in(document):
        return {role: shapes.edges_of(document["regions"][role]) for role in ("part", "blank")}

    @staticmethod
    def bound(document):
        return document["upper_bound"] - sum(document["tolerances"].values())

    def key(self, contacts, box, tree, document):
        same = document["regions"] is self.before["regions"] or document["regions"] == self.before["regions"]
        return json.dumps([contacts, box, tree["mirrored"], document["certificate"]["pivot"], same,
                           self.bound(document)])

    @staticmethod
    def covers(document, edges):
        cover = shapes.Cover(edges["part"], edges["blank"], document["certificate"]["pivot"])
        return [(tree, cover) for tree in document["certificate"]["trees"]]

    def certificate_holds(self, document, edges):
        certificate = document["certificate"]
        if not isinstance(certificate, dict):
            return certificate == self.before["certificate"] and \
                document["upper_bound"] >= self.before["upper_bound"]
        wanted = {"no": {False}, "yes": {True}, "either": {False, True}}[document["mirror"]]
        if not wanted <= {tree["mirrored"] for tree in certificate["trees"]}:
            return False
        for tree, cover in self.covers(document, edges):
            leaves = cover.leaves(tree)
            if leaves is None or not self.root_holds(document, edges, tree, "certificate", self.bound(document)):
                return False
            # A bound that is raised is proved by what proved the lower one.
            lower = dict(document, upper_bound=min(document["upper_bound"], self.before["upper_bound"]),
                         tolerances=self.before["tolerances"])
            for contacts, box in leaves:
                if self.key(contacts, box, tree, lower) not in self.checked and not cover.proves(
                        contacts, box, tree["mirrored"], self.bound(document)):
                    return False
        return True

    @staticmethod
    def root_holds(document, edges, tree, key, bound):
        """The root covers the window, and the box of the blank as much wider as the pivot may lie outside."""
        begin, end = (number(w) * exact.PI / 180 for w in document["window_deg"])
        low, high = map(number, tree["theta"])
        if end - begin < 2 * exact.PI - D("1e-40") and not (low <= begin and high >= end):
            return False
        if high - low < min(2 * exact.PI, end - begin):
            return False
        pivot = tuple(map(number, document[key]["pivot"]))
        more = max(D(0), -shapes.depth(pivot, edges["part"])) + max(D(0), -number(bound))
        points = [p for edge in edges["blank"] for p in edge.extremes()]
        locked = document["locked"] or {}
        for k, axis in enumerate("xy"):
            low, high = map(number, tree[axis])
            if locked.get(axis) is not None:
                if not low <= number(locked[axis]) <= high:
                    return False
            elif low > min(p[k] for p in points) - more or high < max(p[k] for p in points) + more:
                return False
        return True

    def regions_hold(self, document):
        """The regions used are those before, within the tolerances, and these were not lowered."""
        for role in ("part", "blank"):
            if document["tolerances"][role] < self.before["tolerances"][role] and \
                    document["tolerances"][role] < self.off_its_file(role):
                return False
            one, other = (list(changes.nodes(in_order(d["regions"][role]))) for d in (document, self.before))
            slack = max(self.before["tolerances"][role] / 2, self.rounding_of(role))
            for (path, a), (_, b) in zip(one, other):
                if is_number(a) and abs(a - b) > slack:
                    return False
                # A full circle runs either way.
                if isinstance(a, dict) and "ccw" in a and a["ccw"] != b["ccw"] and a["from"] != a["to"]:
                    return False
        return True

    def rounding_of(self, role):
        """Of drawings and trees each number goes through a scale, a turn, a shift and a flip or two, and through the
        place where two curves meet: each makes it another by a last place of the largest."""
        path = next(one["path"] for one in self.before["inputs"] if one["role"] == role)
        if path.endswith(".csv") or same_shape(self.files[path], self.before["regions"][role]):
            return 0
        return 2 ** -49 * max(abs(v) for _, v in changes.nodes(self.before["regions"][role]) if is_number(v))

    def off_its_file(self, role):
        """How far a region may be from what its file means: not at all where that has the very same numbers."""
        path = next(one["path"] for one in self.before["inputs"] if one["role"] == role)
        return 0 if same_shape(self.files[path], self.before["regions"][role]) else math.inf

    @staticmethod
    def contacts_hold(document, edges):
        motion = shapes.Motion(document["x"], document["y"], document["theta"], document["mirrored"])
        slack = D("1e-6") * max(1, *shapes.box_of(edges["blank"]))
        for contact in document["contacts"]:
            ends = []
            for role in ("part", "blank"):
                k, at = contact[role + "_edge"], tuple(map(number, contact[role + "_at"]))
                if not (isinstance(k, int) and 0 <= k < len(edges[role])) or \
                        shapes.to_edge(at, edges[role][k]) > slack:
                    return False
                ends.append(at)
            if abs(shapes.apart(motion(ends[0]), ends[1]) - number(contact["distance"])) > slack:
                return False
        return True

    def beside_bounds(self, document, edges):
        """All that is neither a bound nor derived from one."""
        if not self.regions_hold(document):
            return False
        if document["mirror"] not in ("either", "yes" if document["mirrored"] else "no"):
            return False
        for axis, value in (document["locked"] or {}).items():
            if value is not None and number(value) != number(document[axis]):
                return False
        if document["scan"] != self.before["scan"] and not scan_holds(document["scan"], self.before["scan"]):
            return False
        return (drawings_hold(document["drawings"], self.before["drawings"]) and
                self.contacts_hold(document, edges) and moved_holds(document, self.files))

    def holds(self, document):
        if not derived(document):
            return False
        edges = self.edges if document["regions"] == self.before["regions"] else self.edges_in(document)
        motion = shapes.Motion(document["x"], document["y"], document["theta"], document["mirrored"])
        apart = shapes.distance([edge.moved(motion) for edge in edges["part"]], edges["blank"])
        if number(document["clearance"]) > apart - sum(map(number, document["tolerances"].values())):
            return False
        return self.beside_bounds(document, edges) and self.certificate_holds(document, edges)


def scan_holds(after, before):
    """What is proved under some assumptions is under more: that nothing dips by more than so much, that no radius is
    smaller than a larger one. Beside a radius the step says only how far apart corners were chosen. And a blank may be
    proved of which it is not said."""
    def no_less(key):
        one, other = after[key], before[key]
        return one == other or key == "proved" and one is False or \
            key == "max_dip" and is_number(one) and one >= 0 and (other is None or one <= other) or \
            key == "min_radius" and is_number(one) and (other is not None and one >= other) or \
            key == "step" and before["min_radius"] is not None and one >= other or \
            key in ("median_spacing", "widest", "deepest", "assumptions", "unknown", "dropped")
    return after.keys() == before.keys() and all(map(no_less, before))


def drawings_hold(after, before):
    """Curves that were set aside are no longer than the join tolerance, so a larger one says less."""
    for role in ("part", "blank"):
        one, other = after[role], before[role]
        if one is None or other is None:
            if one != other:
                return False
        elif one["layers"] != other["layers"] or one["set_aside"] != other["set_aside"]:
            return False
        elif number(one["join"]) < (number(other["join"]) if other["set_aside"] else 0):
            return False
        elif number(one.get("loose_error", 0)) < number(other.get("loose_error", 0)):
            return False
        elif not lines_hold(one.get("marks", []), other.get("marks", [])):
            return False
    return True


def lines_hold(after, before):
    """Lines that enclose nothing are where they were, but for rounding, in any direction and order."""
    def ends(edges):
        return [[sorted([e["line"]["from"], e["line"]["to"]])] for e in edges]
    one, other = ends(after), ends(before)
    return len(one) == len(other) and all(
        abs(number(a) - number(b)) <= 1e-12 for x, y in zip(sorted(one), sorted(other)) for p, q in zip(x[0], y[0])
        for a, b in zip(p, q))


def regions(context):
    truth = Regions(context)

    def holds(change):
        if matches(OF_PLACEMENTS + [r"/contacts/\d+/multiplier$"], change.path):
            return "information"
        after = document_of(change)
        if after is None or not may_hold(change, truth.before, after):
            return None
        try:
            return truth.holds(after) or None
        except (KeyError, TypeError, ValueError, IndexError):
            return None
    return holds


def region_input(role):
    """Another part or blank: the region that was used is what it says, within the tolerance of the result."""
    def oracle(context):
        before = json.loads(context.text)
        slack = context.json("r.json")["tolerances"][role] / 2

        def holds(change):
            after = document_of(change)
            if after is None:
                return None
            # Single values beside the outline are for people.
            if change.path in ("/name", "/source", "/not_known"):
                return "information"
            if says_mm(change):
                return True
            one, other = map(list, map(changes.nodes, (before, after)))
            return [p for p, _ in one] == [p for p, _ in other] and all(
                a == b or (is_number(a) and is_number(b) and abs(a - b) <= slack) or
                p.endswith("/ccw") and circle(before, p) for (p, a), (_, b) in zip(one, other)
                if not isinstance(a, (dict, list))) or None
        return holds
    return oracle


def in_order(region):
    """A region with its pieces and holes in an order of their own."""
    def sorted_holes(piece):
        return dict(piece, holes=sorted(piece.get("holes", []), key=json.dumps))
    return dict(region, pieces=sorted(map(sorted_holes, region["pieces"]), key=json.dumps)) if "pieces" in region \
        else sorted_holes(region)


def says_mm(change):
    """A file that names no unit has the one that it was given with: its numbers are mm as before."""
    return change.path == "/units" and change.how == "deleted" and change.old == "mm"


def circle(document, path):
    arc = changes.at_path(document, path.rsplit("/", 1)[0])
    return arc["from"] == arc["to"]


NC_NUMBER = re.compile(r"([A-Z])(-?[\d.]+)")


def rewritten(context):
    """The words are the same, or one place of a motion has moved by less than what the rounding of its decimals leaves
    of the rounding that is claimed."""
    before, same_way = words_of_program(context.text), goes_as(context.text)
    document = context.json("r.json")
    room = document["nc"]["rounding_mm"] - 0.71e-5
    places = "XYZIJR" if "quaternion" in document else "XYIJ"

    def same(a, b):
        return a == b or (isinstance(a, tuple) and isinstance(b, tuple) and a[0] == b[0] and a[0] in places and
                          abs(a[1] - b[1]) <= room)

    def holds(change):
        after = words_of_program(change.text())
        # Comments are for people.
        if after == before:
            return "information"
        return len(before) == len(after) and all(
            len(one) == len(other) and all(map(same, one, other)) for one, other in zip(before, after)) or \
            same_way(change)
    return holds


def offset_lines(context):
    def words(text):
        return words_of_program("\n".join(line for line in text.splitlines() if not line.startswith((";", "("))))

    def holds(change):
        # Comments are for people, and so is the sign of a zero.
        return "information" if words(change.text()) == words(context.text) else None
    return holds


def features_input(context):
    return lambda change: says_mm(change) or None


def tree_input(context):
    """A number is another by its last place: far below what the report says its outlines are exact to. Names of
    primitives are for people where no edge is open, for these alone go by names; no name at all is one of them."""
    names_decide = context.json("r.json")["open_layers"]

    def holds(change):
        named = re.search(r"/name$", change.path) and isinstance(change.old, str)
        if named and not names_decide and change.how in ("text", "deleted"):
            return "information"
        return says_mm(change) or change.how.startswith("last place") and abs(float(change.old)) < 1e6 or None
    return holds


OF_REPORTS = [r"/(version|seed|work|run|warnings|checked_by|merges)(/.*)?$", r"/unplaced/\d+/reason$",
              r"/inputs/\d+/path$", r"/outputs/\d+/path$"]


def of_report(holds):
    """An oracle of a report whose claims are numbers that are compared as they are."""
    def oracle(context):
        before = json.loads(context.text)

        def answer(change):
            if matches(OF_REPORTS, change.path):
                return "information"
            after = document_of(change)
            return after is not None and holds(change, before, after) or None
        return answer
    return oracle


def nest_holds(change, before, after):
    """A density within 1e-12, and a smaller rectangle in what is free."""
    if change.path.endswith("/density"):
        return same_form(before, after) and abs(changes.at_path(after, change.path) - change.old) <= 1e-12
    found = re.match(r"(/stocks/\d+/remnant)(/|$)", change.path)
    if not found or not same_form(before, after):
        return False
    one, other = (changes.at_path(d, found[1]) for d in (before, after))
    return one[0] <= other[0] < other[2] <= one[2] and one[1] <= other[1] < other[3] <= one[3]


def longest_rapid(context, report):
    """The length of the longest rapid motion of the programs of a report."""
    found = [0.0]
    for one in report["inputs"] + report.get("outputs", []):
        for kind, *way in motions_of(context.files[one["path"]]) or [] if one["path"].endswith(".ngc") else ():
            if kind == "rapid" and None not in way[:4]:
                (start, z0, end, z1) = way[:4]
                found.append(math.dist((*start, z0), (*end, z1)))
    return max(found)


def pocket_holds(change, before, after, context):
    """A looser tolerance; the last place of an option is within the rounding of every figure made with it."""
    path = change.path
    if path == "/tolerance_mm":
        return is_number(after.get("tolerance_mm")) and after["tolerance_mm"] >= before["tolerance_mm"]
    if path == "/drawing/join":
        # Curves that were set aside are no longer than it, and the ends of the others meet within the tolerance.
        least = before["drawing"]["join"] if before["drawing"]["set_aside"] else 0
        return same_form(before, after) and after["drawing"]["join"] >= least
    if path == "/inputs" and change.how.startswith(("exchanged", "turned")):
        # Each input says its role.
        return len({one["role"] for one in before["inputs"]}) == len(before["inputs"])
    if path == "/rapid_mm_per_min" and same_form(before, after) and after["rapid_mm_per_min"] > 0:
        # No rapid is long enough to reach either speed.
        speed = min(after["rapid_mm_per_min"], before["rapid_mm_per_min"]) / 60
        return longest_rapid(context, before) < speed ** 2 / before["acceleration_mm_per_s2"]
    if path == "/regions/holes" and change.how == "deleted":
        return before["regions"]["holes"] == []
    if path.endswith("/ccw"):
        return circle(before, path)
    if change.how.startswith("last place"):
        return matches([r"/(tool_mm|stock_to_leave_mm|step_over|top_mm|acceleration_mm_per_s2|rapid_mm_per_min|depth_mm|"
                        r"floor_stock_mm)$", r"/regions/", r"/inputs/\d+/tool_mm$"], path)
    return False


nest_report = of_report(nest_holds)


def pocket_report(context):
    return of_report(lambda change, before, after: pocket_holds(change, before, after, context))(context)


check_report = of_report(lambda change, before, after: False)


def words_of_program(text):
    made = []
    for line in text.splitlines():
        words = re.sub(r"\([^)]*\)", "", line).split(";")[0].split()
        if words:
            made.append([(word[0], float(word[1:])) if NC_NUMBER.fullmatch(word) else word for word in words])
    return made


# What the program before may have left in force on the control, of all motions, of those with feed, and of arcs. A
# motion word of the program's own ends a cycle, so that G80 is not among them.
SAID_OF_ALL = {"G20", "G21", "G40", "G43", "G49", "G54", "G61", "G61.1", "G64", "G90", "G91"}
SAID_OF_FEEDS, SAID_OF_ARCS = {"G93", "G94", "G95"}, {"G17", "G18", "G19", "G90.1", "G91.1"}
MODES = SAID_OF_ALL | SAID_OF_FEEDS | SAID_OF_ARCS


def said_until(text):
    """For each line of a program the modes that it has said, up to the end of this line."""
    said, made = set(), []
    for line in nc_reader.Reader(text, "linuxcnc").codes:
        said = said | {f"G{float(word):g}" for word in re.findall(r"G\s*(\d+\.?\d*)", line)} & MODES
        made.append(said)
    return made


def motions_of(text):
    """Where a program goes and how fast, its words beside and the modes that it has said before, by the second reader of
    the tests; None where it cannot read it."""
    try:
        events = nc_reader.read(text, "linuxcnc")
    except nc_reader.Unreadable:
        return None
    made, feed, said = [], None, said_until(text)
    for event in events:
        feed = ([word for word in event.words if word.startswith("F")] or [feed])[-1]
        words = [word for word in event.words if word[0] != "F" and word not in MODES]
        if event.kind in ("rapid", "feed", "arc", "holes"):
            depends = SAID_OF_ALL | (set() if event.kind == "rapid" else SAID_OF_FEEDS) | \
                (SAID_OF_ARCS if event.kind == "arc" else set())
            words += [event.work, sorted(said[event.line - 1] & depends)]
        if event.kind in ("rapid", "feed", "arc"):
            way = [event.kind, event.start, event.z0, event.end, event.z1]
            if event.kind == "arc":
                way += [event.arc.centre, event.arc.ccw, event.arc.plane, event.arc.sweep]
            made.append(way + [None if event.kind == "rapid" else feed, words])
        elif event.kind == "holes":
            made.append([event.code, event.cycle, event.repeats, event.retract, event.holes, feed, words])
        elif event.kind != "words" or words:
            made.append([event.kind, words])
    return made


def goes_as(text):
    """Says of other texts that the tool goes as in this one: words are gone, or blocks exchanged, without which it goes
    the same way."""
    way = motions_of(text)

    def holds(change):
        return change.how in ("word deleted", "exchanged", "deleted") and motions_of(change.text()) == way or None
    return holds


def pocket_program(context):
    before, same_way = words_of_program(context.text), goes_as(context.text)

    def answer(change):
        # Comments are for people.
        return "information" if words_of_program(change.text()) == before else same_way(change)
    return answer


profile = profile_of.oracle


def without(text, begin, end):
    return re.sub(re.escape(begin) + r".*?" + re.escape(end), "", text, flags=re.DOTALL)


def claims_of_dxf(text):
    """Unit, layers that are off, and the layers and places of entities that are no texts."""
    claims, entity, section, variable = [], "", "", ""
    lines = text.splitlines()
    for code, value in zip(lines[::2], lines[1::2]):
        group = int(code)
        if group == 0:
            entity = value
            if value in ("SECTION", "ENDSEC"):
                section = ""
        if entity == "SECTION" and group == 2:
            section = value
        if group == 9:
            variable = value
        if section == "HEADER" and variable == "$INSUNITS" and group == 70:
            claims.append(value)
        if section == "TABLES" and entity == "LAYER" and group in (70, 62):
            claims.append(value if group == 70 else "off" if value.startswith("-") else "")
        if section == "ENTITIES" and entity != "TEXT" and group in (0, 8, 10, 20, 30, 11, 21, 31, 40, 42, 70, 90):
            claims += [code.strip(), value.strip()]
    return " ".join(claims)


def claims_of(form, text):
    if form == "dxf":
        return claims_of_dxf(text)
    text = without(text, "<text", "</text>")
    for name in ("stroke", "stroke-width", "fill", "xmlns", "xmlns:inkscape", "version"):
        text = without(text, f' {name}="', '"')
    return without(text, "<?", "?>")


def tokens_of(text):
    return re.findall(r"-?(?:\d+\.?\d*|\.\d+)(?:e-?\d+)?|[^\s\d]", text)


def same_tokens(one, other, within):
    def same(a, b):
        try:
            return abs(float(a) - float(b)) <= within
        except ValueError:
            return a == b
    return len(one) == len(other) and all(map(same, one, other))


def in_any_order(svg):
    """The lines of an SVG with the elements of each group sorted: which outlines are there is claimed, not which is
    first."""
    made = [[]]
    for line in svg.splitlines():
        if re.match(r"\s*<(path|circle|text)\b.*(/>|</text>)$", line):
            made[-1].append(line)
        else:
            made += [line, []]
    return [sorted(item) if isinstance(item, list) else item for item in made]


def lines_of_hpgl(text):
    """The lines of a plot, by their pen, in mm. Labels are for people."""
    made, pen, at = [], None, None
    for word in re.findall(r"LB[^\x03]*\x03|[A-Z]{2}[^;]*;?", text):
        numbers = [float(n) for n in word[2:].strip(";").split(",") if n] if word[:2] in ("SP", "PU", "PD") else []
        places = list(zip(numbers[::2], numbers[1::2]))
        if word.startswith("SP"):
            pen = numbers
        elif word.startswith("PU"):
            at = places[-1:]
        elif word.startswith("PD"):
            made.append((pen, at + places))
            at = places[-1:]
    return made


def plot(context):
    """The lines are where they were, to a unit of the plotter, in whatever order: what is claimed of a plot holds within
    0.0178 mm and the tolerance of 0.02 mm."""
    before = lines_of_hpgl(context.text)
    frame = context.text[:6]

    def answer(change):
        try:
            after = lines_of_hpgl(change.text())
        except ValueError:
            return None
        if after == before:
            return "information"
        if not change.text().startswith(frame) or len(after) != len(before) or any(pen is None for pen, _ in after):
            return None
        return all(a[0] == b[0] and len(a[1]) == len(b[1]) and all(
            max(abs(p[0] - q[0]), abs(p[1] - q[1])) <= 1 for p, q in zip(a[1], b[1]))
            for a, b in zip(sorted(before), sorted(after))) or None
    return answer


def export(form):
    """What is claimed is the same, to a millionth or two."""
    if form == "hpgl":
        return plot

    def oracle(context):
        before = tokens_of(claims_of(form, context.text))

        def answer(change):
            try:
                after = tokens_of(claims_of(form, change.text()))
            except ValueError:
                return None
            if same_tokens(before, after, 0):
                return "information"
            return same_tokens(before, after, 2e-6) or \
                form == "svg" and in_any_order(change.text()) == in_any_order(context.text) or None
        return answer
    return oracle
