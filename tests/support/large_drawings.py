#!/usr/bin/env python3
"""Large drawings without a fault, for measurements: plates with twenty round holes each.

    large_drawings.py dxf PLATES FILE    lines and circles, shuffled, with handles and owners (4,620 plates: 10 MB)
    large_drawings.py svg PLATES FILE    outlines of sixty Bezier curves each (2,187 plates: 10 MB)
"""
import math
import random
import sys

HEAD = '0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n'


def dxf(plates):
    entities = []

    def add(kind, subclass, numbers):
        entities.append(f'0\n{kind}\n5\n{len(entities) + 256:X}\n330\n1F\n100\nAcDbEntity\n8\nCUT\n100\n{subclass}\n'
                        + ''.join(f'{code}\n{number}\n' for code, number in numbers))

    for i in range(plates):
        x, y = (i % 40) * 130.0, (i // 40) * 110.0
        corners = [(x, y), (x + 120, y), (x + 120, y + 100), (x, y + 100)]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            add('LINE', 'AcDbLine', [(10, a[0]), (20, a[1]), (30, 0.0), (11, b[0]), (21, b[1]), (31, 0.0)])
        for k in range(20):
            add('CIRCLE', 'AcDbCircle', [(10, x + 10 + (k % 5) * 22.5), (20, y + 12 + (k // 5) * 25), (30, 0.0),
                                         (40, f'{3 + i % 5000 * 0.001:.4f}')])
    random.Random(1).shuffle(entities)
    return HEAD + ''.join(entities) + '0\nENDSEC\n0\nEOF\n'


def svg(plates):
    shapes, n = [], 60
    for i in range(plates):
        x, y, radius = 60 + (i % 40) * 130.0, 60 + (i // 40) * 130.0, 50 + i % 800 * 0.01
        waves = [(2 * math.pi * k / n, radius * (1 + 0.08 * math.sin(10 * math.pi * k / n))) for k in range(n)]
        points = [(x + r * math.cos(a), y + r * math.sin(a)) for a, r in waves]
        path = f'M{points[0][0]:.4f},{points[0][1]:.4f}'
        for k in range(n):
            p, q, r, s = points[k - 1], points[k], points[(k + 1) % n], points[(k + 2) % n]
            path += (f'C{q[0] + (r[0] - p[0]) / 6:.4f},{q[1] + (r[1] - p[1]) / 6:.4f} '
                     f'{r[0] - (s[0] - q[0]) / 6:.4f},{r[1] - (s[1] - q[1]) / 6:.4f} {r[0]:.4f},{r[1]:.4f}')
        shapes.append(f'<path d="{path}Z"/>')
        shapes += [f'<circle cx="{x - 20 + (k % 5) * 10:.3f}" cy="{y - 16 + (k // 5) * 10:.3f}" r="{2 + i * 0.001:.4f}"/>'
                   for k in range(20)]
    return ('<svg xmlns="http://www.w3.org/2000/svg" width="6000mm" height="8000mm" viewBox="0 0 6000 8000" '
            'fill="none" stroke="black">' + '\n'.join(shapes) + '</svg>')


def main():
    kind, plates, name = sys.argv[1:]
    with open(name, 'w', encoding='utf-8') as file:
        file.write({'dxf': dxf, 'svg': svg}[kind](int(plates)))


if __name__ == '__main__':
    main()
