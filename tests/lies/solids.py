"""The truth about placements of solids: blocks along the axes, for which a clearance is that of eight corners."""

import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
from fractions import Fraction as F

import changes
import truth

SCRIPT = pathlib.Path(__file__).parent.parent / "support" / "check_solid_certificate.py"
INFORMATION = [r"/(seed|work|version|method|run|warnings)(/.*)?$", r"/inputs/\d+/path$", r"/contacts/\d+/multiplier$"]
MAY_GO = r"/contacts/\d+$|/certificate/trees/\d+/nodes/\d+/\d+$"
FACES = ((0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6),
         (1, 3, 5), (3, 7, 5))
SLACK = F("4e-15")  # of roundings, as a share


# The least steps that claims tell apart: contacts to a millionth of the blank's size, the pose and its window to their
# roundings (docs/formats.md).
STEPS = ((r"/contacts/\d+/(part_point|blank_point|distance)", 1e-3),
         (r"/(window/)?(quaternion/\d|x|y|z|shift|pivot/\d|min_allowance|shortfall|gap)$", 1e-9))


def least_step(value, way, path):
    for rule, step in STEPS:
        if re.match(rule, path):
            return value + way * step
    return changes.next_double(value, way, path)


def corners(low, high):
    return [tuple((low, high)[k >> axis & 1][axis] for axis in range(3)) for k in range(8)]


def stl(low, high):
    """A block along the axes as STL text."""
    points = corners(low, high)
    rows = ["facet normal 0 0 0\nouter loop\n" + "".join("vertex {} {} {}\n".format(*points[v]) for v in face) +
            "endloop\nendfacet\n" for face in FACES]
    return "solid block\n" + "".join(rows) + "endsolid block\n"


def triangles(text):
    numbers = [tuple(map(F, row)) for row in re.findall(r"vertex (\S+) (\S+) (\S+)", text)]
    return [numbers[k:k + 3] for k in range(0, len(numbers), 3)]


def binary(mesh):
    return bytes(80) + struct.pack("<I", len(mesh)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *(float(c) for p in t for c in p), 0) for t in mesh)


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def placed(pose, point):
    w, x, y, z = (F(c) for c in pose["quaternion"])
    rows = ((w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z))
    size = w * w + x * x + y * y + z * z
    return [dot(row, point) / size + F(pose[axis]) for row, axis in zip(rows, "xyz")]


def turn_from(start, pose):
    """The Cayley vector of the rotation from one to the other."""
    a, b = [F(c) for c in pose["quaternion"]], [F(c) for c in start["quaternion"]]
    w = dot(a, b)
    axis = [a[i] * b[0] - b[i] * a[0] - (a[j] * b[k] - a[k] * b[j]) for i, j, k in ((1, 2, 3), (2, 3, 1), (3, 1, 2))]
    return [c / w for c in axis]


def in_window(document):
    window = document["window"]
    most = {"xyz": (0, 0, 0), "c-xyz": (0, 0, 1), "six": (1, 1, 1)}[document["freedom"]]
    degrees, shift = F(window["turn_deg"]), F(window["shift"])
    if not 0 <= degrees <= 90 or shift < 0:
        return False
    tangent = math.tan(math.radians(float(degrees) / 2))
    pivot = [F(c) for c in window["pivot"]]
    middle = placed(window, pivot)
    slack = SLACK * (sum(map(abs, pivot)) + sum(abs(F(document[axis])) for axis in "xyz") + shift)
    if any(abs(c) > shift + slack for c in minus(placed(document, pivot), middle)) or \
            any(abs(c) > F(m * tangent) + (SLACK if document["freedom"] != "xyz" else 0)
                for c, m in zip(turn_from(window, document), most)):
        return False
    # The certificate covers all of it.
    certificate = document["certificate"]
    tree = certificate["trees"][0]
    return len(certificate["trees"]) == 1 and certificate["pivot"] == window["pivot"] and \
        not any(turn_from(window, tree)) and \
        all(F(tree[a][0]) <= c - shift and F(tree[a][1]) >= c + shift for a, c in zip("xyz", middle)) and \
        all(F(tree[a][1]) >= m * F(tangent) * (1 + F("1e-15")) and F(tree[a][0]) <= -m * F(tangent) * (1 + F("1e-15"))
            for a, m in zip(("turn_x", "turn_y", "turn_z"), most))


