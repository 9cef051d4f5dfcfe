"""Decides which changes of a placement of solids, or of its meshes, leave every claim true.

All of it is computed in fractions; of triangles, their corners and sides only those that doubles show to be nearest. What a leaf of
the certificate proves says tests/support/check_solid_certificate.py, which was written from docs/formats.md alone.
"""

import collections
import hashlib
import itertools
import json
import math
import pathlib
import struct
import sys
from fractions import Fraction as F

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))

import check_solid_certificate as proof
import nc_reader
import exact
import exact_bodies
import exact_solids as space
import solid_faces
import touches
import truth
from exact_solids import cross, dot, plus, sub, times
from solid_faces import exactly_of_triangles, of_triangles

INFORMATION = [r"/(seed|work|version|method|run|warnings|start|symmetry)(/.*)?$", r"/inputs/\d+/path$",
               r"/certificate_file/path$",
               r"/contacts/\d+/multiplier$", r"/scan/assumptions/\d+$", r"/nc/(motions|scan_frame|notes)(/.*)?$",
               r"/(nc|offset)/output/path$"]
# Items that each say something for themselves; a term, a ball or a node is missed where it is needed.
MAY_GO = r"/(contacts|inputs)/\d+$|/certificate/(part_balls|part_points|datum_points|directions|bodies|blank_balls|planes)/\d+$|" \
         r"/certificate/trees/\d+/nodes/\d+(/\d+)?$|/scan/touches/(balls|cuts|ways)/\d+(/terms/\d+)?$|/choice$"
UNITS = {"mm": F(1), "inch": F(254, 10), "m": F(1000)}
SLACK = F(4, 10 ** 15)  # of numbers of poses that were computed in doubles


def bytes_of(text):
    return text.encode(errors="surrogateescape")


def triangles_of(text, unit):
    """The triangles of a binary STL, of a PLY of doubles or of an OBJ without faces of more corners, in mm."""
    data = bytes_of(text)
    if data.startswith(b"ply\n"):
        header, body = data.split(b"end_header\n", 1)
        if header.split(b"\n")[1] != b"format binary_little_endian 1.0" or header.count(b"property") != 4:
            raise ValueError("another PLY than those of lekalo")
        vertices, faces = (int(line.split()[2]) for line in header.split(b"\n") if line.startswith(b"element"))
        places = [[F(c) * UNITS[unit] for c in row] for row in struct.iter_unpack("<3d", body[:24 * vertices])]
        rows = list(struct.iter_unpack("<B3i", body[24 * vertices:]))
        if len(rows) != faces or any(row[0] != 3 for row in rows):
            raise ValueError("faces that are no triangles")
        return [[places[k] for k in row[1:]] for row in rows]
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        rows = [struct.unpack_from("<9f", data, at + 12) for at in range(84, len(data), 50)]
        return [[[F(c) * UNITS[unit] for c in row[k:k + 3]] for k in (0, 3, 6)] for row in rows]
    points, made = [], []
    for words in (line.split("#")[0].split() for line in text.splitlines()):
        if words[:1] == ["v"]:
            if len(words) != 4:
                raise ValueError("a vertex with more than three numbers")
            points.append([F(word) * UNITS[unit] for word in words[1:]])
        elif words[:1] == ["f"]:
            corners = [int(word) for word in words[1:]]
            if len(corners) != 3 or not all(1 <= k <= len(points) for k in corners):
                raise ValueError("a face that is no triangle of vertices before it")
            made.append([points[k - 1] for k in corners])
    return made


