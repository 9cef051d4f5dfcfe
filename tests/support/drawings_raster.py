#!/usr/bin/env python3
"""Layouts of drawings against rasters of the same files that others draw: rsvg-convert draws SVG, and ezdxf's
drawing add-on DXF (its frontend; rsvg-convert draws what that gives).

    drawings_raster.py LEKALO DRAWN WORK [FILE...]

DRAWN has a line of JSON for each drawing, written by corpus/drawings_raster_test.cpp: the outlines, with the place
of each, and all that the reader keeps loose. The parts and their marks are those of the file that `lekalo new`
writes; equal outlines are one part there, so the places of the others are sought among the outlines. The answer is
a line of JSON for each drawing.

The raster is as fine as PIXEL mm, or coarser where a drawing would have more than MOST pixels. Strokes are WIDTH
pixels wide, and each pixel that one touches is drawn.

(a) Every point of a part or a mark has a drawn pixel within the stated loss and SLACK pixels.
(b) Every drawn pixel has a point of a part, a mark or a line on the list of what was set aside within the loss, half
    the width and SLACK pixels.

(c) The lines of the drawing and those of the layout, drawn alike, enclose the same area: the parts with their holes
    filled, and what loose lines enclose. It may differ along the rim by the loss and by TWICE, because the drawing
    may have a line twice. What lines cover of a pixel is known to 1 / 255 of it.

SLACK is what pixels cost: the point and the stroke are each within half a diagonal of the middle of their pixel
(1.42 pixels), the rasteriser's chords within 0.1 pixel of the curve. Texts, images, fills, dimensions and whatever
else is no line are left out of the raster and counted.
"""
import collections
import json
import math
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as tree

import numpy as np
from PIL import Image

from drawings_oracle import open_dxf

PIXEL, MOST, WIDTH, SLACK = 0.2, 16e6, 1.2, 1.6
CHORD = 0.01  # mm, of the polygons in a layout: they are asked for so
SPOILED, LARGER = 0.5, 0.15  # mm
TWICE = 0.25  # of a pixel, that is all by which two lines over each other cover it more than one
CURVES = {'LINE', 'ARC', 'CIRCLE', 'ELLIPSE', 'LWPOLYLINE', 'POLYLINE', 'SPLINE', 'MLINE'}
STYLE = '''* { stroke: #000 !important; stroke-opacity: 1 !important; stroke-dasharray: none !important;
  stroke-linecap: round !important; stroke-linejoin: round !important; fill: none !important;
  opacity: 1 !important; clip-path: none !important; mask: none !important; filter: none !important;
  marker: none !important; marker-start: none !important; marker-mid: none !important; marker-end: none !important; }
text, image, foreignObject { display: none !important; }
'''
Image.MAX_IMAGE_PIXELS = None


class Frame:
    """Which pixel a point in mm lies in; y points up in mm and down in pixels."""

    def __init__(self, low, high):
        width, height = max(high[0] - low[0], 1e-3), max(high[1] - low[1], 1e-3)
        fine = min(PIXEL, max(0.02, max(width, height) / 1000))
        self.pixel = max(fine, math.sqrt(width * height / MOST), max(width, height) / 30000)
        self.low, self.high = low, high
        self.margin = 8
        self.columns = math.ceil(width / self.pixel) + 2 * self.margin
        self.rows = math.ceil(height / self.pixel) + 2 * self.margin

    def pixels(self, points):
        return np.column_stack(((points[:, 0] - self.low[0]) / self.pixel + self.margin,
                                (self.high[1] - points[:, 1]) / self.pixel + self.margin))

    def cells(self, points):
        """Each cell once, of points in mm."""
        found = np.floor(self.pixels(points)).astype(np.int64)
        inside = (found >= 0).all(axis=1) & (found[:, 0] < self.columns) & (found[:, 1] < self.rows)
        return np.unique(found[inside, 1] * self.columns + found[inside, 0]), int((~inside).sum())


def disc(radius):
    reach = math.floor(radius)
    return [(x, y) for y in range(-reach, reach + 1) for x in range(-reach, reach + 1) if math.hypot(x, y) <= radius]


