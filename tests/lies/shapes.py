"""Regions of lines and arcs with 60 digits: how far two outlines are apart, and how deep a point lies."""

import math

from exact import D, number, turn


class Edge:
    """A line, or an arc of the circle about its centre with the mean radius of its ends."""

    def __init__(self, item):
        self.arc = "arc" in item
        body = item["arc" if self.arc else "line"]
        self.a, self.b = (tuple(map(number, body[k])) for k in ("from", "to"))
        self.full = self.a == self.b
        if self.arc:
            self.c = tuple(map(number, body["centre"]))
            self.ccw = body["ccw"]
            self.r = (apart(self.a, self.c) + apart(self.b, self.c)) / 2

    def moved(self, motion):
        made = Edge.__new__(Edge)
        made.arc, made.full = self.arc, self.full
        made.a, made.b = motion(self.a), motion(self.b)
        if self.arc:
            made.c, made.r = motion(self.c), self.r
            made.ccw = self.ccw != motion.mirrored
        return made

    def faces(self, d):
        """A direction from the centre meets the arc."""
        if self.full:
            return True
        u, v = minus(self.a, self.c), minus(self.b, self.c)
        if not self.ccw:
            u, v = v, u
        if cross(u, v) > 0 or (cross(u, v) == 0 and dot(u, v) > 0):
            return cross(u, d) >= 0 and cross(d, v) >= 0
        return not (cross(v, d) > 0 and cross(d, u) > 0)

    def points(self):
        """The ends, on the circle itself where it is an arc."""
        if not self.arc:
            return [self.a, self.b]
        return [on_circle(self, minus(p, self.c)) for p in (self.a, self.b)]

    def extremes(self):
        """The points that reach farthest along the axes."""
        if not self.arc:
            return [self.a, self.b]
        ways = [(D(1), D(0)), (D(0), D(1)), (D(-1), D(0)), (D(0), D(-1))]
        return self.points() + [on_circle(self, d) for d in ways if self.faces(d)]


class Motion:
    def __init__(self, x, y, theta, mirrored=False):
        self.cos_sin, self.shift, self.mirrored = turn(theta), (number(x), number(y)), mirrored

    def __call__(self, p):
        (c, s), x = self.cos_sin, -p[0] if self.mirrored else p[0]
        return c * x - s * p[1] + self.shift[0], s * x + c * p[1] + self.shift[1]


def minus(p, q):
    return p[0] - q[0], p[1] - q[1]


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1]


def cross(u, v):
    return u[0] * v[1] - u[1] * v[0]


def length(u):
    return dot(u, u).sqrt()


def apart(p, q):
    return length(minus(p, q))


def on_circle(arc, d):
    size = length(d)
    return arc.c[0] + arc.r * d[0] / size, arc.c[1] + arc.r * d[1] / size


def to_edge(p, edge):
    """The distance of a point from a line or an arc."""
    if not edge.arc:
        u = minus(edge.b, edge.a)
        square = dot(u, u)
        t = min(max(dot(minus(p, edge.a), u) / square, D(0)), D(1)) if square else D(0)
        return apart(p, (edge.a[0] + t * u[0], edge.a[1] + t * u[1]))
    d = minus(p, edge.c)
    if d == (0, 0) or edge.faces(d):
        return abs(length(d) - edge.r)
    return min(apart(p, q) for q in edge.points())


def between(e, f):
    """The distance of two edges that do not cross."""
    found = [to_edge(p, f) for p in e.points()] + [to_edge(p, e) for p in f.points()]
    for one, other in ((e, f), (f, e)):
        if not one.arc:
            continue
        if other.arc:
            way = minus(other.c, one.c)
            if way != (0, 0):
                found += [to_edge(on_circle(one, (s * way[0], s * way[1])), other) for s in (1, -1)
                          if one.faces((s * way[0], s * way[1]))]
            continue
        u = minus(other.b, other.a)
        t = dot(minus(one.c, other.a), u) / dot(u, u)
        if 0 <= t <= 1:
            way = minus((other.a[0] + t * u[0], other.a[1] + t * u[1]), one.c)
            found += [to_edge(on_circle(one, (s * way[0], s * way[1])), other) for s in (1, -1)
                      if way != (0, 0) and one.faces((s * way[0], s * way[1]))]
    return min(found)


def contours_of(region):
    pieces = region["pieces"] if "pieces" in region else [region]
    return [[Edge(e) for e in contour] for piece in pieces for contour in [piece["outer"]] + piece.get("holes", [])]


def edges_of(region):
    return [edge for contour in contours_of(region) for edge in contour]


def box_around(edge):
    """A box in doubles in which an edge lies with room for roundings; of an arc that of its whole circle."""
    if edge.arc:
        low, high = [c - edge.r for c in edge.c], [c + edge.r for c in edge.c]
    else:
        low, high = map(min, edge.a, edge.b), map(max, edge.a, edge.b)
    return [(float(l) - 1e-9 * (1 + abs(float(l))), float(h) + 1e-9 * (1 + abs(float(h)))) for l, h in zip(low, high)]