class Mesh:
    """A closed surface, and what was found out about balls beside it."""

    def __init__(self, triangles):
        self.all = triangles
        self.kept = [t for t in triangles if any(space.normal(t))]
        self.in_doubles = [[[float(c) for c in p] for p in t] for t in self.kept]
        self.boxes = boxes(self.in_doubles)
        self.known = {}
        edges = collections.Counter(
            frozenset((tuple(t[k - 1]), tuple(t[k]))) for t in self.kept for k in range(3))
        if not self.kept or any(count % 2 for count in edges.values()):
            raise ValueError("the surface is open")

    def ball_holds(self, ball, wanted):
        key = (tuple(ball), wanted)
        if key not in self.known:
            self.known[key] = self.looked_at(ball[:3], ball[3], wanted)
        return self.known[key]

    def looked_at(self, p, radius, wanted):
        """What space.ball_holds says, of the triangles that doubles show to be near."""
        at, most = [float(x) for x in p], float(radius) ** 2 * (1 + 1e-9) + 1e-9
        near = [t for t, box, rough in zip(self.kept, self.boxes, self.in_doubles)
                if sum(max(low - x, x - high, 0.0) ** 2 for x, (low, high) in zip(at, box)) <= most and
                space.squared_distance(at, rough) <= most]
        squares = [space.squared_distance(p, t) for t in near]
        if any(square < radius ** 2 for square in squares):
            return False
        return 0 in squares or space.inside(p, self.kept) == wanted

    def plane_holds(self, plane):
        key = tuple(plane)
        if key not in self.known:
            self.known[key] = proof.plane_holds(plane, self.all)
        return self.known[key]

    def one_of_each_component(self):
        return [corners[0] for corners in components(self.kept)]


def components(triangles):
    """The corners of each surface that hangs together by its corners."""
    parent, made = {}, collections.defaultdict(list)

    def root(p):
        while parent.setdefault(p, p) != p:
            p = parent[p]
        return p
    for corners in ([tuple(p) for p in t] for t in triangles):
        for p in corners[1:]:
            parent[root(p)] = root(corners[0])
    for p in list(parent):
        made[root(p)].append(list(p))
    return list(made.values())


# Distances. ----------------------------------------------------------------------------------------------------

def pierces(a, b, t, slack):
    """A segment may pass through a triangle, or come as near to it as a share `slack` of its size."""
    n = space.normal(t)
    room = slack * (1 + dot(n, n))
    above, below = dot(n, sub(a, t[0])), dot(n, sub(b, t[0]))
    if above * below > 0 and min(abs(above), abs(below)) > room:
        return False
    way = sub(b, a)
    sides = [dot(cross(sub(t[k - 2], t[k]), way), sub(t[k], a)) for k in range(3)]
    return max(sides) <= room or min(sides) >= -room


def sides_of(t):
    return ((t[0], t[1]), (t[1], t[2]), (t[2], t[0]))


def may_pierce(s, t):
    return any(pierces(*side, t, 1e-9) for side in sides_of(s)) or any(pierces(*side, s, 1e-9) for side in sides_of(t))


def boxes(triangles):
    return [[(min(p[k] for p in t), max(p[k] for p in t)) for k in range(3)] for t in triangles]


def least_allowance(part, blank, widths):
    """The least distance of two surfaces less the widths of the blank's triangles, which part and blank keep."""
    apart = sorted((math.sqrt(sum(max(l - high, low - h, 0.0) ** 2 for (low, high), (l, h) in zip(a, b))), i, j)
                   for (i, a), (j, b) in itertools.product(*map(enumerate, map(boxes, (part, blank)))))
    widest, least = float(max(widths)), math.inf
    near = []
    for gap, i, j in apart:
        if gap - widest > least + 1e-6:
            break
        s, t = ([[float(c) for c in p] for p in mesh[k]] for mesh, k in ((part, i), (blank, j)))
        if gap == 0 and may_pierce(s, t):
            return None
        allowance = math.sqrt(of_triangles(s, t)) - float(widths[j])
        least = min(least, allowance)
        near.append((allowance, i, j))
    return min(root_of(exactly_of_triangles(part[i], blank[j])) - widths[j] for a, i, j in near if a <= least + 1e-9)


def least_distance(part, blank):
    """The least squared distance of two surfaces, or None where they may pass through each other."""
    near = [[[float(c) for c in p] for p in t] for t in part], [[[float(c) for c in p] for p in t] for t in blank]
    pairs = []
    for (i, a), (j, b) in itertools.product(*map(enumerate, map(boxes, near))):
        apart = sum(max(l - high, low - h, 0.0) ** 2 for (low, high), (l, h) in zip(a, b))
        pairs.append((apart, i, j))
    pairs.sort()
    least, found = math.inf, []
    for apart, i, j in pairs:
        if apart > least + 1e-6:
            break
        if apart == 0 and may_pierce(near[0][i], near[1][j]):
            return None
        distance = of_triangles(near[0][i], near[1][j])
        least = min(least, distance)
        found.append((distance, i, j))
    return min(exactly_of_triangles(part[i], blank[j]) for distance, i, j in found if distance <= least + 1e-9)


