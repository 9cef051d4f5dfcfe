#!/usr/bin/python3
"""Writes expected.json: what python3-svgelements (MIT, 1.7.2) reads in the drawings of this folder.

Parsing, transforms and the conversion of arcs are its; lengths and areas are integrated here from its segments, to
about 1e-13. Millimetres, y up. Run it again only when a drawing changes."""
import io, json, math, pathlib, re
import svgelements as s

HERE = pathlib.Path(__file__).parent
NODES = []  # Gauss-Legendre, 24 points, by Newton's method
for i in range(24):
    x = math.cos(math.pi * (i + 0.75) / 24.5)
    for _ in range(100):
        p0, p1 = 1.0, x
        for k in range(2, 25):
            p0, p1 = p1, ((2 * k - 1) * x * p1 - (k - 1) * p0) / k
        slope = 24 * (x * p1 - p0) / (x * x - 1)
        step = p1 / slope
        x -= step
        if abs(step) < 1e-16:
            break
    NODES.append((x, 2 / ((1 - x * x) * slope * slope)))


def curve(segment):
    """Point and derivative over [0, 1]."""
    c = complex
    if isinstance(segment, (s.Line, s.Close)):
        a, b = c(*segment.start), c(*segment.end)
        return lambda t: (a + t * (b - a), b - a)
    if isinstance(segment, s.QuadraticBezier):
        p = [c(*q) for q in (segment.start, segment.control, segment.end)]
        return lambda t: ((1 - t) ** 2 * p[0] + 2 * t * (1 - t) * p[1] + t * t * p[2],
                          2 * (1 - t) * (p[1] - p[0]) + 2 * t * (p[2] - p[1]))
    if isinstance(segment, s.CubicBezier):
        p = [c(*q) for q in (segment.start, segment.control1, segment.control2, segment.end)]
        return lambda t: ((1 - t) ** 3 * p[0] + 3 * t * (1 - t) ** 2 * p[1] + 3 * t * t * (1 - t) * p[2] + t ** 3 * p[3],
                          3 * ((1 - t) ** 2 * (p[1] - p[0]) + 2 * t * (1 - t) * (p[2] - p[1]) + t * t * (p[3] - p[2])))
    assert isinstance(segment, s.Arc), segment
    o = c(*segment.center)
    u, v = c(*segment.prx) - o, c(*segment.pry) - o
    d = c(*segment.start) - o  # the parameter at the start: d = cos(a) u + sin(a) v
    det = u.real * v.imag - u.imag * v.real
    begin = math.atan2((u.real * d.imag - u.imag * d.real) / det, (d.real * v.imag - d.imag * v.real) / det)
    sweep = segment.sweep * (1 if det > 0 else -1)
    return lambda t: (o + math.cos(begin + t * sweep) * u + math.sin(begin + t * sweep) * v,
                      sweep * (math.cos(begin + t * sweep) * v - math.sin(begin + t * sweep) * u))


def gauss(f, page, low, high):
    length = area = 0.0
    for x, w in NODES:
        p, d = f(0.5 * (low + high) + 0.5 * (high - low) * x)
        length += w * abs(d) * (high - low) / 2
        area += w * (p.real * -d.imag - (page - p.imag) * d.real) * (high - low) / 4
    return length, area


def measure(f, page, low=0.0, high=1.0, depth=0):
    """Length, and the area swept as seen from the lower left corner of the page, y up. Halved until that changes nothing:
    Bezier curves may have a cusp, or nearly one."""
    whole, middle = gauss(f, page, low, high), 0.5 * (low + high)
    left, right = gauss(f, page, low, middle), gauss(f, page, middle, high)
    if depth > 2 and (abs(left[0] + right[0] - whole[0]) < 1e-13 * (1 + whole[0]) or depth > 30):
        return left[0] + right[0], left[1] + right[1]
    left, right = measure(f, page, low, middle, depth + 1), measure(f, page, middle, high, depth + 1)
    return left[0] + right[0], left[1] + right[1]


def page_of(text):
    """The drawing with a page of viewBox units (svgelements takes 0.0393701 inch for a millimetre), and what these are."""
    root = re.search(r"<svg\b[^>]*>", text).group(0)
    size = {key: re.search(key + r'="([\d.]+)([a-z]*)"', root) for key in ("width", "height")}
    box = [float(v) for v in re.search(r'viewBox="([^"]*)"', root).group(1).split()]
    per = {"mm": 1, "px": 25.4 / 96}[size["width"].group(2)]
    mm = float(size["width"].group(1)) * per / box[2]
    assert abs(float(size["height"].group(1)) * per - mm * box[3]) < 1e-12 * mm * box[3]
    plain = root
    for key, value in (("width", box[2]), ("height", box[3])):
        plain = plain.replace(size[key].group(0), f'{key}="{value!r}"')
    return text.replace(root, plain), mm, box[3]


def entities_of(text):
    text, mm, page = page_of(text)
    svg = s.SVG.parse(io.StringIO(text), reify=True, ppi=96)
    entities = []
    for element in svg.elements():
        if not isinstance(element, s.Shape):
            continue
        path = abs(s.Path(element))
        length = area = 0.0
        first = last = None
        curves = 0
        for segment in path:
            if isinstance(segment, s.Move) or segment.start is None or segment.end is None:
                continue
            if isinstance(segment, (s.Line, s.Close)) and abs(complex(*segment.end) - complex(*segment.start)) < 1e-9:
                continue
            one, part = measure(curve(segment), page)
            length += one
            area += part
            curves += 1
            first = segment.start if first is None else first
            last = segment.end
        if curves == 0:
            continue
        up = lambda p: [p[0] * mm, (page - p[1]) * mm]
        entities.append({"id": element.id or "", "curves": curves, "length": length * mm, "first": up(first), "last": up(last),
                         "area": area * mm * mm})
    return entities


if __name__ == "__main__":
    expected = {file.name: entities_of(file.read_text()) for file in sorted(HERE.glob("*.svg"))}
    (HERE / "expected.json").write_text(json.dumps(expected, indent=1) + "\n")
