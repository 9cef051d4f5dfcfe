#!/usr/bin/env python3
"""What others find in a drawing that lekalo wrote, as JSON on stdout.

  written_oracle.py FILE.svg    [{"length", "area"}] of python3-svgelements, by element, in the order of the file
  written_oracle.py FILE.dxf

{"version", "insunits", "errors": what ezdxf's audit found or repaired, "entities": [{"type", "layer", "closed",
"vertices": [[x, y, bulge]...]} or {"type", "layer", "centre", "radius"}], "ogr": [{"layer", "closed", "box"}] or null}
"""
import json
import pathlib
import sys


def listing(entity):
    found = {"type": entity.dxftype(), "layer": entity.dxf.layer}
    if found["type"] == "CIRCLE":
        found.update(centre=list(entity.dxf.center)[:2], radius=entity.dxf.radius)
    elif found["type"] == "LWPOLYLINE":
        found.update(closed=entity.closed, vertices=[list(v) for v in entity.get_points("xyb")])
    return found


def by_ogr(path):
    try:
        from osgeo import gdal, ogr
    except ImportError:
        return None
    gdal.UseExceptions()
    found = []
    source = ogr.Open(path)  # the layer does not keep it alive
    for feature in source.GetLayer(0):
        geometry = feature.GetGeometryRef()
        first, last = geometry.GetPoint(0), geometry.GetPoint(geometry.GetPointCount() - 1)
        west, east, south, north = geometry.GetEnvelope()
        found.append({"layer": feature.GetField("Layer"), "box": [west, south, east, north],
                      "closed": max(abs(a - b) for a, b in zip(first, last)) < 1e-9})
    return found


def main(path):
    if path.endswith(".svg"):
        sys.path.append(str(pathlib.Path(__file__).parent.parent / "corpus/data/svg"))
        import oracle
        print(json.dumps(oracle.entities_of(open(path, encoding="utf-8").read())))
        return
    import ezdxf
    document = ezdxf.readfile(path)
    auditor = document.audit()
    print(json.dumps({
        "version": document.dxfversion, "insunits": document.header.get("$INSUNITS"),
        "errors": [str(e.message) for e in list(auditor.errors) + list(auditor.fixes)],
        "entities": [listing(e) for e in document.modelspace()], "ogr": by_ogr(path)}))


main(sys.argv[1])