# Scans. --------------------------------------------------------------------------------------------------------

def decimal_of(fraction):
    return exact.D(fraction.numerator) / exact.D(fraction.denominator)


def root_of(fraction):
    return decimal_of(fraction).sqrt()


def squared_circle(t):
    """The squared radius of the smallest circle around a triangle."""
    a, b, c = sorted(dot(w, w) for w in (sub(t[k], t[k - 1]) for k in range(3)))
    n = space.normal(t)
    return c / 4 if a + b <= c else a * b * c / (4 * dot(n, n))


class Scan:
    """The widths of a blank, and what a result says of them."""

    def __init__(self, scan, blank, touched=None):
        self.scan, self.side = scan, scan["underside"]
        if touched:
            nominal, points, directions = touched
            self.unknown, self.of = [], touches.Touches(scan, nominal, points, directions).widths(nominal, blank)
            return
        guard, reach, dip = scan["guard"], scan["min_radius"], scan["max_dip"]
        if guard < 0 or (reach is None and dip is None) or (dip is not None and dip < 0) or \
                (self.side and self.side["flat"] <= 0) or any(
                    reach is not None and off >= reach for off in [guard] + ([self.side["flat"]] if self.side else [])):
            raise ValueError("no statements about a scan")
        ways = [self.widths(blank.kept, radius) for radius, given in ((True, reach), (False, dip)) if given is not None]
        by = ways[0] if len(ways) == 1 or (None not in ways[0] and max(ways[0]) <= max(ways[1])) else ways[1]
        self.unknown = [t for t, width in zip(blank.kept, by) if width is None]
        self.of = [decimal_of(self.guard(t)) if width is None else width for t, width in zip(blank.kept, by)]

    def is_low(self, p):
        return self.side is not None and abs(float(p[2]) - float(self.side["z"])) <= float(self.side["flat"])

    def guard(self, t):
        return max([self.scan["guard"]] + ([self.side["flat"]] if any(map(self.is_low, t)) else []))

    def widths(self, triangles, radius):
        made = []
        for t in triangles:
            if all(map(self.is_low, t)):
                made.append(decimal_of(self.side["flat"]))
            elif not radius:
                made.append(decimal_of(self.guard(t) + self.scan["max_dip"]))
            else:
                reach = self.scan["min_radius"]
                rest = (reach - self.guard(t)) ** 2 - squared_circle(t)
                made.append(decimal_of(reach) - root_of(rest) if rest > 0 else None)
        return made

    def is_told(self, document):
        area = sum(root_of(dot(n, n)) / 2 for n in map(space.normal, self.unknown))
        said = self.scan["assumptions"]
        return (self.scan["unknown_triangles"] == len(self.unknown) and self.scan["proved"] == (not self.unknown) and
                isinstance(said, list) and len(said) > 0 and all(
                    abs(decimal_of(F(told)) - real) <= exact.D("1e-6") * max(1, real)
                    for told, real in ((self.scan["widest"], max(self.of)), (document["unknown_area_mm2"], area))))


def points_of(text, unit):
    return [[F(word) * UNITS[unit] for word in line.split()[:3]] for line in text.splitlines() if line.strip()]


def directions_of(text):
    """The last three numbers of each line, where there are six of them."""
    rows = [[F(word) for word in line.split()[3:]] for line in text.splitlines() if line.strip()]
    if {len(row) for row in rows} - {0} and {len(row) for row in rows} != {3}:
        raise ValueError("some touches have a direction")
    return rows if any(rows) else []


def nothing_measured_is_material(points, blank, scan):
    """The corners of the blank are points, and no point is deeper in the material than points may be off."""
    if any(k != int(k) or not 0 <= k < len(points) for k in scan.scan["left_out"]):
        return False
    kept = [p for k, p in enumerate(points) if k not in set(scan.scan["left_out"])]
    known = {tuple(map(float, p)) for p in kept}
    corners = {tuple(map(float, p)) for t in blank.kept for p in t if not scan.is_low(p)}
    if not corners <= known:
        return False
    guard = decimal_of(scan.scan["guard"])
    return all(tuple(map(float, p)) in corners or not space.inside(p, blank.kept) or any(
        root_of(space.squared_distance(p, t)) - width <= guard for t, width in zip(blank.kept, scan.of)) for p in kept)


