#!/usr/bin/env python3
"""What drawings hold, by ezdxf and svgelements: an opinion that shares no code with lekalo.

    drawings_oracle.py csv FOLDER    writes a line for every drawing below FOLDER (tests/corpus/drawings.csv)

Curves are flattened within FLAT mm. Ends within JOIN mm meet. A drawing encloses something when a closed curve or
a ring of joined ends bounds at least LEAST mm2; else its curves are open, or there are none.
"""
import collections
import csv
import hashlib
import math
import multiprocessing
import os
import sys

FLAT, JOIN, LEAST = 0.005, 0.2, 0.01
LARGEST = 262144  # mm, of outlines in a layout (docs/limits.md): what lies further out is beyond it
# Files of which the other library does not read all, or reads what the format forbids (radii of no length).
UNDECIDED = {'drawings/ezdxf/mtext_framed_columns.dxf', 'drawings/ezdxf/circle_radius_le_0.dxf'}
UNITS = {1: 25.4, 2: 304.8, 3: 1609344, 4: 1, 5: 10, 6: 1000, 7: 1e6, 8: 25.4e-6, 9: 0.0254, 10: 914.4, 13: 0.001,
         14: 100}


def open_dxf(path):
    """The drawing, and how many mm its unit is."""
    import ezdxf
    from ezdxf import recover
    try:
        doc = ezdxf.readfile(path)
    except Exception:  # the library has several kinds of complaint, and a second reader for all of them
        doc, _ = recover.readfile(path)
    # The library says metres where the file says nothing.
    says = b'$INSUNITS' in open(path, 'rb').read()
    return doc, UNITS.get(doc.header.get('$INSUNITS', 0), 1) if says else 1


def dxf_curves(path):
    """Kinds, flattened curves in mm, and what is in the file that is no curve."""
    from ezdxf import path as paths
    doc, scale = open_dxf(path)
    hidden = {layer.dxf.name.lower() for layer in doc.layers if layer.is_off() or layer.is_frozen()}
    kinds, others, lines = collections.Counter(), collections.Counter(), []

    def walk(entity, depth, layer):
        kind = entity.dxftype()
        own = entity.dxf.get('layer', '0')
        where = layer if own == '0' and layer else own
        if where.lower() in hidden or entity.dxf.get('invisible', 0):
            return
        if kind == 'INSERT' and depth < 32:
            copies = entity.multi_insert() if entity.mcount > 1 else [entity]
            for copy in copies:
                for inner in copy.virtual_entities():
                    walk(inner, depth + 1, where)
            return
        if kind == 'POLYLINE' and not (entity.is_2d_polyline or entity.is_3d_polyline):
            others['mesh'] += 1
            return
        if kind not in ('LINE', 'ARC', 'CIRCLE', 'ELLIPSE', 'LWPOLYLINE', 'POLYLINE', 'SPLINE', 'MLINE'):
            others[kind] += 1
            return
        if kind == 'MLINE':
            for inner in entity.virtual_entities():
                walk(inner, depth + 1, where)
            return
        extrusion = entity.dxf.get('extrusion', (0, 0, 1))
        if kind not in ('LINE', 'SPLINE') and abs(extrusion[0]) + abs(extrusion[1]) > 1e-9:
            others[kind + ' (tilted)'] += 1
            return
        try:
            points = [(p.x * scale, p.y * scale) for p in paths.make_path(entity).flattening(FLAT / scale)]
        except Exception as fault:
            others[f'{kind} ({type(fault).__name__})'] += 1
            return
        if len(set(points)) < 2:
            others[kind + ' (of no length)'] += 1
            return
        kinds[kind] += 1
        lines.append(points)

    for entity in doc.modelspace():
        walk(entity, 0, '')
    return kinds, lines, others


def svg_curves(path):
    import svgelements as svg
    document = svg.SVG.parse(path, reify=True, ppi=96)
    kinds, others, lines = collections.Counter(), collections.Counter(), []
    scale = 25.4 / 96
    for element in document.elements():
        if isinstance(element, svg.Text):
            others['text'] += 1
        if not isinstance(element, svg.Shape) or element.values.get('display') == 'none' or \
                element.values.get('visibility') in ('hidden', 'collapse'):
            continue
        whole = svg.Path(element)
        whole.reify()
        for part in whole.as_subpaths():
            points = []
            for segment in svg.Path(part):
                if isinstance(segment, svg.Move):
                    points = [segment.end]
                    continue
                if segment.start is None or segment.end is None:
                    continue
                if isinstance(segment, (svg.Line, svg.Close)):
                    steps = 1
                else:
                    # A chord of a curve of this length that turns once about is within FLAT.
                    if isinstance(segment, svg.Arc):
                        length = 2 * math.pi * max(segment.rx, segment.ry) * scale
                    else:
                        poles = [segment.start] + [p for p in (getattr(segment, 'control', None),
                                                               getattr(segment, 'control1', None),
                                                               getattr(segment, 'control2', None)) if p] + [segment.end]
                        length = sum(abs(b - a) for a, b in zip(poles, poles[1:])) * scale
                    steps = max(4, min(2000, math.ceil(math.sqrt(length / FLAT))))
                points += [segment.point(k / steps) for k in range(1, steps + 1)]
                kinds[type(segment).__name__] += 1
            flat = [(p.x * scale, -p.y * scale) for p in points]
            if len(set(flat)) > 1:
                lines.append(flat)
    return kinds, lines, others