def distance(edges, others):
    """The least distance of two outlines. Edges whose boxes are farther apart than what was found are not looked at."""
    boxes = [list(map(box_around, outline)) for outline in (edges, others)]
    pairs = sorted((math.hypot(*(max(l - high, low - h, 0.0) for (low, high), (l, h) in zip(a, b))), i, j)
                   for i, a in enumerate(boxes[0]) for j, b in enumerate(boxes[1]))
    least = between(edges[pairs[0][1]], others[pairs[0][2]])
    for apart_at_least, i, j in pairs[1:]:
        if apart_at_least > least:
            break
        least = min(least, between(edges[i], others[j]))
    return least


def is_inside(p, edges):
    """A point that is on no edge is inside: its ray to the right meets an odd number of them."""
    crossings = 0
    for edge in edges:
        if not edge.arc:
            if (edge.a[1] > p[1]) != (edge.b[1] > p[1]):
                x = edge.a[0] + (p[1] - edge.a[1]) * (edge.b[0] - edge.a[0]) / (edge.b[1] - edge.a[1])
                crossings += x > p[0]
            continue
        dy = p[1] - edge.c[1]
        if abs(dy) >= edge.r:
            continue
        half = (edge.r * edge.r - dy * dy).sqrt()
        crossings += sum(edge.c[0] + dx > p[0] and edge.faces((dx, dy)) for dx in (half, -half))
    return crossings % 2 == 1


def depth(p, edges):
    """The distance of a point from an outline, positive inside."""
    off = min(to_edge(p, edge) for edge in edges)
    return off if is_inside(p, edges) else -off


def box_of(edges):
    """The sides of the box around an outline."""
    points = [p for edge in edges for p in edge.extremes()]
    return [max(p[k] for p in points) - min(p[k] for p in points) for k in (0, 1)]


class Cover:
    """The certificate of a placement of regions: balls and boxes of poses (docs/formats.md, "Results for regions")."""

    def __init__(self, part, blank, pivot):
        self.part, self.blank, self.pivot = part, blank, tuple(map(float, pivot))
        self.known_depths = {}

    def leaves(self, tree):
        """Every leaf with its box, or None where the nodes do not make up a subdivision."""
        boxes = [(tree["theta"], tree["x"], tree["y"])]
        made = []
        for node in tree["nodes"]:
            if not boxes:
                return None
            box = boxes.pop()
            if isinstance(node, dict):
                made.append((node["contacts"], box))
                continue
            k = ("theta", "x", "y").index(node[0])
            low, high = list(box), list(box)
            low[k], high[k] = [box[k][0], node[1]], [node[1], box[k][1]]
            boxes += [tuple(high), tuple(low)]
        return None if boxes else made

    def radius(self, x, y, r, edges, sign):
        """As much of a ball as lies in the material of the part, or in none of the blank's."""
        key = (x, y, sign, edges is self.part)
        if key not in self.known_depths:
            self.known_depths[key] = float(sign * depth((number(x), number(y)), edges))
        return min(r, self.known_depths[key])

    def term(self, contact):
        """Centre, radii together, other centre, multiplier, and what the clearance is at least where c is in the part."""
        a, b, r, c, d, s, m = contact
        blank = self.radius(c, d, s, self.blank, -1)
        return a, b, self.radius(a, b, r, self.part, 1) + blank, c, d, m, -blank

    def proves(self, contacts, box, mirrored, bound):
        """No pose of the box has more clearance than `bound`, by the balls of a leaf."""
        whole = sum(c[6] for c in contacts)
        if whole <= 0 or any(c[6] < 0 or c[2] < 0 or c[5] < 0 for c in contacts):
            return False
        found = [self.term(c) for c in contacts if c[6] > 0]
        if any(floor > bound for *_, floor in found):
            return False
        terms = [((-1 if mirrored else 1) * (a - self.pivot[0]), b - self.pivot[1], off, c, d, m / whole)
                 for a, b, off, c, d, m, _ in found]
        slope = sum(m * math.hypot(u, v) for u, v, *_, m in terms)

        def value(theta, x, y):
            cosine, sine = math.cos(theta), math.sin(theta)
            return sum(m * (math.hypot(cosine * u - sine * v + x - c, sine * u + cosine * v + y - d) - off)
                       for u, v, off, c, d, m in terms)

        # In (x, y) the sum is convex, so its largest value is in a corner; along theta it is halved.
        for x in box[1]:
            for y in box[2]:
                open_ends = [(box[0][0], box[0][1])]
                while open_ends:
                    low, high = open_ends.pop()
                    at = value((low + high) / 2, x, y)
                    if at + slope * (high - low) / 2 <= bound:
                        continue
                    if at > bound or high - low < 1e-9:
                        return False
                    open_ends += [(low, (low + high) / 2), ((low + high) / 2, high)]
        return True