# Poses. --------------------------------------------------------------------------------------------------------

def quaternion(pose):
    if len(pose["quaternion"]) != 4 or not any(pose["quaternion"]):
        raise ValueError("no rotation")
    return pose["quaternion"]


def place(pose, p):
    return plus(space.turned(quaternion(pose), p), [pose[axis] for axis in "xyz"])


def placed(document, triangles):
    at = {p: place(document, list(p)) for p in {tuple(p) for t in triangles for p in t}}
    return [[at[tuple(p)] for p in t] for t in triangles]


def between(before, after):
    """A quaternion of the turn that comes after one rotation to give another."""
    return space.product(after, before[:1] + times(before[1:], -1))


def has_all_turns(document):
    return document["window"]["turn_deg"] == 180


def charts_of(document):
    """What each tree is counted from, after the start."""
    half_turns = [[F(k == part) for k in range(4)] for part in range(4)]
    if not has_all_turns(document):
        return half_turns[:1]
    return {"xyz": half_turns[:1], "c-xyz": [half_turns[0], half_turns[3]], "six": half_turns}[document["freedom"]]


def most_turns(document):
    degrees = document["window"]["turn_deg"]
    cosine, sine = exact.turn(exact.D(degrees.numerator) / degrees.denominator * exact.PI / 360)
    most = F(1) if has_all_turns(document) else F(sine / cosine)
    return {"xyz": [F(0)] * 3, "c-xyz": [F(0), F(0), most], "six": [most] * 3}[document["freedom"]]


def pose_is_allowed(document):
    window = document["window"]
    shift = window["shift"]
    if shift < 0 or not (0 <= window["turn_deg"] <= 90 or has_all_turns(document)):
        return False
    slack = F(0) if document["freedom"] == "xyz" else SLACK
    parts = between(quaternion(window), quaternion(document))
    largest = max(abs(w) for chart in charts_of(document) for w, part in zip(parts, chart) if part)
    if any(abs(x) > (most + slack) * largest for x, most in zip(parts[1:], most_turns(document))):
        return False
    pivot = window["pivot"]
    size = shift + sum(map(abs, pivot)) + sum(abs(document[axis]) for axis in "xyz")
    return all(abs(x) <= shift + SLACK * size for x in sub(place(document, pivot), place(window, pivot)))


def root_covers(document, chart, tree):
    window = document["window"]
    if any(between(space.product(chart, quaternion(window)), tree["quaternion"])[1:]):
        return False
    middle = place(window, window["pivot"]) + [F(0)] * 3
    for axis, at, most in zip(proof.AXES, middle, [window["shift"]] * 3 + most_turns(document)):
        low, high = tree[axis]
        if low > at - most or high < at + most:
            return False
    return True


# Claims. -------------------------------------------------------------------------------------------------------