def near_drawn(frame, drawn, cells, radius):
    """For each cell whether a drawn pixel is so near; the margin keeps all within the raster."""
    found = np.zeros(len(cells), bool)
    flat = drawn.ravel()
    for x, y in sorted(disc(radius), key=lambda p: math.hypot(*p)):
        left = np.flatnonzero(~found)
        if not len(left):
            break
        at = np.clip(cells[left] + y * frame.columns + x, 0, flat.size - 1)
        found[left] = flat[at]
    return found


def covered(frame, cells, radius):
    mask = np.zeros(frame.rows * frame.columns, bool)
    for x, y in disc(radius):
        mask[np.clip(cells + y * frame.columns + x, 0, mask.size - 1)] = True
    return mask


def points_of(edges, step):
    """Points of lines and arcs, no further apart than `step`. Edges are x0 y0 x1 y1 and, of arcs, cx cy ccw."""
    if not edges:
        return np.zeros((0, 2))
    lines = np.array([e for e in edges if len(e) == 4] or np.zeros((0, 4)), float).reshape(-1, 4)
    arcs = np.array([e for e in edges if len(e) == 7] or np.zeros((0, 7)), float).reshape(-1, 7)
    begin = np.arctan2(arcs[:, 1] - arcs[:, 5], arcs[:, 0] - arcs[:, 4])
    end = np.arctan2(arcs[:, 3] - arcs[:, 5], arcs[:, 2] - arcs[:, 4])
    sweep = np.where(arcs[:, 6] > 0, (end - begin) % (2 * np.pi), -((begin - end) % (2 * np.pi)))
    whole = (arcs[:, 0] == arcs[:, 2]) & (arcs[:, 1] == arcs[:, 3])
    sweep = np.where(whole, np.where(arcs[:, 6] > 0, 2 * np.pi, -2 * np.pi), sweep)
    radius = np.hypot(arcs[:, 0] - arcs[:, 4], arcs[:, 1] - arcs[:, 5])
    radius_to = np.hypot(arcs[:, 2] - arcs[:, 4], arcs[:, 3] - arcs[:, 5])
    length = np.hypot(lines[:, 2] - lines[:, 0], lines[:, 3] - lines[:, 1])

    def spread(lengths):
        count = np.ceil(lengths / step).astype(np.int64) + 1
        of = np.repeat(np.arange(len(count)), count)
        nth = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
        return of, nth / np.maximum(count - 1, 1)[of]

    of, t = spread(length)
    straight = np.column_stack((lines[of, 0] + t * (lines[of, 2] - lines[of, 0]),
                                lines[of, 1] + t * (lines[of, 3] - lines[of, 1])))
    of, t = spread(np.abs(sweep) * np.maximum(radius, radius_to))
    angle, r = begin[of] + t * sweep[of], radius[of] + t * (radius_to - radius)[of]
    bent = np.column_stack((arcs[of, 4] + r * np.cos(angle), arcs[of, 5] + r * np.sin(angle)))
    return np.vstack((straight, bent))


def length_of(edges):
    total = 0.0
    for edge in edges:
        if len(edge) == 4:
            total += math.dist(edge[:2], edge[2:])
            continue
        begin, end = (math.atan2(edge[k + 1] - edge[5], edge[k] - edge[4]) for k in (0, 2))
        sweep = (end - begin if edge[6] else begin - end) % (2 * math.pi)
        if edge[:2] == edge[2:4]:
            sweep = 2 * math.pi
        total += sweep * math.dist(edge[:2], edge[4:6])
    return total


# What lekalo says.

def edge_of(edge):
    if 'line' in edge:
        return [*edge['line']['from'], *edge['line']['to']]
    arc = edge['arc']
    return [*arc['from'], *arc['to'], *arc['centre'], 1 if arc['ccw'] else 0]


def ring(points):
    return [[*a, *b] for a, b in zip(points, points[1:] + points[:1])]


def loops_of(outline):
    polygon = outline['polygon']
    loops = [ring(loop) for loop in [polygon['outer'], *polygon.get('holes', [])]]
    curves = outline.get('curves')
    if curves:
        loops += [[edge_of(edge) for edge in loop] for loop in [curves['outer'], *curves.get('holes', [])]]
    return loops


