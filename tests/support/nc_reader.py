"""A second reader of NC programs, for tests. It shares nothing with the rewriter and the checker: it runs a
program line by line as a control does, with subprograms, variables and frames (G10 L2 R, G52, G68), and says
in machine coordinates what happens. `differences` holds a rewritten program against its original, moved."""

import math
import re

HOLES = {73, 74, 76, 81, 82, 83, 84, 85, 86, 87, 88, 89}
MOTIONS = {0, 1, 2, 3} | HOLES


class Event:
    """What a block does: a line, an arc, a hole, a way home, or only words."""

    def __init__(self, kind, line, **more):
        self.kind, self.line, self.words, self.work = kind, line, [], None
        self.__dict__.update(more)

    def __repr__(self):
        return f"line {self.line}: {self.kind} {self.__dict__}"


class Unreadable(Exception):
    pass


def without_comments(line, control):
    code, depth = [], 0
    for c in line:
        if c == ";" and depth == 0:
            break
        if c == "(" and not (depth and control == "linuxcnc"):
            depth += 1
        elif c == ")" and depth:
            depth -= 1
        elif depth == 0:
            code.append(c)
    return "".join(code).upper()


def python_of(expression, variables):
    """The expression in Python's own words, so that Python computes it."""
    def variable(match):
        return f"v[{match.group(1)!r}]"
    text = re.sub(r"\s+", "", expression)
    text = re.sub(r"(ATAN)(\[[^\[\]]*\])/(\[[^\[\]]*\])", r"ATAN2[\2,\3]", text)
    for _ in range(3):
        text = re.sub(r"#(\d+|<[^>]*>)", variable, text)
    text = re.sub(r"(?<!v)\[", "(", text)
    text = re.sub(r"(?<!')\]", ")", text)
    text = text.replace("MOD", "%")
    names = {"v": variables, "SIN": lambda a: math.sin(math.radians(a)), "COS": lambda a: math.cos(math.radians(a)),
             "TAN": lambda a: math.tan(math.radians(a)), "ASIN": lambda a: math.degrees(math.asin(a)),
             "ACOS": lambda a: math.degrees(math.acos(a)), "ATAN2": lambda a, b: math.degrees(math.atan2(a, b)),
             "SQRT": math.sqrt, "ABS": abs, "FIX": math.floor, "FUP": math.ceil, "__builtins__": {}}
    return float(eval(text, names))  # pylint: disable=eval-used


def number_at(code, at, variables):
    """The number behind a letter: its value, where it ends, and its decimals as written."""
    match = re.compile(r"\s*[+-]?\s*[#\[]").match(code, at)
    if not match:
        match = re.compile(r"\s*([+-]?\s*\d*\.?\d*)").match(code, at)
        text = re.sub(r"\s", "", match.group(1))
        if not re.search(r"\d", text):
            if text in (".", "+.", "-."):
                return 0.0, match.end(), 0
            raise Unreadable(f"no number at {code[at:at + 9]!r}")
        return float(text), match.end(), len(text.split(".")[1]) if "." in text else 0
    end, depth = match.end() - 1, 0
    if code[end] == "#":
        end += 1
        end = code.index(">", end) + 1 if code[end] == "<" else re.compile(r"#*\d+").match(code, end).end()
    else:
        while True:
            depth += {"[": 1, "]": -1}.get(code[end], 0)
            end += 1
            if depth == 0:
                break
    return python_of(code[at:end], variables), end, None