class Solids:
    """What a placement of solids claims. Meshes, clearances and leaves that were looked at before are kept, also from
    one kind to the next, many of which are of the same meshes and proof."""

    meshes, clearances, leaves, measured, margins, bodies, evenness = {}, {}, {}, {}, {}, {}, {}

    def __init__(self, files):
        self.files = files

    def mesh(self, path, unit):
        key = self.files[path], unit
        if key not in self.meshes:
            self.meshes[key] = Mesh(triangles_of(*key))
        return self.meshes[key]

    def holds(self, document, certificate):
        """All claims; numbers are fractions."""
        if document["format"] != {"name": "lekalo-locate", "version": 1} or document["units"] != "mm":
            return False
        proof_in = document["certificate_file"]
        written = [document[key]["output"] for key in ("nc", "offset") if document[key]]
        for entry in document["inputs"] + ([proof_in] if proof_in else []) + written:
            if hashlib.sha256(bytes_of(self.files[entry["path"]])).hexdigest() != entry["sha256"]:
                return False
        roles = {entry["role"]: entry for entry in document["inputs"]}
        if len(roles) != len(document["inputs"]) or not {"part", "blank"} <= roles.keys() <= {
                "part", "blank", "start", "points", "nominal", "features", "nc", "allow"}:
            return False
        if ("features" in roles) != (document["demands"] is not None):
            return False
        part, blank = (self.mesh(roles[role]["path"], roles[role]["units"]) for role in ("part", "blank"))
        if any(roles[role]["triangles"] != len(mesh.all) for role, mesh in (("part", part), ("blank", blank))):
            return False
        touched = self.touched(document, roles)
        scan = Scan(document["scan"], blank, touched) if document["scan"] else None
        if not (scan.is_told(document) and self.is_measured(roles.get("points"), blank, scan) if scan
                else document["unknown_area_mm2"] == 0 and "points" not in roles):
            return False
        faces = None
        if document["demands"]:
            file = fractions_of(self.files[roles["features"]["path"]])
            faces = solid_faces.Faces(file, part, document["min_allowance"])
            if not (faces.are_told(document["demands"]) and faces.are_off(document, place, reading_slack(blank)) and
                    faces.are_far(document, place, blank.kept) and
                    solid_faces.derived(document, certificate) and self.margin_holds(document, part, blank, faces)):
                return False
        elif not (derived(document, certificate) and self.clearance_holds(document, part, blank, scan)):
            return False
        if "choice" in document and not self.choice_holds(document, part, blank, faces):
            return False
        return (pose_is_allowed(document) and
                program_holds(document, self.files) and offset_holds(document, self.files) and
                all(contact_holds(document, contact, part, blank, scan) for contact in document["contacts"]) and
                self.is_proved(document, certificate, part, blank, faces))

    def choice_holds(self, document, part, blank, faces):
        """No more of the margin was given up than is said, the deepest place is as deep, and all is as even."""
        said, asked = document["choice"], faces.of if faces else itertools.repeat(True)
        numbers = {"margin_found", "largest"} | ({"largest_found", "deviation"} if said["criterion"] == "even" else set())
        if said.keys() != {"criterion", "give_up"} | numbers or said["criterion"] not in ("largest", "even") or \
                said["give_up"] < 0 or any((said[key] is not None) != document["inside"] for key in numbers):
            return False
        if not document["inside"]:
            return True
        margin, bound = ((document["demands"]["margin"], document["demands"]["margin_bound"]) if faces
                         else (document["clearance"], document["upper_bound"]))
        if not said["margin_found"] - said["give_up"] <= margin <= said["margin_found"] or \
                (bound is not None and said["margin_found"] > bound):
            return False
        triangles = [[list(map(float, place(document, p))) for p in t] for t, demand in zip(part.all, asked)
                     if demand and any(space.normal(t))]
        low, high = solid_faces.farthest(triangles, [[list(map(float, p)) for p in t] for t in blank.kept],
                                         max(float(said["largest"]) * 2e-3, 1e-9))
        if not low * (1 - 1e-12) <= said["largest"] <= high + said["largest"] / 16:
            return False
        return said["criterion"] == "largest" or self.is_as_even(document, part, blank, faces)

    def is_as_even(self, document, part, blank, faces):
        """No more of the smallest largest allowance was given up than is said, and points deviate as far."""
        said = document["choice"]
        targets = faces.targets() if faces else [None] * len(part.all)
        chosen = [(t, target) for t, target, demand in zip(part.all, targets, faces.of if faces else itertools.repeat(True))
                  if demand and any(space.normal(t))]
        pose = tuple(document[key] for key in ("x", "y", "z")), tuple(document["quaternion"]), str(chosen), str(blank.kept)
        if pose not in self.evenness:
            self.evenness[pose] = solid_faces.deviation(*zip(*chosen), lambda p: place(document, p), [
                [list(map(float, p)) for p in t] for t in blank.kept])
        return said["largest"] <= said["largest_found"] + said["give_up"] and \
            abs(float(said["deviation"]) - self.evenness[pose]) <= 2e-6 * float(said["largest"]) * (1 + 1e-9)

    def fault_of_body(self, row, surface):
        key = tuple(row), len(surface), str(surface[0])
        if key not in self.bodies:
            self.bodies[key] = exact_bodies.fault_of_body(row, surface)
        return self.bodies[key]

    def touched(self, document, roles):
        """The nominal mesh and the touches, where there are some."""
        if ("nominal" in roles) != bool(document["scan"] and "touches" in document["scan"]):
            raise ValueError("a nominal mesh, or touches, alone")
        if "nominal" not in roles:
            return None
        entry, text = roles["nominal"], self.files[roles["points"]["path"]]
        points = points_of(text, roles["points"]["units"])
        nominal = self.mesh(entry["path"], entry["units"])
        if entry["triangles"] != len(nominal.all) or roles["points"]["points"] != len(points):
            raise ValueError("other numbers of triangles, or of touches")
        return nominal, points, directions_of(text)

    def is_measured(self, entry, blank, scan):
        if "touches" in scan.scan:
            return True
        if entry is None:
            return not scan.scan["left_out"]
        key = self.files[entry["path"]], entry["units"], blank, json.dumps(scan.scan, default=str, sort_keys=True)
        if key not in self.measured:
            points = points_of(*key[:2])
            # Nobody has seen the triangles between them, so that nothing is said of how far those dip.
            self.measured[key] = (entry["points"] == len(points) and scan.scan["max_dip"] is None and
                                  nothing_measured_is_material(points, blank, scan))
        return self.measured[key]

    def clearance_holds(self, document, part, blank, scan):
        there = placed(document, part.kept)
        if not document["inside"]:
            # A corner outside is enough, and what else there may be is not excused.
            return any(not space.inside(p, blank.kept) for t in there[:48] for p in t)
        key = part, blank, tuple(document["quaternion"]), tuple(document[axis] for axis in "xyz"), \
            tuple(scan.of) if scan else None
        if key not in self.clearances:
            least = least_allowance(there, blank.kept, scan.of) if scan else least_distance(there, blank.kept)
            lies_in = least and least > 0 and not any(space.inside(p, there) for p in blank.one_of_each_component()) and all(
                space.inside(place(document, p), blank.kept) for p in part.one_of_each_component())
            self.clearances[key] = least if lies_in else None
        least = self.clearances[key]
        if scan:
            return least is not None and decimal_of(document["clearance"]) <= least
        return least is not None and document["clearance"] ** 2 <= least

    def margin_holds(self, document, part, blank, faces):
        """Each triangle that has a demand lies in the blank, as far from its surface as is said."""
        groups = faces.demanded()
        if not document["inside"]:
            return not faces.are_kept(document) or any(
                space.inside(place(document, p), blank.kept) is False for t in sum(groups.values(), [])[:48] for p in t)
        key = part, blank, str(groups), tuple(document["quaternion"]), tuple(document[axis] for axis in "xyz")
        if key not in self.margins:
            there = placed(document, part.kept)

            def sticks_out(p):
                return not space.inside(p, there) and all(space.squared_distance(p, t) > 0 for t in there)
            found = {}
            for demand, triangles in groups.items():
                of = placed(document, triangles)
                least = least_distance(of, blank.kept)
                lies_in = least and all(space.inside(corners[0], blank.kept) for corners in components(of))
                found[demand] = least if lies_in else None
            if not all(any(map(sticks_out, corners)) for corners in components(blank.kept)):
                found = {demand: None for demand in groups}
            self.margins[key] = found
        margin, clearance = document["demands"]["margin"], document["clearance"]
        return all(least is not None and max(F(0), clearance, low + scale * margin) ** 2 <= least
                   for (low, scale), least in self.margins[key].items())

    def is_proved(self, document, certificate, part, blank, faces):
        bound = document["demands"]["margin_bound"] if faces else document["upper_bound"]
        if certificate is None:
            return bound is None
        if certificate["pivot"] != document["window"]["pivot"]:
            return False
        rows = [(len(row), width) for table, width in (("part_balls", 4), ("blank_balls", 4), ("planes", 4), ("part_points", 3),
                                                       ("datum_points", 2), ("directions", 3), ("bodies", 13))
                for row in certificate.get(table, [])]
        if any(length != width for length, width in rows) or any(
                ball[3] < 0 for table in ("part_balls", "blank_balls") for ball in certificate[table]):
            return False
        leaves = 0
        charts = charts_of(document)
        if len(certificate["trees"]) != len(charts):
            return False
        for chart, tree in zip(charts, certificate["trees"]):
            if not root_covers(document, chart, tree):
                return False
            if any(low > high for low, high in (tree[axis] for axis in proof.AXES)):
                return False
            cells = [[tree[axis] for axis in proof.AXES]]
            for node in tree["nodes"]:
                cell = cells.pop()
                if isinstance(node[0], str):
                    k, (_, at) = proof.AXES.index(node[0]), node
                    if not cell[k][0] <= at <= cell[k][1]:
                        return False
                    cells += [cell[:k] + [half] + cell[k + 1:] for half in ([at, cell[k][1]], [cell[k][0], at])]
                    continue
                leaves += 1
                if not self.leaf_holds(node, cell, tree, certificate, bound, part, blank, faces):
                    return False
            if cells:
                return False
        return not document["certificate_file"] or document["certificate_file"]["boxes"] == leaves

    def leaf_holds(self, leaf, cell, tree, certificate, bound, part, blank, faces):
        def edges(mesh):
            return [(t[k], t[k - 2]) for t in mesh.all for k in range(3)]
        points = certificate.get("part_points", [])
        first = {"part_face": part.all, "edges": edges(part), "datum": certificate.get("datum_points", []),
                 "point": points, "point_plane": points, "point_face": points, "near": points}
        sides = [(body, side) for body in certificate.get("bodies", []) for side in range(6)]
        second = {"face": blank.all, "plane": certificate["planes"], "edges": edges(blank), "point_face": blank.all,
                  "point_plane": certificate["planes"], "datum": certificate.get("directions", []), "near": sides}
        used = []
        for kind, i, j, m in leaf:
            one, other = first.get(kind, certificate["part_balls"]), second.get(kind, certificate["blank_balls"])
            if kind not in ("ball", "plane", "face", *first) or m < 0 or any(
                    k != int(k) or not 0 <= k < len(rows) for k, rows in ((i, one), (j, other))):
                return False
            if faces and m > 0 and faces.in_rim(kind, i, certificate):
                return False
            used.append((kind, str(one[int(i)]), str(other[int(j)]), m))
        asked = str((faces.of, faces.datums, faces.within)) if faces else ""
        key = part, blank, str(used), str(cell), str(tree["quaternion"]), str(certificate["pivot"]), bound, asked
        if key not in self.leaves:
            self.leaves[key] = any(m > 0 for *_, m in leaf) and proof.wrong_with(
                leaf, cell, tree["quaternion"], certificate, faces.bounds(bound) if faces else [bound] * len(part.all),
                part.all, blank.all, faces.datums if faces else [], faces and faces.within, fault=self.fault_of_body,
                holds=lambda ball, _, wanted: (part if wanted else blank).ball_holds(ball, wanted),
                bounds_all=lambda plane, _: blank.plane_holds(plane)) is None
        return self.leaves[key]