def contact_holds(contact, document, part, blank, size):
    slack = F("1e-6") * size
    def off(point, triangle):
        normal = [dot((u, v), (w, -x)) for u, v, w, x in [
            (e[(k + 1) % 3], e[(k + 2) % 3], f[(k + 2) % 3], f[(k + 1) % 3])
            for e, f in [(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]))] for k in range(3)]]
        flat = [k for k in range(3) if normal[k]][0]
        low = [min(p[k] for p in triangle) for k in range(3)]
        high = [max(p[k] for p in triangle) for k in range(3)]
        outside = max(max(l - c, c - h, 0) for l, c, h in zip(low, point, high))
        # A triangle of a block is half of a rectangle: beyond its long side it is the other half.
        u, v = [k for k in range(3) if k != flat]
        signs = []
        for a, b in zip(triangle, triangle[1:] + triangle[:1]):
            signs.append((b[u] - a[u]) * (point[v] - a[v]) - (b[v] - a[v]) * (point[u] - a[u]))
        scale = max(high[u] - low[u], high[v] - low[v])
        beyond = min(max(-s for s in signs), max(signs)) / scale
        return max(outside, beyond)
    one, other = [F(c) for c in contact["part_point"]], [F(c) for c in contact["blank_point"]]
    apart = minus(placed(document, one), other)
    return off(one, part[contact["part_triangle"]]) <= slack and off(other, blank[contact["blank_triangle"]]) <= slack and \
        abs(math.sqrt(dot(apart, apart)) - contact["distance"]) <= slack


def named(document):
    """The inputs, in whatever order."""
    return {one["role"]: dict(one, path="") for one in document["inputs"]}


def derived(document, inside):
    clearance, bound = document["clearance"], document["upper_bound"]
    if document["inside"] is not inside or (clearance is None) is inside or document["unknown_area_mm2"] != 0:
        return False
    least = F(document["min_allowance"])
    if (F(bound) < least) != (document["status"] == "infeasible") or document["status"] == "unproved" or \
            document["status"] == "optimal" and not inside:
        return False
    if not inside:
        return document["gap"] is None and document["shortfall"] is None
    near = lambda value, real: abs(F(value) - real) <= F("1e-15") * (abs(F(bound)) + F(clearance) + least)
    missing = least - F(clearance)
    return 0 <= F(clearance) <= F(bound) and near(document["gap"], F(bound) - F(clearance)) and \
        (near(document["shortfall"], missing) if missing > 0 else document["shortfall"] == 0)


def proved(document, part, blank):
    """What the stranger's script says of the certificate."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "part").write_bytes(binary(part))
        (folder / "blank").write_bytes(binary(blank))
        (folder / "result").write_text(json.dumps(document))
        (folder / "list").write_text(f"{folder}/part {folder}/blank {folder}/result -\n")
        ran = subprocess.run([sys.executable, "-B", str(SCRIPT), str(folder / "list")], capture_output=True, text=True)
        return ran.stdout.strip() == "proved"


def oracle(context):
    before = json.loads(context.text)
    part, blank = triangles(context.files["part.stl"]), triangles(context.files["casting.stl"])
    sides = [(min(c), max(c)) for c in zip(*(p for t in blank for p in t))]
    size = max(high - low for low, high in sides)

    def all_true(document):
        points = [placed(document, p) for t in part for p in t]
        least = min(min(c - low, high - c) for p in points for c, (low, high) in zip(p, sides))
        same = all(document[key] == before[key] for key in ("format", "units"))
        inputs = named(document) == named(before)
        return same and inputs and derived(document, least > 0) and \
            (least <= 0 or F(document["clearance"]) <= least) and in_window(document) and \
            all(contact_holds(c, document, part, blank, size) for c in document["contacts"]) and \
            proved(document, part, blank)

    def holds(change):
        if truth.matches(INFORMATION, change.path):
            return "information"
        after = truth.document_of(change)
        if after is None or not truth.may_hold(change, before, after, MAY_GO):
            return None
        try:
            return all_true(after) or None
        except (KeyError, TypeError, IndexError, ZeroDivisionError):
            return None
    return holds