def joined(lines):
    """The same curves with ends that lie within JOIN of each other in one place."""
    cells, places = {}, []

    def place(p):
        home = (math.floor(p[0] / JOIN), math.floor(p[1] / JOIN))
        for x in (-1, 0, 1):
            for y in (-1, 0, 1):
                for k in cells.get((home[0] + x, home[1] + y), ()):
                    if math.dist(places[k], p) <= JOIN:
                        return places[k]
        cells.setdefault(home, []).append(len(places))
        places.append(p)
        return p

    out = []
    for line in lines:
        if len(line) > 2 and math.dist(line[0], line[-1]) <= JOIN:
            out.append(line[:-1] + [line[0]])
            continue
        ends = place(line[0]), place(line[-1])
        if len(line) == 2 and ends[0] == ends[1]:
            continue
        out.append([ends[0]] + line[1:-1] + [ends[1]])
    return out


def has_ring(lines):
    """True where a curve closes by itself or curves close a ring by their ends."""
    from shapely.geometry import Polygon
    parent = {}

    def root(p):
        while parent.setdefault(p, p) != p:
            p = parent[p]
        return p

    seen = set()
    for line in lines:
        if line[0] == line[-1]:
            if abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(line, line[1:]))) / 2 >= LEAST:
                return True
            continue
        # A copy of a curve, also backwards, closes nothing.
        key = min((line[0], line[len(line) // 2], line[-1]), (line[-1], line[len(line) // 2], line[0]))
        straight = tuple(sorted((line[0], line[-1]))) if len(line) == 2 else key
        if straight in seen:
            continue
        seen.add(straight)
        a, b = root(line[0]), root(line[-1])
        if a == b:
            return True
        parent[a] = b
    return False


def enclosed(lines):
    """Everything that the curves enclose, holes filled."""
    from shapely.geometry import LineString, Polygon
    from shapely.ops import polygonize, unary_union
    noded = unary_union([LineString(line) for line in lines])
    faces = unary_union([face.buffer(0) for face in polygonize(noded)])
    polygons = [faces] if faces.geom_type == 'Polygon' else list(getattr(faces, 'geoms', []))
    return unary_union([Polygon(p.exterior) for p in polygons if p.area > 0])


def words(counter):
    return '; '.join(f'{count} {kind}' for kind, count in sorted(counter.items()))


def row(task):
    """The line of one drawing; a file that the other library refuses has no second opinion."""
    folder, name = task
    path = os.path.join(folder, name)
    digest = hashlib.sha256(open(path, 'rb').read()).hexdigest()[:16]
    try:
        kinds, lines, others = (svg_curves if name.lower().endswith('.svg') else dxf_curves)(path)
    except Exception as fault:
        return [name, digest, 'unknown', '', f'{type(fault).__name__}: {fault}'.replace('\n', ' '), '', '', '', '']
    lines = joined(lines)
    area = outline = 0.0
    verdict = 'nothing'
    if lines:
        verdict = 'encloses' if has_ring(lines) else 'open'
        shape = enclosed(lines)
        area, outline = shape.area, shape.length
    xs = [p[0] for line in lines for p in line] or [0]
    ys = [p[1] for line in lines for p in line] or [0]
    if max(map(abs, xs + ys)) > LARGEST:
        verdict = 'beyond'
    if name in UNDECIDED:
        verdict = 'unknown'
    return [name, digest, verdict, words(kinds), words(others), f'{max(xs) - min(xs):.3f}',
            f'{max(ys) - min(ys):.3f}', f'{area:.3f}', f'{outline:.3f}']


def table(folder):
    out = csv.writer(sys.stdout, lineterminator='\n')
    out.writerow(['file', 'sha256', 'verdict', 'curves', 'others', 'width', 'height', 'enclosed_mm2', 'outline_mm'])
    tasks = [(folder, f'{below}/{name}') for below in ('drawings/boxes', 'drawings/ezdxf', 'drawings/shops', 'dxf')
             for name in sorted(os.listdir(os.path.join(folder, below)))]
    with multiprocessing.Pool(8) as pool:
        for line in pool.imap(row, tasks):
            out.writerow(line)
            sys.stdout.flush()


if __name__ == '__main__':
    if len(sys.argv) == 3 and sys.argv[1] == 'csv':
        table(sys.argv[2])
    else:
        sys.exit(__doc__)
