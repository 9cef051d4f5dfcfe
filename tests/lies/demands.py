"""Decides which changes of a placement with demands leave every claim true (docs/formats.md, `demands`)."""

import heapq
import json
import math

import changes
import exact
import shapes
import truth
from exact import D, number


class GrownCover(shapes.Cover):
    """A certificate for the part grown along its edges, and for caps on what features may have.

    How large a ball of the grown part is, is known of the balls of the result before the change; the radius that a
    point has changes by no more than the point moves, and than the growth does.
    """

    def __init__(self, part, blank, pivot, growth, caps, known, grown_less):
        super().__init__(part, blank, pivot)
        self.growth, self.caps, self.known, self.grown_less = growth, caps, known, grown_less

    def grown(self, x, y, r):
        """As much of a ball as lies in the grown part, by a ball that does or by what lies around the point."""
        near = max((radius - math.hypot(x - a, y - b) - self.grown_less for a, b, radius in self.known),
                   default=-math.inf)
        if near >= r:
            return r
        p = (number(x), number(y))
        ways = [float(shapes.to_edge(p, edge)) + by for edge, by in zip(self.part, self.growth)]
        inside = min(ways) if shapes.is_inside(p, self.part) else -math.inf
        return min(r, max(near, inside))

    def term(self, contact):
        if len(contact) == 7:
            a, b, r, c, d, s, m = contact
            blank = self.radius(c, d, s, self.blank, -1)
            return a, b, self.grown(a, b, r) + blank, c, d, m, -blank
        a, b, _, c, d, s, m, f = contact
        edges, most = self.caps[f]
        off = float(min(shapes.to_edge((number(a), number(b)), edge) for edge in edges))
        material = self.radius(c, d, s, self.blank, 1)
        return a, b, material - off - most, c, d, m, -math.inf


