#!/usr/bin/env python3
"""What others find in DXF drawings, as one JSON object on stdout: file -> listing.

  dxf_oracle.py ezdxf FILE...   curves of the model space, blocks and arrays expanded, by type and effective layer:
                                [{"type", "layer", "curves", "length", "x", "y", "area"}], drawing units; x and y are
                                integrals of the coordinates along the curves, area is that of (x dy - y dx) / 2
  dxf_oracle.py ogr FILE...     lines of the model space, by layer: [{"layer", "length", "box"}]; null where OGR does not
                                open the file
  dxf_oracle.py probe NAME      exit status 0 when NAME (ezdxf or ogr) is installed

Nothing here knows how lekalo reads a file: ezdxf gives the entities, the planes of their coordinates, the matrices of
insertions, the arcs of bulges and the points of splines.
"""
import json
import math
import sys

GAUSS = [(0.1834346424956498, 0.3626837833783620), (0.5255324099163290, 0.3137066458778873),
         (0.7966664774136267, 0.2223810344533745), (0.9602898564975363, 0.1012285362903763)]


def integrals(point, begin, end, pieces):
    """length, x, y, area of a curve; the derivative by a central difference of eighth order."""
    total = [0.0, 0.0, 0.0, 0.0]
    step = (end - begin) / pieces
    for k in range(pieces):
        middle, half = begin + (k + 0.5) * step, 0.5 * step
        for node, weight in GAUSS:
            for t in (middle - node * half, middle + node * half):
                x, y = point(t)
                # Steps stay inside of the piece, where the curve is smooth.
                h = min(t - (middle - half), (middle + half) - t) / 4
                dx = dy = 0.0
                for i, c in ((1, 4 / 5), (2, -1 / 5), (3, 4 / 105), (4, -1 / 280)):
                    ahead, behind = point(t + i * h), point(t - i * h)
                    dx += c * (ahead[0] - behind[0]) / h
                    dy += c * (ahead[1] - behind[1]) / h
                speed = math.hypot(dx, dy) * weight * abs(half)
                total[0] += speed
                total[1] += x * speed
                total[2] += y * speed
                total[3] += (x * dy - y * dx) / 2 * weight * half
    return total


class Listing:
    def __init__(self):
        self.found = {}

    def add(self, entity, layer, curves):
        entry = self.found.setdefault((entity.dxftype(), layer), [0, 0.0, 0.0, 0.0, 0.0])
        for point, begin, end, pieces in curves:
            entry[0] += 1
            for k, value in enumerate(integrals(point, begin, end, pieces)):
                entry[k + 1] += value

    def json(self):
        names = ("curves", "length", "x", "y", "area")
        return [dict(zip(("type", "layer") + names, key + tuple(entry))) for key, entry in sorted(self.found.items())]


def straight(a, b):
    return (lambda t: a + (b - a) * t, 0.0, 1.0, 1)


def round_arc(ocs, centre, radius, begin, end, z):
    from ezdxf.math import Vec3

    def point(t):
        return ocs.to_wcs(Vec3(centre.x + radius * math.cos(t), centre.y + radius * math.sin(t), z))
    return (point, begin, end, 12)


def polyline_curves(points, closed, ocs, z):
    """points: x, y, bulge in the plane of the polyline."""
    from ezdxf.math import Vec2, Vec3, bulge_to_arc
    pairs = list(zip(points, points[1:]))
    if closed and len(points) > 1:
        pairs.append((points[-1], points[0]))
    for (ax, ay, bulge), (bx, by, _) in pairs:
        if (ax, ay) == (bx, by):
            continue
        if bulge == 0:
            yield straight(ocs.to_wcs(Vec3(ax, ay, z)), ocs.to_wcs(Vec3(bx, by, z)))
            continue
        centre, begin, end, radius = bulge_to_arc((ax, ay), (bx, by), bulge)
        if end <= begin:
            end += 2 * math.pi
        # The arc runs counter-clockwise; a polyline with a negative bulge runs along it backwards.
        if bulge < 0:
            begin, end = end, begin
        yield round_arc(ocs, Vec2(centre), radius, begin, end, z)