def curves_of(outline):
    curves = outline.get('curves')
    if not curves:
        return loops_of(outline)
    return [[edge_of(edge) for edge in loop] for loop in [curves['outer'], *curves.get('holes', [])]]


def layout_of(lekalo, path, work):
    """The layout that `lekalo new` makes of a drawing, and what it says; no layout where it refuses."""
    out = os.path.join(work, 'layout.json')
    done = subprocess.run([lekalo, 'new', '--part', path, '--strip', '1000', '-o', out], capture_output=True,
                          text=True, check=False)
    if done.returncode == 3:
        return None, done.stderr
    if done.returncode != 0:
        raise RuntimeError(f'{path}: exit {done.returncode}: {done.stderr}')
    with open(out, encoding='utf-8') as file:
        return json.load(file), done.stderr


def told_aside(says):
    more = re.search(r'set aside: (\d+) more', says)
    return len(re.findall(r'set aside: ', says)) - (1 if more else 0) + (int(more.group(1)) if more else 0)


def loss_of(says):
    """What the notice says, of which two digits are written."""
    said = re.search(r'outlines are within ([-+.e\d]+) mm of what is drawn', says)
    return 1.06 * float(said.group(1)) if said else 1e-5


# What others draw.

def svg_length(word):
    match = re.fullmatch(r'\s*([-+.eE\d]+)\s*([a-z%]*)\s*', word or '')
    scale = {'mm': 1, 'cm': 10, 'in': 25.4, 'pt': 25.4 / 72, 'pc': 25.4 / 6, 'q': 0.25, 'px': 25.4 / 96, '': 25.4 / 96}
    if not match or match.group(2).lower() not in scale:
        return None
    return float(match.group(1)) * scale[match.group(2).lower()]


def scale_of(transform):
    """How much a list of transforms enlarges, as the root of the area of a unit square."""
    scale = 1.0
    for word, numbers in re.findall(r'(\w+)\s*\(([^)]*)\)', transform or ''):
        n = [float(x) for x in re.findall(r'[-+.eE\d]+', numbers)]
        if word == 'matrix':
            scale *= math.sqrt(abs(n[0] * n[3] - n[1] * n[2]))
        elif word == 'scale':
            scale *= math.sqrt(abs(n[0] * n[-1]))
    return scale


class Svg:
    def __init__(self, path):
        text = open(path, 'rb').read()
        self.root = tree.fromstring(text)
        box = [float(x) for x in re.findall(r'[-+.eE\d]+', self.root.get('viewBox', ''))]
        width, height = svg_length(self.root.get('width')), svg_length(self.root.get('height'))
        if not box:
            box = [0, 0, width * 96 / 25.4, height * 96 / 25.4]
        self.box = box
        self.width = box[2] * 25.4 / 96 if width is None else width
        self.height = box[3] * 25.4 / 96 if height is None else height
        names = collections.Counter(element.tag.split('}')[-1] for element in self.root.iter()
                                    if isinstance(element.tag, str))
        self.left_out = {name: names[name] for name in ('text', 'image', 'foreignObject') if names[name]}
        self.extent = (0, 0), (self.width, self.height)

    def write(self, frame, path):
        """The drawing with strokes of one width everywhere, on a page with room for what lies beside its own."""
        def plain(text):
            return re.sub(r'stroke-width\s*:[^;}]*;?', '', text or '')

        def walk(element, width):
            element.attrib.pop('stroke-width', None)
            if element.get('style'):
                element.set('style', plain(element.get('style')))
            if isinstance(element.tag, str) and element.tag.endswith('style'):
                element.text = plain(element.text)
            if element.get('transform'):
                width /= scale_of(element.get('transform')) or 1
                element.set('stroke-width', f'{width:.9g}')
            for child in element:
                walk(child, width)

        per_unit = math.sqrt(self.width * self.height / (self.box[2] * self.box[3])) / frame.pixel
        walk(self.root, WIDTH / per_unit)
        corner = frame.pixels(np.array([[0, self.height]]))[0]
        self.root.attrib.update({
            'x': f'{corner[0]:.9g}', 'y': f'{corner[1]:.9g}', 'width': f'{self.width / frame.pixel:.12g}',
            'height': f'{self.height / frame.pixel:.12g}', 'viewBox': ' '.join(f'{x:.12g}' for x in self.box),
            'overflow': 'visible', 'stroke-width': f'{WIDTH / per_unit:.9g}'})
        page = tree.Element('{http://www.w3.org/2000/svg}svg',
                            {'width': str(frame.columns), 'height': str(frame.rows)})
        page.append(self.root)
        tree.ElementTree(page).write(path)