class Reader:
    def __init__(self, text, control):
        text = text.removeprefix("\u00ef\u00bb\u00bf")  # the byte order mark of UTF-8, read as Latin-1
        self.lines = [line.rstrip("\r") for line in text.split("\n")]
        self.codes = [without_comments(line, control) for line in self.lines]
        self.control, self.variables, self.events, self.ended = control, {}, [], False
        self.unit, self.incremental, self.plane, self.motion = 1.0, False, 17, None
        self.absolute_centre, self.retract, self.inverse_time = False, None, False
        self.work = None
        self.at = {"X": None, "Y": None, "Z": None}
        self.offset, self.turn, self.shift = (0.0, 0.0), 0.0, (0.0, 0.0)  # G10 L2 or G68, G52
        self.cycle = {}
        self.bodies = self.find_bodies()

    # Flow

    def find_bodies(self):
        bodies, any_code, k = {}, False, 0
        self.skips = {}
        while k < len(self.codes):
            code = re.sub(r"\s", "", self.codes[k])
            opens = re.fullmatch(r"O(\d+|<[^>]*>)SUB", code)
            number = re.fullmatch(r"O0*(\d+)", code)
            if opens or (number and any_code):
                name = opens.group(1).lstrip("0") if opens else number.group(1)
                last = f"O{opens.group(1)}ENDSUB" if opens else "M99"
                end = k
                while re.sub(r"^N\d+", "", re.sub(r"\s", "", self.codes[end])) != last:
                    end += 1
                bodies[name], self.skips[k] = (k + 1, end), end
                k = end
            any_code = any_code or code not in ("", "%")
            k += 1
        return bodies

    def run(self):
        k = 0
        while k < len(self.codes):
            if k in self.skips:
                k = self.skips[k] + 1
                continue
            if not self.ended:
                self.step(k)
            k += 1
        return self.events

    def step(self, k):
        code = self.codes[k].strip()
        if code in ("", "%"):
            return
        flat = re.sub(r"^N\d+", "", re.sub(r"\s", "", code))
        if flat.startswith("/"):
            self.events.append(Event("skippable", k + 1, text=flat))
            return
        assigned = re.fullmatch(r"#(\d+|<[^>]*>)=(.*)", flat)
        if assigned:
            self.variables[assigned.group(1)] = python_of(assigned.group(2), self.variables)
            return
        called = re.fullmatch(r"O(\d+|<[^>]*>)CALL", flat)
        if called:
            return self.call(self.bodies[called.group(1).lstrip("0")], 1)
        by_m = re.fullmatch(r"(?=.*M9[78](?!\d))([MPL]\d+){2,3}", flat)
        if by_m:
            words = dict(re.findall(r"([MPL])(\d+)", flat))
            name, times = words["P"].lstrip("0"), int(words.get("L", 1))
            if words["M"] == "98":
                return self.call(self.bodies[name], times)
            label = re.compile(rf"\s*N0*{name}(?!\d)")
            first = [i for i, each in enumerate(self.codes) if label.match(each)]
            if first:
                end = first[0]
                while re.sub(r"^N\d+", "", re.sub(r"\s", "", self.codes[end])) != "M99":
                    end += 1
                return self.call((first[0], end), times)
            self.events.append(Event("alarm", k + 1, text=flat))
            return
        if re.fullmatch(r"O\d+", flat):
            return
        self.block(code, k + 1)

    def call(self, body, times):
        for _ in range(times):
            for k in range(*body):
                self.step(k)

    # Blocks

    def block(self, code, line):
        letters, gs, ms, decimals, at = {}, [], [], {}, 0
        while at < len(code):
            if code[at].isspace():
                at += 1
                continue
            letter = code[at]
            if not "A" <= letter <= "Z":
                raise Unreadable(f"line {line}: {code[at:]!r}")
            value, at, places = number_at(code, at + 1, self.variables)
            if letter == "G":
                gs.append(round(value, 1))
            elif letter == "M":
                ms.append(round(value, 1))
            else:
                if letter in letters:
                    raise Unreadable(f"line {line}: two {letter}")
                letters[letter], decimals[letter] = value, places
        letters.pop("N", None)
        self.act(letters, gs, ms, decimals, line)

    def act(self, letters, gs, ms, decimals, line):
        rest = sorted(f"M{m:g}" for m in ms)
        for g in gs:
            if g in (20, 21):
                self.unit = 25.4 if g == 20 else 1.0
            elif g in (17, 18, 19):
                self.plane = int(g)
            elif g in (90, 91):
                self.incremental = g == 91
            elif g in (90.1, 91.1):
                self.absolute_centre = g == 90.1
            elif g in (93, 94, 95):
                self.inverse_time = g == 93
                rest.append(f"G{g:g}")
            elif g in (98, 99):
                self.retract = g
            elif g == 80:
                self.motion, self.cycle = None, {}
            elif g in MOTIONS:
                if g != self.motion:
                    self.cycle = {}
                self.motion = int(g)
            elif 54 <= g < 60:
                self.work = g
            elif g not in (4, 10, 28, 30, 52, 53, 68, 69):
                rest.append(f"G{g:g}")
        if self.frame(letters, gs):
            return
        if 6 in ms:
            self.at = {"X": None, "Y": None, "Z": None}
        moves = [a for a in "XYZ" if a in letters]
        for letter in sorted(letters):
            if letter not in "XYZIJKR" and not (letter in "PQL" and (moves or "I" in letters or "J" in letters)):
                rest.append(f"{letter}{letters[letter] * (self.unit if letter == 'F' else 1):.9g}")
        first = len(self.events)
        if 4 in gs:
            rest.append("G4 " + " ".join(f"{a}{letters[a]:g}" for a in "XPU" if a in letters))
        elif {28, 30, 53} & set(gs):
            self.go_home(letters, gs, line)
        elif moves or (self.motion in (2, 3) and {"I", "J", "K"} & set(letters)):
            self.move(letters, decimals, line)
        if len(self.events) == first and rest:
            self.events.append(Event("words", line))
        if len(self.events) > first:
            self.events[first].words = sorted(rest)
            self.events[first].work = self.work
        if 2 in ms or 30 in ms:
            self.ended = True

    def frame(self, letters, gs):
        """True for a block that only sets a frame."""
        if 10 in gs:
            if letters.get("L") != 2:
                raise Unreadable("G10 but for L2")
            self.offset = (letters["X"] * self.unit, letters["Y"] * self.unit)
            self.turn = math.radians(letters["R"])
        elif 52 in gs:
            self.shift = (letters["X"] * self.unit, letters["Y"] * self.unit)
        elif 68 in gs:
            if letters["X"] or letters["Y"]:
                raise Unreadable("G68 about another point")
            self.turn = math.radians(letters["R"])
        elif 69 in gs:
            self.turn = 0.0
        else:
            return False
        return True

    def frame_now(self):
        """From the program's places to those of the machine, as it is in force here."""
        c, s = math.cos(self.turn), math.sin(self.turn)
        u, v = self.offset[0] + self.shift[0], self.offset[1] + self.shift[1]
        return lambda x, y: None if x is None or y is None else (c * x - s * y + u, s * x + c * y + v)

    def machine(self, x, y):
        return self.frame_now()(x, y)

    def go_home(self, letters, gs, line):
        by = {a: self.target(a, letters) for a in "XYZ" if a in letters}
        if 53 in gs:
            self.events.append(Event("machine", line, to={a: letters[a] * self.unit for a in by},
                                     motion=self.motion))
        else:
            self.events.append(Event("home", line, which=[g for g in gs if g in (28, 30)], z=by.get("Z"),
                                     axes=sorted(by), incremental=self.incremental,
                                     through={a: letters[a] for a in by if a != "Z"}))
        for a in by or "XYZ":
            self.at[a] = None

    def target(self, axis, letters):
        value = letters[axis] * self.unit
        if not self.incremental:
            return value
        return None if self.at[axis] is None else self.at[axis] + value

    def move(self, letters, decimals, line):
        if self.motion in HOLES:
            return self.drill(letters, decimals, line)
        start = dict(self.at)
        for a in "XYZ":
            if a in letters:
                self.at[a] = self.target(a, letters)
        ends = dict(start=self.machine(start["X"], start["Y"]), end=self.machine(self.at["X"], self.at["Y"]),
                    z0=start["Z"], z1=self.at["Z"], decimals=(decimals.get("X"), decimals.get("Y")),
                    unit=self.unit, incremental=self.incremental, feeds=self.inverse_time)
        if self.motion in (0, 1):
            self.events.append(Event("rapid" if self.motion == 0 else "feed", line, **ends))
        elif self.motion in (2, 3):
            self.arc(letters, start, ends, line)
        else:
            raise Unreadable(f"line {line}: axis words without a motion")

    def arc(self, letters, start, ends, line):
        first, second, across, words = {17: ("X", "Y", "Z", "IJ"), 18: ("Z", "X", "Y", "KI"),
                                        19: ("Y", "Z", "X", "JK")}[self.plane]
        a, b = (start[first], start[second]), (self.at[first], self.at[second])
        if "R" in letters:
            radius = letters["R"] * self.unit
            chord = math.dist(a, b)
            up = math.sqrt(max(0.0, radius * radius - chord * chord / 4))
            side = (1 if self.motion == 3 else -1) * (1 if radius > 0 else -1)
            centre = ((a[0] + b[0]) / 2 - side * up * (b[1] - a[1]) / chord,
                      (a[1] + b[1]) / 2 + side * up * (b[0] - a[0]) / chord)
        else:
            centre = tuple(letters.get(w, 0.0) * self.unit + (0 if self.absolute_centre else p)
                           for w, p in zip(words, a))
        arc = Arc(self.plane, self.motion == 3, a, b, centre, start[across], self.at[across],
                  int(letters.get("P", 1)) if self.control == "linuxcnc" else 1)
        self.events.append(Event("arc", line, arc=arc, centre=self.machine(*centre) if self.plane == 17 else None,
                                 frame=self.frame_now(), **ends))

    def drill(self, letters, decimals, line):
        if self.plane != 17:
            raise Unreadable("a cycle outside the XY plane")
        for a in "ZRQP" + ("IJK" if self.control == "haas" else ""):
            if a in letters:
                self.cycle[a] = letters[a] * (1 if a == "P" else self.unit)
        repeats = int(letters.get("K" if self.control == "fanuc" and "K" in letters else "L", 1))
        holes = []
        for _ in range(repeats):
            for a in "XY":
                if a in letters:
                    self.at[a] = self.target(a, letters)
            holes.append(self.machine(self.at["X"], self.at["Y"]))
        self.at["Z"] = None
        self.events.append(Event("holes", line, code=self.motion, holes=holes, repeats=repeats,
                                 cycle=dict(self.cycle), retract=self.retract, incremental=self.incremental,
                                 decimals=(decimals.get("X"), decimals.get("Y")), unit=self.unit))


