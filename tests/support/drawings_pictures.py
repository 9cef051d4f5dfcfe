#!/usr/bin/env python3
"""Pictures to compare by eye: on the left an SVG drawing as rsvg-convert draws it, on the right the parts of the
layout that `lekalo new` writes, in the place where the drawing has the first of each, with their number. Material is
coloured, holes are white, marks are red.

    drawings_pictures.py LEKALO FOLDER OUT [COUNT [SEED]]   COUNT drawings of FOLDER, drawn by SEED (9 by 20)
    drawings_pictures.py LEKALO FOLDER OUT NAME...          the drawings of these names
    drawings_pictures.py LEKALO FOLDER OUT looked           those that were looked at before

OUT gets NAME.png for each. A line for each says how many pieces and holes the layout has. docs/measurements/
drawing-regions.md has what was seen; LOOKED are the drawings that were looked at before.
"""
import json
import os
import random
import re
import subprocess
import sys

LOOKED = {'Arcade', 'BottleTag', 'Console', 'FanHole', 'GridfinityBaseSplit_d854b1ea', 'GridfinityBase_2537f05a',
          'GridfinityTrayLayout_117f6735', 'HobbyCase', 'Lamp', 'OttoSoles', 'PaperBox', 'Platonic',
          'UnevenHeightBox'}
COLOURS = ['#9ecae1', '#a1d99b', '#fdd0a2', '#dadaeb', '#fdae6b', '#c7e9c0', '#bcbddc', '#d9d9d9']


def chosen(folder, words):
    names = sorted(name[:-4] for name in os.listdir(folder) if name.endswith('.svg'))
    if words == ['looked']:
        return sorted(LOOKED)
    if words and not words[0].isdigit():
        return words
    count = int(words[0]) if words else 9
    seed = int(words[1]) if len(words) > 1 else 20
    return sorted(random.Random(seed).sample([name for name in names if name not in LOOKED], count))


def loop(points):
    return 'M' + ' L'.join(f'{x:.3f} {-y:.3f}' for x, y in points) + 'Z'


def mark(edges):
    words, last = [], None
    for edge in edges:
        kind = 'line' if 'line' in edge else 'arc'
        a, b = edge[kind]['from'], edge[kind]['to']
        if a != last:
            words.append(f'M{a[0]:.3f} {-a[1]:.3f}')
        if kind == 'line' or a == b:
            words.append(f'L{b[0]:.3f} {-b[1]:.3f}')
        else:
            c = edge['arc']['centre']
            cross = (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0])
            ccw = edge['arc']['ccw']
            radius = ((a[0] - c[0]) ** 2 + (a[1] - c[1]) ** 2) ** 0.5
            words.append(f'A{radius:.4f} {radius:.4f} 0 {int((cross < 0) == ccw)} {int(not ccw)} {b[0]:.3f} {-b[1]:.3f}')
        last = b
    return ' '.join(words)


def picture(lekalo, path, out):
    layout_file, svg_file = out + '.json', out + '.svg'
    subprocess.run([lekalo, 'new', '--part', path, '--strip', '1000', '-o', layout_file], check=True,
                   capture_output=True)
    with open(layout_file, encoding='utf-8') as file:
        layout = json.load(file)
    with open(path, encoding='utf-8') as file:
        text = file.read()
    root = re.search(r'<svg[^>]*>', text)
    body = text[root.end():text.rindex('</svg>')]
    width, height = (float(re.search(rf'\b{name}="([\d.]+)mm"', root.group()).group(1)) for name in ('width', 'height'))
    box = re.search(r'viewBox="([^"]+)"', root.group()).group(1)
    spaces = ' '.join(re.findall(r'xmlns(?::\w+)?="[^"]+"', root.group()))
    wide = 1.5 if height < 1.2 * width else 1
    lines = [f'<svg {spaces} width="{1000 * wide}" height="{1000 * wide * height / (2 * width + 10):.0f}" '
             f'viewBox="0 0 {2 * width + 10} {height}"><rect width="100%" height="100%" fill="#fff"/>',
             f'<svg width="{width}" height="{height}" viewBox="{box}">', body, '</svg>',
             f'<g transform="translate({width + 10} {height})">']
    pieces = holes = marks = 0
    for number, part in enumerate(layout['parts']):
        polygon = part['outline']['polygon']
        loops = [polygon['outer'], *polygon.get('holes', [])]
        pieces += part['demand']
        holes += part['demand'] * (len(loops) - 1)
        marks += part['demand'] * len(part.get('marks', []))
        lines.append(f'<path d="{" ".join(map(loop, loops))}" fill="{COLOURS[number % len(COLOURS)]}" '
                     f'fill-rule="evenodd" stroke="#000" stroke-width="{width / 1500:.3f}"/>')
        lines += [f'<path d="{mark(one["edges"])}" fill="none" stroke="#d00" stroke-width="{width / 1500:.3f}"/>'
                  for one in part.get('marks', [])]
        x, y = (sum(p[k] for p in polygon['outer']) / len(polygon['outer']) for k in (0, 1))
        spans = [max(p[k] for p in polygon['outer']) - min(p[k] for p in polygon['outer']) for k in (0, 1)]
        size = min(width / 60, max(spans) / 6)
        said = f'{part["demand"]} x, ' if part['demand'] > 1 else ''
        lines.append(f'<text x="{x:.2f}" y="{-y:.2f}" font-size="{size:.2f}" text-anchor="middle">{said}'
                     f'{len(loops) - 1} h</text>')
    lines.append('</g></svg>')
    with open(svg_file, 'w', encoding='utf-8') as file:
        file.write('\n'.join(lines))
    subprocess.run(['rsvg-convert', '--unlimited', svg_file, '-o', out + '.png'], check=True)
    os.remove(layout_file)
    os.remove(svg_file)
    return pieces, holes, marks


def main(lekalo, folder, out, words):
    os.makedirs(out, exist_ok=True)
    for name in chosen(folder, words):
        pieces, holes, marks = picture(lekalo, os.path.join(folder, name + '.svg'), os.path.join(out, name))
        print(f'{name}: {pieces} pieces, {holes} holes, {marks} marks', flush=True)


if __name__ == '__main__':
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:4], sys.argv[4:])