class Dxf:
    def __init__(self, path):
        from ezdxf import path as paths
        from ezdxf.addons.drawing import Frontend, RenderContext
        from ezdxf.addons.drawing.backend import Backend
        from ezdxf.addons.drawing.config import Configuration, HatchPolicy, LinePolicy, ProxyGraphicPolicy
        doc, scale = open_dxf(path)
        left_out, drawn = collections.Counter(), []

        class Lines(Backend):
            """Keeps the curves that the frontend draws."""

            def enter_entity(self, entity, properties):
                super().enter_entity(entity, properties)
                other = self.other()
                if other and other == self.entity_stack[-1][0].dxftype():
                    left_out[other] += 1

            def other(self):
                kinds = [entity.dxftype() for entity, _ in self.entity_stack]
                return next((kind for kind in kinds if kind not in CURVES and kind != 'INSERT'), None)

            def draw_path(self, path, properties):
                if not self.other():
                    drawn.append(path)

            def draw_line(self, start, end, properties):
                if not self.other():
                    drawn.append(paths.from_vertices([start, end]))

            def draw_point(self, pos, properties):
                pass

            def draw_filled_polygon(self, points, properties):
                pass

            def draw_filled_paths(self, paths, holes, properties):
                pass

            def draw_text(self, text, transform, properties, cap_height):
                pass

            def get_font_measurements(self, cap_height, font=None):
                from ezdxf.tools.fonts import FontMeasurements
                return FontMeasurements(0, cap_height, cap_height, cap_height / 4)

            def get_text_line_width(self, text, cap_height, font=None):
                return len(text) * cap_height

            def set_background(self, color):
                pass

            def clear(self):
                pass

        class Fine(Frontend):
            """Arcs in pieces of at most 12 degrees, so that their Bezier curves are exact to 1e-8 of the radius; lines
            with a width as their middle; splines whose knots are not clamped through points of theirs, because ezdxf
            0.18 draws other curves for them; what is seen at an angle is left out, as lekalo leaves it out."""

            def draw_entity(self, entity, properties):
                if entity.dxftype() in CURVES - {'LINE', 'SPLINE', 'MLINE'}:
                    extrusion = entity.dxf.get('extrusion', (0, 0, 1))
                    if abs(extrusion[0]) + abs(extrusion[1]) > 1e-9:
                        left_out[entity.dxftype() + ' (tilted)'] += 1
                        return
                super().draw_entity(entity, properties)

            def draw_curve_entity(self, entity, properties):
                if entity.dxftype() == 'SPLINE' and not entity.construction_tool().is_clamped:
                    self.out.draw_path(paths.from_vertices(entity.flattening(1e-4)), properties)
                else:
                    self.out.draw_path(paths.make_path(entity, segments=32), properties)

            def draw_polyline_entity(self, entity, properties):
                if entity.dxftype() == 'POLYLINE' and (entity.is_polygon_mesh or entity.is_poly_face_mesh):
                    left_out['mesh'] += 1
                    return
                self.out.draw_path(paths.make_path(entity, segments=32), properties)

        config = Configuration.defaults().with_changes(
            line_policy=LinePolicy.SOLID, hatch_policy=HatchPolicy.IGNORE,
            proxy_graphic_policy=ProxyGraphicPolicy.IGNORE)
        Fine(RenderContext(doc), Lines(), config).draw_layout(doc.modelspace())
        self.words = []
        corners = [], []
        for path in drawn:
            words = [('M', [path.start])]
            for command in path.commands():
                kind = command.type.name
                if kind == 'MOVE_TO':
                    words.append(('M', [command.end]))
                elif kind == 'LINE_TO':
                    words.append(('L', [command.end]))
                elif kind == 'CURVE3_TO':
                    words.append(('Q', [command.ctrl, command.end]))
                else:
                    words.append(('C', [command.ctrl1, command.ctrl2, command.end]))
            for _, points in words:
                corners[0].extend(p.x * scale for p in points)
                corners[1].extend(p.y * scale for p in points)
            self.words.append([(word, np.array([(p.x * scale, p.y * scale) for p in points])) for word, points in words])
        self.left_out = dict(left_out)
        self.extent = ((min(corners[0]), min(corners[1])), (max(corners[0]), max(corners[1]))) if drawn else None

    def write(self, frame, path):
        with open(path, 'w', encoding='utf-8') as file:
            file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{frame.columns}" height="{frame.rows}" '
                       f'stroke-width="{WIDTH}">\n')
            for words in self.words:
                data = ' '.join(word + ' '.join(f'{x:.4f}' for x in frame.pixels(points).ravel())
                                for word, points in words)
                file.write(f'<path d="{data}"/>\n')
            file.write('</svg>\n')