class Arc:
    def __init__(self, plane, ccw, a, b, centre, c0, c1, turns):
        self.plane, self.ccw, self.centre, self.c0, self.c1, self.turns = plane, ccw, centre, c0, c1, turns
        da, db = [(p[0] - centre[0], p[1] - centre[1]) for p in (a, b)]
        self.r0, self.r1, self.begin = math.hypot(*da), math.hypot(*db), math.atan2(da[1], da[0])
        sweep = (1 if ccw else -1) * (math.atan2(db[1], db[0]) - self.begin) % (2 * math.pi)
        if a == b:
            sweep = 2 * math.pi
        self.sweep = sweep + 2 * math.pi * (turns - 1)

    def point(self, share):
        angle = self.begin + (1 if self.ccw else -1) * share * self.sweep
        r = self.r0 + share * (self.r1 - self.r0)
        u, v = self.centre[0] + r * math.cos(angle), self.centre[1] + r * math.sin(angle)
        w = None if self.c0 is None or self.c1 is None else self.c0 + share * (self.c1 - self.c0)
        return {17: (u, v, w), 18: (v, w, u), 19: (w, u, v)}[self.plane]


def read(text, control):
    return Reader(text, control).run()


class Comparison:
    def __init__(self, pose, rounding, chord, mode, rise):
        x, y, theta = pose
        self.mode, self.rise = mode, rise
        self.x, self.y, self.c, self.s = x, y, math.cos(theta), math.sin(theta)
        self.rounding, self.chord = rounding + 1e-9, chord

    def moved(self, p):
        return None if p is None else (self.c * p[0] - self.s * p[1] + self.x, self.s * p[0] + self.c * p[1] + self.y)

    def off(self, p, q):
        if p is None or q is None:
            return 0.0 if (p is None) == (q is None) else math.inf
        return math.dist(self.moved(p), q)

    def raised(self, a, b, by=0.0):
        """Heights of the original and of the written one; of a solid's program they are shifted."""
        if a is None or b is None:
            return a is b
        return close(a, b, by or 1e-9) if self.rise is None else close(a + self.rise, b, by + self.rounding)

    def run(self, original, written):
        k = 0
        for event in original:
            if k == len(written):
                return f"the original goes on: {event}"
            other = written[k]
            if event.kind == "arc" and event.arc.plane != 17 and other.kind == "feed":
                k, what = self.chords(event, written, k)
            else:
                k, what = k + 1, self.one(event, other)
            if what:
                return f"{what}\n  {event}\n  {other}"
        return "" if k == len(written) else f"the written one goes on: {written[k]}"

    def one(self, a, b):
        if a.kind != b.kind or a.words != b.words:
            return "another event or other words"
        if a.work != b.work and not (a.work is None and self.mode != "coordinates"):
            return "another work offset"
        if a.kind in ("skippable", "alarm"):
            return "" if a.text == b.text else "other words"
        if a.kind == "machine":
            return "" if (a.to, a.motion) == (b.to, b.motion) else "another place of the machine"
        if a.kind == "home":
            same = (a.which, a.axes, a.through) == (b.which, b.axes, b.through)
            return "" if same and self.raised(a.z, b.z) else "another way home"
        if a.kind == "holes":
            if (a.code, a.repeats, a.retract) != (b.code, b.repeats, b.retract) or not self.same_cycle(a, b):
                return "another cycle"
            return "" if all(self.off(p, q) <= self.rounding for p, q in zip(a.holes, b.holes)) else "holes elsewhere"
        if a.kind == "words":
            return ""
        if not self.raised(a.z0, b.z0) or not self.raised(a.z1, b.z1):
            return "another height"
        if max(self.off(a.start, b.start), self.off(a.end, b.end)) > self.rounding:
            return "another place"
        if a.kind in ("rapid", "feed"):
            return self.within_decimals(a, b)
        p, q = a.arc, b.arc
        if (p.plane, p.ccw, p.turns, (p.sweep > 6.28) == (q.sweep > 6.28)) != (q.plane, q.ccw, q.turns, True):
            return "another arc"
        for k in range(17):
            u, v = p.point(k / 16), q.point(k / 16)
            place = b.frame(v[0], v[1])
            if self.off(u[:2], place) > self.rounding or not self.raised(u[2], v[2]):
                return "another arc"
        return ""

    def same_cycle(self, a, b):
        heights = "" if a.incremental or self.rise is None else "ZR"
        return a.cycle.keys() == b.cycle.keys() and all(
            self.raised(a.cycle[k], b.cycle[k]) if k in heights else a.cycle[k] == b.cycle[k] for k in a.cycle)

    def within_decimals(self, a, b):
        """A written coordinate is the nearest number of its decimals. Steps follow one another instead. The poses of
        solids are changed by more than that."""
        if self.rise is not None or self.mode != "coordinates" or b.incremental or a.end is None or a.start == a.end:
            return ""
        exact = self.moved(a.end)
        for axis, places in enumerate(b.decimals):
            if places is None:
                continue
            if abs(exact[axis] - b.end[axis]) > 0.5 * b.unit * 10.0 ** -places + 1e-9:
                return "a number that is not the nearest of its decimals"
        return ""

    def chords(self, event, written, k):
        end, last = event.arc.point(1), k
        while last < len(written) and written[last].kind == "feed":
            w = written[last]
            if self.off(end[:2], w.end) <= self.rounding and self.raised(end[2], w.z1, 1e-6):
                break
            last += 1
        else:
            return k, "no chord ends where the arc ends"
        count = last + 1 - k
        allowed = self.rounding + self.chord
        before = (written[k].start, written[k].z0)
        for n in range(count):
            w = written[k + n]
            for part in range(1, 9):
                share, here = part / 8, event.arc.point((n + part / 8) / count)
                place = [p + share * (q - p) for p, q in zip((*before[0], before[1]), (*w.end, w.z1))]
                if math.hypot(self.off(here[:2], place[:2]), here[2] + (self.rise or 0) - place[2]) > allowed:
                    return k, "a chord off the arc"
            before = (w.end, w.z1)
            if n and [x for x in w.words if not x.startswith("F")]:
                return k, "a chord with other words"
        first = [x for x in written[k].words if not x.startswith("F")]
        feeds = [float(x[1:]) for x in event.words if x.startswith("F")]
        if first != [x for x in event.words if not x.startswith("F")]:
            return k, "other words beside the first chord"
        for n in range(count if event.feeds else 1):
            theirs = [float(x[1:]) for x in written[k + n].words if x.startswith("F")]
            if len(theirs) != len(feeds) or any(abs(p - f * (count if event.feeds else 1)) > 1e-6 * p
                                                for p, f in zip(theirs, feeds)):
                return k, "another feed"
        return last + 1, ""


def close(a, b, by=1e-9):
    return a == b or (a is not None and b is not None and abs(a - b) <= by)


def differences(original, written, control, pose, rounding, chord=1e-3, mode="coordinates", rise=None):
    """What the rewritten program does otherwise than the original, moved; empty where nothing. `rise` is the shift along
    Z of a solid."""
    return Comparison(pose, rounding, chord, mode, rise).run(read(original, control), read(written, control))
