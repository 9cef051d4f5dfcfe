"""Decides which changes of a stock leave true what it claims. Everything in it is a rectangle, or has sides along the axes,
and lies in mm; it computes with doubles and shares nothing with the checker."""

import json
import re

import layouts
import truth

# Nobody can recheck them: what is kept from now on, and what kind of sheet came.
UNKNOWN = (r"/remnant_min(/|$)", r"/items/\d+/stock/(kind|grain_deg|name)$", r"/orders/\d+/layouts/\d+/layout/next_id$",
           r".*/layout/(stocks|parts)/\d+/name$", r".*/layout/name$")


def box_of(points):
    return (min(p[0] for p in points), min(p[1] for p in points), max(p[0] for p in points), max(p[1] for p in points))


def pieces_of(layout):
    """By sheet: the box of each piece, and how far a remnant has to stay from it."""
    rules = layout.get("rules", {})
    parts = {part["id"]: part for part in layout["parts"]}
    made = {}
    for placement in layout["placements"]:
        part, mirror = parts[placement["part"]], -1 if placement.get("mirrored") else 1
        c, s = placement["c"], placement["s"]
        turned = [(c * mirror * x - s * y + placement["x"], s * mirror * x + c * y + placement["y"])
                  for x, y in part["outline"]["polygon"]["outer"]]
        gap = max(part.get("gap", rules.get("gap", 0)), rules.get("kerf", 0))
        made.setdefault((placement["stock"], placement.get("copy", 0)), []).append((box_of(turned), gap))
    return made


def uses_of(stock):
    """By item: its order, the state of that, the pieces on it, and the stock of the layout that it is."""
    made = {}
    for order in stock["orders"]:
        for one in order["layouts"]:
            lying = pieces_of(one["layout"])
            drawn = {s["id"]: s for s in one["layout"]["stocks"]}
            for sheet in one["sheets"]:
                if sheet["item"] in made:
                    return None
                made[sheet["item"]] = (order["id"], order["state"], lying.pop((sheet["stock"], sheet["copy"])),
                                       drawn[sheet["stock"]])
            if lying:
                return None
    return made


def inside(ring, x, y):
    odd = False
    for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
        if (ay > y) != (by > y) and x < ax:
            odd = not odd
    return odd


def is_clear(ring, box, gap):
    """A ring with sides along the axes stays so far from a box, and does not hold it."""
    for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
        dx = max(min(ax, bx) - box[2], box[0] - max(ax, bx), 0)
        dy = max(min(ay, by) - box[3], box[1] - max(ay, by), 0)
        if (dx * dx + dy * dy) ** 0.5 < gap - 1e-9:
            return False
    return not inside(ring, (box[0] + box[2]) / 2, (box[1] + box[3]) / 2)


def ring_of(stock):
    return [tuple(point) for point in stock["outline"]["polygon"]["outer"]]


def same_places(stock):
    """What of the layouts anything else in the document depends on."""
    return {item: (use[2], layouts.ring_of(ring_of(use[3]))) for item, use in uses_of(stock).items()}


def holds_still(context, stock):
    uses = uses_of(stock)
    items = {item["id"]: item for item in stock["items"]}
    for item, use in uses.items():
        if layouts.ring_of(ring_of(use[3])) != layouts.ring_of(ring_of(items[item]["stock"])):
            return False
    for item in stock["items"]:
        use = uses.get(item["id"])
        if item["state"] != (use[1] if use else "free") or item["order"] != (use[0] if use else None):
            return False
        if item["from"]:
            x, y = item["at"]
            ring = [(a + x, b + y) for a, b in ring_of(item["stock"])]
            if not all(is_clear(ring, *piece) for piece in uses[item["from"]][2]):
                return False
    return all(context.runs(json.dumps(one["layout"]), ["check"])
               for order in stock["orders"] for one in order["layouts"])


def keeps_rules(stock):
    """Each remnant has its rectangle, which satisfies the rule of the order that cut its sheet."""
    items = {item["id"]: item for item in stock["items"]}
    rules = {order["id"]: order["remnant_min"] for order in stock["orders"]}
    for item in stock["items"]:
        if item["from"]:
            x0, y0, x1, y1 = item["rectangle"]
            rule = rules[items[item["from"]]["order"]]
            sides = sorted((x1 - x0, y1 - y0))
            if x0 >= x1 or y0 >= y1 or sides[0] < min(rule.values()) or sides[1] < max(rule.values()):
                return False
    return True


def says_less(before, after, change):
    """A rectangle within the one before, or a rule that asks for less, leaves true what was."""
    found = re.match(r"/items/(\d+)/rectangle/", change.path)
    if found:
        old, new = (stock["items"][int(found[1])]["rectangle"] for stock in (before, after))
        if not (old[0] <= new[0] and old[1] <= new[1] and new[2] <= old[2] and new[3] <= old[3]):
            return False
    return (found or re.match(r"/orders/\d+/remnant_min/", change.path)) and keeps_rules(after)


def oracle(context):
    before = json.loads(context.text)

    def holds(change):
        if any(re.match(rule, change.path) for rule in UNKNOWN):
            return "information"
        after = truth.document_of(change)
        try:
            # Nothing depends on an order that was cancelled.
            order = re.match(r"/orders/(\d+)(/id)?$", change.path)
            if order and before["orders"][int(order[1])]["state"] == "cancelled":
                return "information"
            if after is not None and says_less(before, after, change):
                return True
            # The order of a list says nothing.
            if change.path in ("/items", "/orders") and \
                    all(sorted(map(json.dumps, after[key])) == sorted(map(json.dumps, before[key])) for key in before
                        if isinstance(before[key], list)):
                return True
            # Else only what stands in layouts may be otherwise: everything follows from something.
            if after is None or "/layout/" not in change.path or not holds_still(context, after):
                return None
            return "information" if same_places(after) == same_places(before) else True
        except (KeyError, TypeError, ValueError, IndexError):
            return None
    return holds