class Lines:
    """Lines and arcs of lekalo, to be drawn as those of a drawing are."""

    def __init__(self, lines):
        self.lines, self.width = lines, WIDTH

    def write(self, frame, path):
        words = []
        for edges, shift in self.lines:
            last = None
            for edge in edges:
                if edge[:2] != last:
                    words.append(('M', edge[:2], shift))
                words += [(word, point, shift) for word, point in self.steps(edge, frame.pixel)]
                last = edge[2:4]
        places = frame.pixels(np.array([point for _, point, _ in words]) + np.array([shift for *_, shift in words]))
        data = ' '.join(f'{word}{x:.4f} {y:.4f}' for (word, *_), (x, y) in zip(words, places))
        with open(path, 'w', encoding='utf-8') as file:
            file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{frame.columns}" height="{frame.rows}" '
                       f'stroke-width="{self.width:.6g}"><path d="{data}"/></svg>\n')

    @staticmethod
    def steps(edge, pixel):
        """Arcs in two halves, of which none is a whole turn."""
        if len(edge) == 4:
            return [('L', edge[2:4])]
        begin, end = (math.atan2(edge[k + 1] - edge[5], edge[k] - edge[4]) for k in (0, 2))
        sweep = (end - begin if edge[6] else begin - end) % (2 * math.pi)
        if edge[:2] == edge[2:4]:
            sweep = 2 * math.pi
        radius, half = math.dist(edge[:2], edge[4:6]), begin + (0.5 if edge[6] else -0.5) * sweep
        middle = [edge[4] + radius * math.cos(half), edge[5] + radius * math.sin(half)]
        arc = f'A{radius / pixel:.6f} {radius / pixel:.6f} 0 0 {0 if edge[6] else 1} '
        return [(arc, middle), (arc, edge[2:4])]


def raster(drawing, frame, work):
    svg, css, png = (os.path.join(work, name) for name in ('raster.svg', 'raster.css', 'raster.png'))
    drawing.write(frame, svg)
    with open(css, 'w', encoding='utf-8') as file:
        file.write(STYLE)
    subprocess.run(['rsvg-convert', '--unlimited', '-s', css, '-w', str(frame.columns), '-h', str(frame.rows), svg, '-o', png],
                   check=True, capture_output=True)
    with Image.open(png) as image:
        alpha = np.asarray(image.getchannel('A'))
    assert alpha.shape == (frame.rows, frame.columns)
    return alpha


def reached(free):
    """The free pixels that a way from the border of the raster leads to, along rows and columns."""
    def runs_of(free):
        begins = free.copy()
        begins[:, 1:] &= ~free[:, :-1]
        return np.cumsum(begins, dtype=np.int32).reshape(free.shape)

    rows, columns = runs_of(free), runs_of(np.ascontiguousarray(free.T)).T
    found = np.zeros_like(free)
    found[0], found[-1] = free[0], free[-1]
    before = None
    while not np.array_equal(found, before):
        before = found
        for runs in (rows, columns):
            hit = np.zeros(runs[-1, -1] + 1, bool)
            hit[runs[found]] = True
            found = free & hit[runs]
    return found


