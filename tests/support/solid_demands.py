"""The triangles of a file of features for solids, and what they demand, written from docs/formats.md alone."""
from exact_solids import F, dot, normal, squared_distance, sub, times

UNITS = {"mm": F(1), "inch": F(254, 10), "m": F(1000)}

def patch(point, mesh):
    def turn_less(a, b):  # than 30 degrees
        m, n = normal(a), normal(b)
        return dot(m, n) > 0 and 4 * dot(m, n) ** 2 > 3 * dot(m, m) * dot(n, n)
    def edges(t): return {frozenset((tuple(t[k - 1]), tuple(t[k]))) for k in range(3)}
    far = [squared_distance(point, t) for t in mesh]
    found, open_ = set(), [far.index(min(far))]
    while open_:
        f = open_.pop()
        if f in found: continue
        found.add(f)
        open_ += [g for g in range(len(mesh)) if edges(mesh[f]) & edges(mesh[g]) and turn_less(mesh[f], mesh[g])]
    return found

def triangles_of(feature, unit, mesh):
    def all_corners(holds): return {f for f, t in enumerate(mesh) if all(holds(p) for p in t)}
    def at_most(x, y, square):  # x <= y root(square)
        return (x <= 0 or x * x <= y * y * square) if y >= 0 else x < 0 and x * x >= y * y * square
    if "triangles" in feature: return {int(f) for f in feature["triangles"]}
    if "patch" in feature: return patch([x * unit for x in feature["patch"]], mesh)
    if "box" in feature:
        low, high = ([x * unit for x in corner] for corner in feature["box"])
        return all_corners(lambda p: all(a <= x <= b for a, x, b in zip(low, p, high)))
    n, at, off = feature["plane"]["normal"], feature["plane"]["at"] * unit, feature["plane"]["within"] * unit
    return all_corners(lambda p: at_most(dot(n, p), at + off, dot(n, n)) and at_most(-dot(n, p), off - at, dot(n, n)))

def demands(file, mesh, least):
    """Of each triangle (minimum, scale), or None; a demand is the double nearest to it."""
    unit = UNITS[file.get("units", "mm")]
    def mm(x): return F(float(unit) * float(x))
    others = None if file.get("as_cast") else (max(mm(file.get("minimum", 0)), F(float(least))), F(1))
    of = [others] * len(mesh)
    for feature in file.get("features", []):
        one = None if feature.get("as_cast") or feature.get("finished") is not None else (mm(feature.get("minimum", 0)), F(float(feature.get("scale", 1))))
        for f in triangles_of(feature, unit, mesh): of[f] = one
    return of

def maxima(file, mesh):
    """Of each triangle how far its points may be from the blank's surface, the double nearest to it, or None."""
    unit, of = UNITS[file.get("units", "mm")], [None] * len(mesh)
    for feature in file.get("features", []):
        most = feature.get("maximum") if feature.get("finished") is None else feature["finished"]
        if most is not None:
            for f in triangles_of(feature, unit, mesh): of[f] = F(float(unit) * float(most))
    return of

def datums(file, mesh):
    """Of each datum what it lies on, the double nearest to its tolerance, and its points by their numbers."""
    unit, made = UNITS[file.get("units", "mm")], []
    def mm(p): return [x * unit for x in p]
    for datum in file.get("datums", []):
        on = next(word for word in ("plane", "axis", "point") if word in datum)
        place = datum[on] if on != "point" else {"through": datum[on]}
        points = dict(enumerate(mm(p) for p in datum.get("points", [])))
        for feature in file.get("features", []):
            if feature["name"] == datum.get("feature"):
                points.update((3 * f + k, mesh[f][k]) for f in triangles_of(feature, unit, mesh) for k in range(3))
        made.append({"on": on, "through": mm(place["through"]), "points": points, "direction":
                     place.get("normal") or place.get("along"), "within": F(float(unit) * float(datum["within"]))})
    return made

def straight_off(datum, way):
    n = datum["direction"]
    along = n and times(n, dot(way, n) / dot(n, n))
    return {"plane": along, "axis": n and sub(way, along), "point": way}[datum["on"]]
