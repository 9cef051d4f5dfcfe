"""Writes part.stl, casting.stl, touches.xyz and touches-directions.xyz beside itself: a housing with a blind bore, the
casting that it is cut from, and where a probe's ball touched that casting when it lay a little elsewhere.

The casting has 1.6 to 3.5 mm of stock, its core is moved and tilted, and it lies turned by 3.5 degrees, as castings do
on a table. Where the part is in it is what `lekalo locate` finds.
"""

import math
import pathlib
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


def write(name, triangles):
    data = name.encode().ljust(80) + struct.pack("<I", len(triangles))
    for triangle in triangles:
        data += struct.pack("<12fH", 0, 0, 0, *(c for p in triangle for c in p), 0)
    (pathlib.Path(__file__).parent / f"{name}.stl").write_bytes(data)


if __name__ == "__main__":
    write("part", housing((-55, -35, -20), (55, 35, 20), (8, 2, 24), (8, 2, 24), -8))
    rough = housing((-57.4, -38.1, -22.6), (58.2, 37.3, 23.5), (8.3, 1.8, 22.2), (8.9, 2.3, 21.0), -5.4)
    write("casting", turned(rough, (0.3, -0.2, 1), 3.5, (2.5, -1.5, 1.25)))
    touched(turned(rough, (0.2, -0.3, 1), 3.9, (2.1, -0.9, 1.5)), 1.5)
