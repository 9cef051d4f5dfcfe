"""Writes part.stl, casting.stl, touches.xyz, touches-directions.xyz and scan.ply beside itself: a housing with a blind
bore, the casting that it is cut from, where a probe's ball touched that casting when it lay a little elsewhere, and
what a scanner saw of another such casting, which stood on a table and whose core had a rounded end.

The casting has 1.6 to 3.5 mm of stock, its core is moved and tilted, and it lies turned by 3.5 degrees, as castings do
on a table. Where the part is in it is what `lekalo locate` finds.
"""

import math
import pathlib
import random
import struct

AROUND = 48  # points around the outside and around the bore


def housing(low, high, bore_top, bore_floor, floor):
    """A box with a blind bore from the top: circles (x, y, radius) there and at its floor."""
    def box(z):
        corners = [(high[0], low[1]), (high[0], high[1]), (low[0], high[1]), (low[0], low[1])]
        side = AROUND // 4
        return [tuple(a + (b - a) * k / side for a, b in zip(corners[i], corners[(i + 1) % 4])) + (z,)
                for i in range(4) for k in range(side)]

    def circle(at, z):
        turns = (2 * math.pi * k / AROUND - math.pi / 4 for k in range(AROUND))
        return [(at[0] + at[2] * math.cos(a), at[1] + at[2] * math.sin(a), z) for a in turns]

    bottom, top, rim, end = box(low[2]), box(high[2]), circle(bore_top, high[2]), circle(bore_floor, floor)
    triangles = []
    for k in range(AROUND):
        n = (k + 1) % AROUND
        for a, b in ((bottom, top), (top, rim), (rim, end)):
            triangles += [(a[k], a[n], b[k]), (a[n], b[n], b[k])]
        triangles.append((((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]), bottom[n], bottom[k]))
        triangles.append((bore_floor[:2] + (floor,), end[k], end[n]))
    return triangles


def turned(triangles, axis, degrees, shift):
    length = math.sqrt(sum(a * a for a in axis))
    u = [a / length for a in axis]
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))

    def move(p):
        along = sum(a * b for a, b in zip(u, p))
        across = (u[1] * p[2] - u[2] * p[1], u[2] * p[0] - u[0] * p[2], u[0] * p[1] - u[1] * p[0])
        return tuple(p[i] * c + across[i] * s + u[i] * along * (1 - c) + shift[i] for i in range(3))

    return [tuple(move(p) for p in triangle) for triangle in triangles]


def touched(triangles, radius):
    """The ball's centre at the middle of every third triangle; the surface is up to 0.08 mm off. The second file has
    the directions, too."""
    lines, directions = [], []
    for a, b, c in triangles[::3]:
        u, v = ([q[k] - a[k] for k in range(3)] for q in (b, c))
        n = [u[k - 2] * v[k - 1] - u[k - 1] * v[k - 2] for k in range(3)]
        middle, length = [sum(p) / 3 for p in zip(a, b, c)], math.hypot(*n)
        high = radius + 0.08 * math.sin(middle[0] / 20) * math.cos(middle[1] / 15)
        lines.append(" ".join(f"{middle[k] + high * n[k] / length:.3f}" for k in range(3)))
        directions.append(" ".join(f"{c / length:.4f}" for c in n))
    folder = pathlib.Path(__file__).parent
    (folder / "touches.xyz").write_text("\n".join(lines) + "\n")
    (folder / "touches-directions.xyz").write_text("".join(f"{p} {n}\n" for p, n in zip(lines, directions)))


def scanned(low, high, core, floor, round_end, step, noise):
    """Points (x, y, z) some `step` apart on all but the underside, off the surface by up to `noise`."""
    x, y, r = core
    foot = low[2] + 0.3  # next to the table nothing is seen
    draw = random.Random(1)
    points = []

    def see(p, n):
        off = draw.uniform(-noise, noise)
        points.append(tuple(a + off * b for a, b in zip(p, n)))

    def steps(a, b):
        count = math.ceil(abs(b - a) / step)
        return [a + (b - a) * k / count for k in range(count + 1)]

    def around(radius):
        count = max(1, math.ceil(2 * math.pi * radius / step))
        return [(math.cos(2 * math.pi * k / count), math.sin(2 * math.pi * k / count)) for k in range(count)]

    for u in steps(low[0], high[0]):
        for v in steps(low[1], high[1]):
            if math.hypot(u - x, v - y) > r + step / 2:
                see((u, v, high[2]), (0, 0, 1))
        for w in steps(foot, high[2])[:-1]:
            see((u, low[1], w), (0, -1, 0)), see((u, high[1], w), (0, 1, 0))
    for v in steps(low[1], high[1])[1:-1]:
        for w in steps(foot, high[2])[:-1]:
            see((low[0], v, w), (-1, 0, 0)), see((high[0], v, w), (1, 0, 0))
    for c, s in around(r):
        for w in steps(floor + round_end, high[2]):
            see((x + r * c, y + r * s, w), (-c, -s, 0))
    for angle in steps(0, round_end * math.pi / 2)[1:]:
        a = angle / round_end
        out = r - round_end + round_end * math.cos(a)
        for c, s in around(out):
            see((x + out * c, y + out * s, floor + round_end - round_end * math.sin(a)),
                (-c * math.cos(a), -s * math.cos(a), math.sin(a)))
    for out in steps(r - round_end, 0)[1:]:
        for c, s in around(out):
            see((x + out * c, y + out * s, floor), (0, 0, 1))
    return points


def write_points(name, points):
    head = "ply\nformat binary_little_endian 1.0\n" + f"element vertex {len(points)}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz") + "end_header\n"
    data = head.encode() + b"".join(struct.pack("<3f", *p) for p in points)
    (pathlib.Path(__file__).parent / f"{name}.ply").write_bytes(data)


def write(name, triangles):
    data = name.encode().ljust(80) + struct.pack("<I", len(triangles))
    for triangle in triangles:
        data += struct.pack("<12fH", 0, 0, 0, *(c for p in triangle for c in p), 0)
    (pathlib.Path(__file__).parent / f"{name}.stl").write_bytes(data)


if __name__ == "__main__":
    write("part", housing((-55, -35, -20), (55, 35, 20), (8, 2, 24), (8, 2, 24), -8))
    rough = housing((-57.4, -38.1, -22.6), (58.2, 37.3, 23.5), (8.3, 1.8, 22.2), (8.9, 2.3, 21.0), -5.4)
    write("casting", turned(rough, (0.3, -0.2, 1), 3.5, (2.5, -1.5, 1.25)))
    seen = scanned((-57.4, -38.1, -22.6), (58.2, 37.3, 23.5), (8.5, 2, 21.5), -5.4, 6, 2, 0.018)
    write_points("scan", turned([seen], (0, 0, 1), 3.5, (2.5, -1.5, 0))[0])
    touched(turned(rough, (0.2, -0.3, 1), 3.9, (2.1, -0.9, 1.5)), 1.5)