def derived(document, certificate):
    """The fields that follow from others, and the status."""
    clearance, bound, least = document["clearance"], document["upper_bound"], document["min_allowance"]
    gap, shortfall, status = document["gap"], document["shortfall"], document["status"]
    if document["inside"] != (clearance is not None) or (shortfall is None) != (clearance is None) or \
            (gap is None) != (clearance is None or bound is None):
        return False
    if clearance is not None:
        missing = max(F(0), least - clearance)
        if clearance < 0 or abs(shortfall - missing) > (F(1, 10 ** 15) * (abs(least) + clearance) if missing else 0):
            return False
        if bound is not None and (bound < clearance or
                                  abs(gap - (bound - clearance)) > F(1, 10 ** 15) * (abs(bound) + clearance)):
            return False
    if status in ("stopped", "unproved"):
        return status == "stopped" or certificate is None
    return bound is not None and (bound < least) == (status == "infeasible") and \
        status in ("optimal", "infeasible") and (status == "infeasible" or document["inside"])


def program_holds(document, files):
    """The program is the original, turned about z and shifted, by the second reader of the tests; the rest that is said
    of it is what was said before."""
    nc, last = document["nc"], json.loads(files["r.json"])["nc"]
    if nc is None or last is None:
        return nc is last
    if any(nc[k] != last[k] for k in last if k not in ("rounding_mm", "clearance", "motions", "notes", "scan_frame")):
        return False
    w, x, y, z = document["quaternion"]
    if x or y or nc["rounding_mm"] < 0 or nc["clearance"] > document["clearance"] - nc["rounding_mm"]:
        return False
    original = files[next(one["path"] for one in document["inputs"] if one["role"] == "nc")]
    pose = float(document["x"]), float(document["y"]), 2 * math.atan2(z, w)
    return not nc_reader.differences(original, files[nc["output"]["path"]], nc["control"], pose,
                                     float(nc["rounding_mm"]), mode=nc["mode"], rise=float(document["z"]))