class Demands(truth.Regions):
    def __init__(self, context):
        super().__init__(context)
        self.placements = {}
        self.asked = next((context.json(one["path"]) for one in self.before["inputs"] if one["role"] == "features"), {})

    @staticmethod
    def rules(document):
        """The feature of every edge of the part; None where it has none."""
        return {k: feature for feature in document["demands"]["features"] for k in feature["edges"]}

    def cover(self, document, edges, key, grown_for, shift, most):
        said, rules = document["demands"], self.rules(document)
        growth = []
        for k in range(len(edges["part"])):
            rule = rules.get(k)
            growth.append(said["minimum"] + grown_for if rule is None else
                          rule["minimum"] + rule["scale"] * grown_for if rule["finished"] is None else
                          -rule["finished"])
        capped = [f for f in said["features"] if f["maximum"] is not None or f["finished"] is not None]
        caps = [([edges["part"][k] for k in f["edges"]],
                 (f["maximum"] if f["finished"] is None else f["finished"]) + shift) for f in capped]
        if most is not None:
            caps.append(([edge for k, edge in enumerate(edges["part"])
                          if rules.get(k) is None or rules[k]["finished"] is None], most + shift))
        before = self.before["demands"]
        grown_before = before["grown_for"] if key == "certificate" else before["smallest_largest"]["proof"]["grown_for"]
        scale = max([1] + [f["scale"] for f in said["features"]])
        less = max(0, grown_before - grown_for) * scale + self.outlines_off(document)
        return GrownCover(edges["part"], edges["blank"], document[key]["pivot"], growth, caps, self.balls(key), less)

    def balls(self, key):
        return {tuple(contact[:3]) for tree in self.before[key]["trees"] for node in tree["nodes"]
                if isinstance(node, dict) for contact in node["contacts"] if len(contact) == 7}

    def outlines_off(self, document):
        """How far the outline of the part may be from that before."""
        one, other = (list(changes.nodes(d["regions"]["part"])) for d in (document, self.before))
        moved = [abs(a - b) for (_, a), (_, b) in zip(one, other) if truth.is_number(a)]
        return 4 * max(moved) if any(moved) else 0

    def proves(self, document, edges, key, bound, numbers):
        """The certificate `key` bounds what it is about by `bound`, less the tolerances."""
        less = bound - sum(document["tolerances"].values())
        certificate = document[key]
        wanted = {"no": {False}, "yes": {True}, "either": {False, True}}[document["mirror"]]
        if not wanted <= {tree["mirrored"] for tree in certificate["trees"]}:
            return False
        cover, (bound_before, numbers_before) = self.cover(document, edges, key, *numbers), self.numbers(self.before)[key]
        same = all(document[k] == self.before[k] for k in ("regions", "tolerances")) and numbers == numbers_before and \
            bound >= bound_before and document["demands"]["features"] == self.before["demands"]["features"] and \
            document["demands"]["minimum"] == self.before["demands"]["minimum"] and \
            certificate["pivot"] == self.before[key]["pivot"]
        known = set()
        if same:
            for tree in self.before[key]["trees"]:
                known |= {json.dumps([tree["mirrored"], *leaf]) for leaf in cover.leaves(tree)}
        for tree in certificate["trees"]:
            leaves = cover.leaves(tree)
            if leaves is None or not self.root_holds(document, edges, tree, key, less):
                return False
            for contacts, box in leaves:
                if json.dumps([tree["mirrored"], contacts, box]) not in known and \
                        not cover.proves(contacts, box, tree["mirrored"], less):
                    return False
        return True

    @staticmethod
    def numbers(document):
        """For each certificate what it bounds, and the growth, the shift and the cap on all edges that it is for."""
        said, second = document["demands"], document["demands"]["smallest_largest"]
        found = {"certificate": (said["bound"], (said["grown_for"], said["shift"], None))}
        if second and second["proof"]:
            proof = second["proof"]
            found["largest_certificate"] = proof["bound"], (proof["grown_for"], proof["shift"], proof["most"])
        return found

    def least_scale(self, document, edges):
        rules = self.rules(document)
        return min((number(rules[k]["scale"]) if k in rules else D(1) for k in range(len(edges["part"]))
                    if k not in rules or rules[k]["finished"] is None), default=D(1))

    def bounds_hold(self, document, edges):
        """Every bound is proved, and what is said of all placements follows from it."""
        said, scale = document["demands"], self.least_scale(document, edges)
        capped = any(f["maximum"] is not None or f["finished"] is not None for f in said["features"])
        for key, (bound, numbers) in self.numbers(document).items():
            if not self.proves(document, edges, key, bound, numbers):
                return False
        bound, most = number(said["bound"]), number(said["margin_bound"])
        if said["grown_for"] < 0:
            return False
        if most < 0:
            if said["grown_for"] != 0 or bound > most:
                return False
        elif bound > scale * (most - number(said["grown_for"])) + last_places(most) or \
                (capped and bound - sum(map(number, document["tolerances"].values())) > number(said["shift"])):
            return False
        second = said["smallest_largest"]
        if not second or not second["proof"]:
            return second is None or second["bound"] <= 0
        proof = {k: number(v) for k, v in second["proof"].items()}
        return (0 <= proof["grown_for"] <= number(second["margin"]) and
                proof["bound"] < scale * (number(second["margin"]) - proof["grown_for"]) and
                (not capped or proof["bound"] < proof["shift"]) and
                number(second["bound"]) <= proof["most"] + proof["shift"] - proof["bound"])

    def follow(self, document):
        """What is computed from other numbers is that, to the last places of doubles."""
        said = {k: number(v) if truth.is_number(v) else v for k, v in document["demands"].items()}
        second = said["smallest_largest"] and {k: number(v) for k, v in said["smallest_largest"].items() if k != "proof"}
        minimum = max(number(document["min_allowance"]), self.in_mm(self.asked.get("minimum", 0)))
        if said["minimum"] != minimum or number(document["shortfall"]) != max(D(0), -said["margin"]) or \
                document["upper_bound"] is not None or document["gap"] is not None or said["give_up"] < 0:
            return False
        if max(said["margin_found"], said["margin"]) > said["margin_bound"]:
            return False
        optimal = document["status"] == "optimal"
        if optimal and said["margin_bound"] - said["margin_found"] > said["margin_gap"] + last_places(said["margin_gap"]):
            return False
        if (said["margin_bound"] < 0) != (document["status"] == "infeasible"):
            return False
        if second is None:
            return said["margin"] == said["margin_found"]
        kept = max(D(0), said["margin_found"] - said["give_up"])
        limit = second["found"] if said["criterion"] == "largest" else second["kept"]
        open_ = second["found"] - second["bound"] > second["gap"]
        return (abs(second["margin"] - kept) <= last_places(said["margin_found"]) and
                said["margin"] >= second["margin"] and second["bound"] <= second["found"] and said["largest"] <= limit and
                abs(second["kept"] - (second["found"] if open_ else second["bound"] + second["gap"])) <=
                last_places(second["kept"]) and
                (not optimal or second["found"] - second["bound"] <= second["gap"] + last_places(second["found"])))

    def in_mm(self, length):
        return number(length) * (D("25.4") if self.asked.get("units") == "inch" else 1)

    def placements_hold(self, document, edges):
        """The same, looked at once for what it depends on."""
        said = document["demands"]
        key = json.dumps([document[k] for k in ("x", "y", "theta", "theta_deg", "mirrored", "clearance", "window_deg",
                                                "regions", "tolerances")] +
                         [said[k] for k in ("margin", "largest", "minimum", "features", "trade_off")])
        if key not in self.placements:
            self.placements[key] = self.every_placement_holds(document, edges)
        return self.placements[key]

    def every_placement_holds(self, document, edges):
        """At every placement the pose is allowed, no edge has less than its minimum with its share of the margin, none
        more than its maximum or than what is said to be the largest, and the clearance is there."""
        said, rules = document["demands"], self.rules(document)
        less = sum(map(number, document["tolerances"].values()))
        for pose in [dict(document, margin=said["margin"], largest=said["largest"])] + said["trade_off"]:
            if not truth.pose_is_allowed(document, pose) or pose["mirrored"] != document["mirrored"]:
                return False
            if said["trade_off"] and pose in said["trade_off"] and pose["margin"] < 0:
                return False
            motion = shapes.Motion(pose["x"], pose["y"], pose["theta"], pose["mirrored"])
            placed = [edge.moved(motion) for edge in edges["part"]]
            if number(pose["clearance"]) > shapes.distance(placed, edges["blank"]) - less:
                return False
            if pose["margin"] < 0:
                continue
            for k, edge in enumerate(placed):
                rule = rules.get(k)
                if rule is None or rule["finished"] is None:
                    least = number(said["minimum"] if rule is None else rule["minimum"])
                    scale = D(1) if rule is None else number(rule["scale"])
                    if shapes.distance([edge], edges["blank"]) - less < least + scale * number(pose["margin"]) or \
                            not keeps_depth(edge, edges["blank"], number(pose["largest"]) - less):
                        return False
                if rule is not None:
                    most = rule["maximum"] if rule["finished"] is None else rule["finished"]
                    if most is not None and not keeps_depth(edge, edges["blank"], number(most) - less):
                        return False
        return True

    def holds(self, document):
        edges = self.edges if document["regions"] == self.before["regions"] else self.edges_in(document)
        return (self.follow(document) and self.beside_bounds(document, edges) and
                self.placements_hold(document, edges) and self.bounds_hold(document, edges))


