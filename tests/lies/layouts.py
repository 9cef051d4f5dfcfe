"""Decides which changes of the layout that a program or an export is held against leave true what that claims."""

import json

import profile as profile_of
import truth


def ring_of(points):
    """A ring from its least corner on, anticlockwise: it may begin and run otherwise and be the same."""
    turned = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, points[1:] + points[:1]))
    points = [tuple(p) for p in (points if turned > 0 else points[::-1])]
    k = points.index(min(points))
    return points[k:] + points[:k]


# What a field that is not there means (docs/formats.md, "Layouts").
DEFAULTS = {"": {"kits": [], "placements": []}, "rules": {"gap": 0, "border_gap": 0, "defect_gap": 0}, "stocks": {"count": 1, "cost": 1},
            "parts": {"demand": 0, "quality": 0, "mirror": False},
            "placements": {"copy": 0, "mirrored": False, "locked": False}}


def meant(layout):
    """A layout with what it does not say, and with every ring from its least corner on, anticlockwise."""
    def rings(value):
        if isinstance(value, dict):
            return {key: ring_of(inner) if key == "outer" else list(map(ring_of, inner)) if key == "holes" else
                    rings(inner) for key, inner in value.items()}
        return list(map(rings, value)) if isinstance(value, list) else value

    layout = {**DEFAULTS[""], **layout}
    for key, defaults in DEFAULTS.items():
        if isinstance(layout.get(key), dict):
            layout[key] = {**defaults, **layout[key]}
        elif key:
            layout[key] = [{**defaults, **item} for item in layout[key]]
    return rings(layout)


def kept(context):
    """Names are for people; a placement may lie as it likes while the engine, which shares nothing with the checker,
    finds no rule broken."""
    before = dict(meant(json.loads(context.text)), placements=0)

    def holds(change):
        if change.path.endswith("/name") or change.path == "/next_id":
            return "information"
        after = truth.document_of(change)
        try:
            if after is None or dict(meant(after), placements=0) != before:
                return None
        except (KeyError, TypeError, ValueError):
            return None
        return context.runs(change.text(), ["check"]) or None
    return holds


def shown(layout, only=None, outlined=True):
    """What an export shows of a layout: the outline of each sheet that something lies on, and the rings of what lies
    there."""
    outlines = {part["id"]: part["outline"]["polygon"] for part in layout["parts"]}
    stocks = {stock["id"]: stock["outline"]["polygon"] for stock in layout["stocks"]}
    made = {}
    for placement in layout["placements"]:
        sheet = (placement["stock"], placement.get("copy", 0))
        if only and sheet != only:
            continue
        rings = made.setdefault(sheet, [[ring_of(stocks[sheet[0]]["outer"])]] if outlined else [])
        polygon, mirror = outlines[placement["part"]], -1 if placement.get("mirrored") else 1
        c, s = placement["c"], placement["s"]
        rings.append([ring_of([(c * mirror * x - s * y + placement["x"], s * mirror * x + c * y + placement["y"])
                               for x, y in ring]) for ring in polygon.get("holes", []) + [polygon["outer"]]])
        # Holes may stand in any order.
        rings[-1][:-1] = sorted(rings[-1][:-1])
    return {sheet: sorted(rings) for sheet, rings in made.items()}


def same(one, other, within):
    if isinstance(one, (list, tuple)):
        return len(one) == len(other) and all(same(a, b, within) for a, b in zip(one, other))
    return abs(one - other) <= within


def export(within, only=None):
    """The outlines are where they were, to what an export claims."""
    def oracle(context):
        before = shown(json.loads(context.text), only)

        def holds(change):
            after = truth.document_of(change)
            try:
                after = after and shown(after, only)
            except (KeyError, TypeError, ValueError, IndexError):
                return None
            if after == before:
                return "information"
            return after and after.keys() == before.keys() and \
                all(same(before[sheet], after[sheet], within) for sheet in before) or None
        return holds
    return oracle


def program(context):
    """The cuts follow the contours of the changed layout as those before."""
    chains = profile_of.cuts_of(context.files["cut.nc"])
    only = ("steel 2 mm", 0)
    before = shown(json.loads(context.text), only, outlined=False)

    def holds(change):
        after = truth.document_of(change)
        try:
            # Nothing is said of the sheet, but of what is cut from it.
            if after is None or shown(after, only, outlined=False) == before:
                return after and "information"
            sheet = profile_of.Sheet(after, *only, 0.3, step=0.3)
        except (KeyError, TypeError, ValueError, IndexError):
            return None
        numbers = []
        for chain in chains:
            numbers.append(sheet.followed(chain))
            if numbers[-1] is None:
                return None
        return sheet.is_cut_by(numbers) or None
    return holds