def enclosed(alpha):
    """How many pixels lines enclose, and how many are on their rim: of these as much counts as lines cover."""
    outside = reached(alpha == 0)
    near = np.zeros_like(outside)
    for axis in (0, 1):
        for way in (1, -1):
            near |= np.roll(outside, way, axis)
    rim = near & ~outside
    inner = alpha.size - int(outside.sum()) - int(rim.sum())
    return inner + int(alpha[rim].sum(dtype=np.int64)) / 255, int(rim.sum())


# The comparison.

class Piece:
    """A part as the layout has it, with its marks, at one of its places."""

    def __init__(self, part, points, shift, missing):
        self.part, self.points, self.shift, self.missing = part, points, shift, missing


def place_parts(layout, regions, frame, drawn, step, radius):
    """Where the parts lie: of the outlines with the same box those on which most of a part's points are drawn, of
    equally good ones those that are as long. Parts with most lines, marks among them, choose first, so that a plate
    without holes is not sought where one with holes lies."""
    boxes = []
    for region in regions:
        points = points_of(region, step)
        boxes.append((points.min(axis=0), points.max(axis=0), length_of(region)))
    free, pieces, unplaced = set(range(len(regions))), [], []
    parts = []
    for part in layout['parts']:
        outline = points_of(sum(loops_of(part['outline']), []), step)
        marks = points_of([edge_of(edge) for mark in part.get('marks', []) for edge in mark['edges']], step)
        polygon = part['outline']['polygon']
        length = sum(length_of(ring(loop)) for loop in [polygon['outer'], *polygon.get('holes', [])])
        parts.append((part, np.vstack((outline, marks)), outline.min(axis=0), outline.max(axis=0), length))
    for part, points, low, high, length in sorted(parts, key=lambda one: -len(one[1])):
        found = []
        for number in sorted(free):
            box = boxes[number]
            if np.abs((box[1] - box[0]) - (high - low)).max() > 0.05 + 2 * step:
                continue
            shift = (box[0] + box[1] - low - high) / 2
            if np.abs(shift).max() < 0.05 + 2 * step:
                shift = np.zeros(2)
            cells, outside = frame.cells(points + shift)
            missing = cells[~near_drawn(frame, drawn, cells, radius)]
            longer = round(abs(box[2] - length) / (0.1 + 0.002 * length))
            found.append((len(missing) + outside, longer, float(np.hypot(*shift)), number, shift, missing))
        found.sort(key=lambda one: one[:4])
        for _, _, _, number, shift, missing in found[:part['demand']]:
            free.discard(number)
            pieces.append(Piece(part, points, shift, missing))
        if len(found) < part['demand']:
            unplaced.append(f"{part['id']}: {len(found)} of {part['demand']}")
    return pieces, unplaced, free


def place_of(frame, cell):
    row, column = divmod(int(cell), frame.columns)
    return [round(frame.low[0] + (column - frame.margin + 0.5) * frame.pixel, 2),
            round(frame.high[1] - (row - frame.margin + 0.5) * frame.pixel, 2)]


def spoiled(layout, frame, drawn, step, radius):
    """Whether it is told that a part's longest edge is SPOILED beside itself: None where the loss and the pixels are
    too wide for that."""
    if radius * frame.pixel + 0.1 > SPOILED:
        return None
    part = max(layout['parts'], key=lambda one: len(one['outline']['polygon']['outer']))
    a, b, c, d = max(ring(part['outline']['polygon']['outer']), key=lambda e: math.dist(e[:2], e[2:]))
    aside = np.array([d - b, a - c]) / math.dist((a, b), (c, d)) * SPOILED
    told = []
    for side in (aside, -aside):
        cells, _ = frame.cells(points_of([[a, b, c, d]], step) + side)
        told.append(not near_drawn(frame, drawn, cells, radius).all())
    return any(told)


def compare_areas(lines, alpha, frame, work, width):
    """What the lines of the layout enclose against what the drawing's do, which may differ along them by `width`
    pixels; and whether it is told that all outlines are LARGER: None where `width` is too wide for that."""
    area, rim = enclosed(alpha)
    said = enclosed(raster(lines, frame, work))[0]
    larger = None
    if width * frame.pixel < LARGER / 2:
        lines.width = WIDTH + 2 * LARGER / frame.pixel
        larger = bool(abs(enclosed(raster(lines, frame, work))[0] - area) > rim * width)
    return {'area': round(said * frame.pixel ** 2, 2), 'area_off': round((said - area) * frame.pixel ** 2, 3),
            'area_may': round(rim * width * frame.pixel ** 2, 3), 'larger_told': larger}