def last_places(size):
    """As much as sums of a few doubles of this size may be off."""
    return D("4e-16") * max(D(1), abs(size))


def keeps_depth(edge, blank, most):
    """No point of a placed edge is deeper in the blank than `most`: the depth changes by no more than the point moves,
    so the piece that may be deepest is halved, until none may be too deep or only last places are left to look at."""
    if edge.arc:
        first, last = (math.atan2(p[1] - edge.c[1], p[0] - edge.c[0]) for p in (edge.a, edge.b))
        turn = (last - first) % math.tau if edge.ccw else -((first - last) % math.tau)
        turn = math.tau if edge.full or turn == 0 else turn
        size = edge.r * D(abs(turn))
    else:
        size = shapes.apart(edge.a, edge.b)

    def deep(t):
        if not edge.arc:
            return shapes.depth(tuple(edge.a[k] + D(t) * (edge.b[k] - edge.a[k]) for k in (0, 1)), blank)
        c, s = exact.turn(first + t * turn)
        return shapes.depth((edge.c[0] + edge.r * c, edge.c[1] + edge.r * s), blank)

    pieces = [(-deep(0.5) - size / 2, 0.5, 0.25)]
    for _ in range(400):
        bound, middle, quarter = heapq.heappop(pieces)
        if -bound <= most:
            return True
        if -bound - size * D(2 * quarter) > most:
            return False
        for t in (middle - quarter, middle + quarter):
            heapq.heappush(pieces, (-deep(t) - size * D(quarter), t, quarter / 2))
    return all(deep(middle) <= most for _, middle, _ in pieces)


# Whole items that may be gone: what is left of the list says less.
MAY_GO = r"/(contacts|demands/trade_off)/\d+$|/(largest_)?certificate/trees/\d+/nodes/\d+/contacts/\d+$"


def oracle(context):
    demands = Demands(context)

    def holds(change):
        if truth.matches(truth.OF_PLACEMENTS + [r"/contacts/\d+/multiplier$"], change.path):
            return "information"
        after = truth.document_of(change)
        if after is None or not truth.may_hold(change, demands.before, after, MAY_GO):
            return None
        try:
            return demands.holds(after) or None
        except (KeyError, TypeError, ValueError, IndexError):
            return None
    return holds
