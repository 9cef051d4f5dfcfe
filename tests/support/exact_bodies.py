"""Bodies that stay away from a surface, in fractions, for what holds claims about solids against docs/formats.md."""
from exact_solids import cross, dot, normal, plus, root, sign, squared_distance, sub, times

def of_segments(a, b, c, d):
    """The least squared distance of the segments a b and c d; exact of fractions."""
    u, v, w = sub(b, a), sub(d, c), sub(a, c)
    uu, uv, vv, uw, vw = dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)
    found = []
    det = uu * vv - uv * uv
    if det > 0:
        s, t = (uv * vw - vv * uw) / det, (uu * vw - uv * uw) / det
        if 0 <= s <= 1 and 0 <= t <= 1:
            found.append(plus(w, sub(times(u, s), times(v, t))))
    # Else the nearest points are at an end of one of them.
    for p, e, way in ((sub(a, c), v, 1), (sub(b, c), v, 1), (sub(c, a), u, 1), (sub(d, a), u, 1)):
        square = dot(e, e)
        t = min(max(dot(p, e) / square, 0), 1) if square else 0
        found.append(sub(p, times(e, t)))
    return min(dot(x, x) for x in found)

def sides(row):
    """Of each side a direction n of length 1 into the body, and n . q of its points q."""
    edges, made = [row[k:k + 3] for k in (3, 6, 9)], []
    for k in range(3):
        n = cross(edges[k - 2], edges[k - 1])
        n = times(n, sign(dot(n, edges[k])) / (root(dot(n, n)) or 1))
        made += [(n, dot(n, row[:3])), (times(n, -1), -dot(n, plus(row[:3], edges[k])))]
    return made

def corners(row):
    """Corner k is at the end of the first, second and third edge as the bits of k say."""
    def at(k, axis): return row[axis] + sum(row[3 + 3 * e + axis] for e in range(3) if k >> e & 1)
    return [[at(k, axis) for axis in range(3)] for k in range(8)]

def meets(a, b, planes):
    """Says if the way from a to b comes to where n . p >= least for all planes."""
    low, high = 0, 1
    for n, least in planes:
        at, to = dot(n, a) - least, dot(n, b) - least
        if at < 0 and to < 0:
            return False
        if at < 0:
            low = max(low, at / (at - to))
        elif to < 0:
            high = min(high, at / (at - to))
    return low <= high

def crosses(a, b, t):
    n = normal(t)
    above, below = dot(n, sub(a, t[0])), dot(n, sub(b, t[0]))
    if above * below > 0 or above == below:
        return False
    p = plus(a, times(sub(b, a), above / (above - below)))
    return all(dot(cross(n, sub(t[k - 2], t[k])), sub(p, t[k])) >= 0 for k in range(3))

def fault_of_body(row, surface):
    """Says what is wrong with a body that is to be row[12] away from all triangles of a surface."""
    at, planes, square = corners(row), sides(row), row[12] ** 2
    if not all(any(n) for n, _ in planes) or row[12] <= 0:
        return "it is none"
    edges = [(at[k], at[k | 1 << e]) for e in range(3) for k in range(8) if not k >> e & 1]
    faces = [[at[k], at[k | 1 << e], at[k | 1 << e | 1 << g]] for k in range(8) for e in range(3) for g in range(3)
             if e != g and not k >> e & 1 and not k >> g & 1]
    box = [(min(x), max(x)) for x in zip(*at)]
    for t in surface:
        if sum(max(low - max(x), min(x) - high, 0) ** 2 for x, (low, high) in zip(zip(*t), box)) >= square:
            continue
        ways = [(t[k - 1], t[k]) for k in range(3)]
        if any(meets(a, b, planes) for a, b in ways) or any(crosses(a, b, t) for a, b in edges):
            return "a triangle is in it"
        if min([squared_distance(p, t) for p in at] + [squared_distance(p, f) for p in t for f in faces] +
               [of_segments(*way, *edge) for way in ways for edge in edges]) < square:
            return "a triangle is nearer"
    return None