def compare(lekalo, line, work):
    path = line['file']
    layout, says = layout_of(lekalo, path, work)
    if layout is None:
        return {'verdict': 'no layout'}
    drawing = (Svg if path.lower().endswith('.svg') else Dxf)(path)
    corners = [(edge[k], edge[k + 1]) for edges in line['regions'] + line['loose'] for edge in edges for k in (0, 2)]
    corners += [] if drawing.extent is None else list(drawing.extent)
    corners = np.array(corners)
    frame = Frame(corners.min(axis=0), corners.max(axis=0))
    alpha = raster(drawing, frame, work)
    drawn = alpha > 0
    step = 0.1 * frame.pixel
    loss = max(loss_of(says), line['loose_error'])
    wide = (loss + CHORD) / frame.pixel + SLACK
    pieces, unplaced, unused = place_parts(layout, line['regions'], frame, drawn, step, wide)
    off = np.unique(np.concatenate([piece.missing for piece in pieces] or [np.zeros(0, np.int64)]))
    cells = np.unique(np.concatenate([frame.cells(piece.points + piece.shift)[0] for piece in pieces]
                                     or [np.zeros(0, np.int64)]))
    ink = np.flatnonzero(drawn)
    in_parts = covered(frame, cells, wide + WIDTH / 2)
    aside, others = 0, [cells, frame.cells(points_of(line['specks'], step))[0]]
    for edges in line['loose'] + [line['regions'][number] for number in sorted(unused)]:
        own, _ = frame.cells(points_of(edges, step))
        others.append(own)
        aside += 0 if in_parts[own].all() else 1
    everywhere = covered(frame, np.unique(np.concatenate(others)), wide + WIDTH / 2)
    bare = ink[~everywhere[ink]]
    lost = None
    if pieces:
        # One piece less: its outline must be missed, where no other lies on it.
        largest = max(range(len(pieces)), key=lambda k: len(pieces[k].points))
        rest = np.unique(np.concatenate([frame.cells(piece.points + piece.shift)[0]
                                         for k, piece in enumerate(pieces) if k != largest] + others[1:]
                                        or [np.zeros(0, np.int64)]))
        lost = not covered(frame, rest, wide + WIDTH / 2)[ink].all()
    loose = [(edges, (0, 0)) for edges in line['loose'] + [line['regions'][number] for number in sorted(unused)]]
    lines = Lines([(loop, piece.shift) for piece in pieces for loop in curves_of(piece.part['outline'])] + loose)
    area = compare_areas(lines, alpha, frame, work, loss / frame.pixel + TWICE)
    return {'verdict': 'compared', 'pixel': round(frame.pixel, 4), 'pixels': int(len(ink)), 'loss': round(loss, 5),
            'pieces': len(pieces), 'unplaced': unplaced, 'aside': aside, 'told_aside': told_aside(says),
            'off': int(len(off)), 'off_at': [place_of(frame, cell) for cell in off[:3]],
            'bare': int(len(bare)), 'bare_at': [place_of(frame, cell) for cell in bare[:3]],
            'spoiled_told': spoiled(layout, frame, drawn, step, wide), 'lost_told': lost, **area,
            'left_out': drawing.left_out}


def main(lekalo, lines, work):
    for text in open(lines, encoding='utf-8'):
        line = json.loads(text)
        try:
            answer = compare(lekalo, line, work)
        except Exception as fault:  # one drawing that the others cannot read leaves the rest to be compared
            answer = {'verdict': 'not read', 'why': f'{type(fault).__name__}: {fault}'.replace('\n', ' ')}
        print(json.dumps({'file': line['file'], **answer}), flush=True)


if __name__ == '__main__':
    if len(sys.argv) == 2 and sys.argv[1] == 'probe':
        import ezdxf.addons.drawing  # noqa: F401  pylint: disable=unused-import
        sys.exit(subprocess.run(['rsvg-convert', '--version'], capture_output=True, check=False).returncode)
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