def offset_holds(document, files):
    """The lines are those that were written, so that they say this pose if it is the one that was found."""
    last = json.loads(files["r.json"], parse_float=F, parse_int=F)
    if document["offset"] != last["offset"]:
        return False
    return document["offset"] is None or all(document[k] == last[k] for k in ("quaternion", "x", "y", "z"))


def reading_slack(blank):
    sizes = [max(p[k] for t in blank.all for p in t) - min(p[k] for t in blank.all for p in t) for k in range(3)]
    return max(F(1), *sizes) / 10 ** 6


def contact_holds(document, contact, part, blank, scan):
    slack = reading_slack(blank)
    for role, mesh in (("part", part), ("blank", blank)):
        number, point = contact[f"{role}_triangle"], contact[f"{role}_point"]
        if number != int(number) or not 0 <= number < len(mesh.all) or len(point) != 3 or \
                space.squared_distance(point, mesh.all[int(number)]) > slack ** 2:
            return False
    way = sub(place(document, contact["part_point"]), contact["blank_point"])
    width = scan.of[blank.kept.index(blank.all[int(contact["blank_triangle"])])] if scan else exact.D(0)
    return abs(root_of(dot(way, way)) - width - decimal_of(F(contact["distance"]))) <= decimal_of(slack)


# Oracles. ------------------------------------------------------------------------------------------------------