def curves_of(entity):
    kind = entity.dxftype()
    dxf = entity.dxf
    if kind == "LINE":
        yield straight(dxf.start, dxf.end)
    elif kind == "CIRCLE":
        yield round_arc(entity.ocs(), dxf.center, dxf.radius, 0, 2 * math.pi, dxf.center.z)
    elif kind == "ARC":
        begin = math.radians(dxf.start_angle)
        sweep = math.radians(dxf.end_angle) - begin
        sweep = math.fmod(sweep, 2 * math.pi)
        if sweep <= 1e-14:
            sweep += 2 * math.pi
        yield round_arc(entity.ocs(), dxf.center, dxf.radius, begin, begin + sweep, dxf.center.z)
    elif kind == "ELLIPSE":
        begin, end = dxf.start_param, dxf.end_param
        while end <= begin + 1e-9:
            end += 2 * math.pi
        centre, major, minor = dxf.center, dxf.major_axis, entity.minor_axis
        yield (lambda t: centre + major * math.cos(t) + minor * math.sin(t), begin, end, 64)
    elif kind == "LWPOLYLINE":
        yield from polyline_curves(entity.get_points("xyb"), entity.closed, entity.ocs(), dxf.elevation)
    elif kind == "POLYLINE" and entity.is_2d_polyline:
        vertices = [v for v in entity.vertices if not v.dxf.flags & 16]
        points = [(v.dxf.location.x, v.dxf.location.y, v.dxf.get("bulge", 0)) for v in vertices]
        yield from polyline_curves(points, entity.is_closed, entity.ocs(), dxf.elevation.z if dxf.hasattr("elevation") else 0)
    elif kind == "POLYLINE" and entity.is_3d_polyline:
        points = [v.dxf.location for v in entity.vertices if not v.dxf.flags & 16]
        ring = points[1:] + points[:1] if entity.is_closed else points[1:]
        for a, b in zip(points, ring):
            yield straight(a, b)
    elif kind == "SPLINE" and entity.control_point_count() > 0:  # of fit points ezdxf makes a spline of its own
        spline = entity.construction_tool()
        knots = list(spline.knots())
        degree, count = spline.degree, spline.count
        spans = sorted(set(knots[degree:count + 1]))
        for k, (a, b) in enumerate(zip(spans, spans[1:])):
            yield (lambda t, a=a, b=b: spline.point(min(max(t, a), b)), a, b, 4)


def walk(entities, stack, inherited, listing):
    for entity in entities:
        layer = entity.dxf.layer
        layer = inherited if layer == "0" and inherited is not None else layer
        if entity.dxf.get("invisible", 0):
            continue
        if entity.dxftype() == "INSERT":
            block = entity.block()
            if block is None:
                continue
            for copy in entity.multi_insert():
                walk(block, stack + [copy.matrix44()], layer, listing)
            continue

        def placed(point):
            def at(t):
                p = point(t)
                for matrix in reversed(stack):
                    p = matrix.transform(p)
                return p.x, p.y
            return at
        curves = [(placed(point), begin, end, pieces) for point, begin, end, pieces in curves_of(entity)]
        if not curves:
            continue
        if entity.dxftype() == "SPLINE":  # its spans are one curve
            before = listing.found.get(("SPLINE", layer), [0])[0]
            listing.add(entity, layer, curves)
            listing.found[("SPLINE", layer)][0] = before + 1
        else:
            listing.add(entity, layer, curves)


def with_ezdxf(path):
    import ezdxf
    from ezdxf import recover
    try:
        document = ezdxf.readfile(path)
    except Exception:  # broken habits
        document, _ = recover.readfile(path)
    listing = Listing()
    walk(document.modelspace(), [], None, listing)
    return listing.json()


def with_ogr(path):
    from osgeo import gdal, ogr
    gdal.PushErrorHandler("CPLQuietErrorHandler")
    gdal.SetConfigOption("OGR_ARC_STEPSIZE", "0.1")
    gdal.SetConfigOption("DXF_MERGE_BLOCK_GEOMETRIES", "FALSE")
    source = ogr.Open(path)
    if source is None:
        return None
    found = {}
    for feature in source.GetLayer(0):
        if feature.GetField("PaperSpace"):
            continue
        kinds = (feature.GetField("SubClasses") or "").split(":")
        if any(kind in ("AcDbHatch", "AcDbText", "AcDbMText", "AcDbDimension") for kind in kinds):
            continue
        entry = found.setdefault(feature.GetField("Layer"), [0.0, [math.inf, math.inf, -math.inf, -math.inf]])
        collect(feature.GetGeometryRef(), entry)
    return [{"layer": layer, "length": length, "box": box} for layer, (length, box) in sorted(found.items())
            if length > 0]


def collect(geometry, entry):
    if geometry is None:
        return
    if geometry.GetGeometryCount() > 0:
        for i in range(geometry.GetGeometryCount()):
            collect(geometry.GetGeometryRef(i), entry)
        return
    points = geometry.GetPoints() or []
    for a, b in zip(points, points[1:]):
        entry[0] += math.hypot(b[0] - a[0], b[1] - a[1])
    if len(points) > 1:
        for x, y in ((p[0], p[1]) for p in points):
            box = entry[1]
            entry[1] = [min(box[0], x), min(box[1], y), max(box[2], x), max(box[3], y)]


def main():
    program, name = sys.argv[1], sys.argv[2]
    if program == "probe":
        try:
            __import__("ezdxf" if name == "ezdxf" else "osgeo.ogr")
        except ImportError:
            sys.exit(1)
        return
    read = {"ezdxf": with_ezdxf, "ogr": with_ogr}[program]
    json.dump({path: read(path) for path in sys.argv[2:]}, sys.stdout, indent=1)


main()