def fractions_of(text):
    return json.loads(text, parse_float=F, parse_int=F)


def certificate_of(document, files):
    if document["certificate_file"] is None:
        return document["certificate"]
    return fractions_of(files[document["certificate_file"]["path"]])["certificate"]


def decide(claims, document):
    try:
        return claims.holds(document, certificate_of(document, claims.files)) or None
    except (KeyError, TypeError, ValueError, IndexError, ZeroDivisionError, AttributeError):
        return None


def result(context):
    before, claims = json.loads(context.text), Solids(context.files)

    def holds(change):
        if truth.matches(INFORMATION, change.path):
            return "information"
        if change.how == "given twice" or not truth.may_hold(change, before, json.loads(change.text()), MAY_GO):
            return None
        return decide(claims, fractions_of(change.text()))
    return holds


def of_another_file(context, text):
    """The files after a change of one, and the result with the digest that it has then."""
    one, other = (hashlib.sha256(bytes_of(file)).hexdigest() for file in (context.text, text))
    return dict(context.files, **{context.kind.target: text}), fractions_of(context.files["r.json"].replace(one, other))


def certificate(context):
    before, claims = json.loads(context.text), Solids(context.files)

    def holds(change):
        after = json.loads(change.text())
        if change.how == "given twice" or after.get("format") != before["format"] or \
                not truth.may_hold(change, before, after, MAY_GO):
            return None
        claims.files, document = of_another_file(context, change.text())
        return decide(claims, document)
    return holds


def features(context):
    """Another file of features, whose digest the result has."""
    before = json.loads(context.text)

    def holds(change):
        after = json.loads(change.text())
        # A part in mm says that for its file of features, too.
        if change.how == "given twice" or not truth.may_hold(change, before, after, MAY_GO + "|/units$"):
            return None
        files, document = of_another_file(context, change.text())
        return decide(Solids(files), document)
    return holds


def mesh(role):
    """Another part or blank, whose digest the result has."""
    def oracle(context):
        entry = next(entry for entry in context.json("r.json")["inputs"] if entry["role"] == role)
        before = triangles_of(context.text, entry["units"])

        def holds(change):
            text = change.text()
            try:
                # Normals, attributes, comments and corners that no triangle has are for nobody.
                if triangles_of(text, entry["units"]) == before:
                    return "information"
            except (ValueError, IndexError, struct.error):
                return None
            files, document = of_another_file(context, text)
            return decide(Solids(files), document)
        return holds
    return oracle
