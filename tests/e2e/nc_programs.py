"""Programs as posts write them, through the command itself: rewritten or refused as expected, each rewritten
one the moved original for a second reader (tests/support/nc_reader.py), confirmed by `lekalo verify`, and
refuted when a word of it is changed and its digest in the result made to fit.

    nc_programs.py LEKALO SOURCE_DIR

LEKALO_CASES is the number of programs drawn besides those written here, LEKALO_SEED their seed. With
LEKALO_SHARED_DATA the programs of its folder nc are among them.
"""

import hashlib
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile

LEKALO, SOURCE = os.path.abspath(sys.argv[1]), sys.argv[2]
sys.path.insert(0, os.path.join(SOURCE, "tests", "support"))
sys.dont_write_bytecode = True
import nc_reader  # noqa: E402  pylint: disable=wrong-import-position

SEED = int(os.environ.get("LEKALO_SEED", "1"))
CASES = min(int(os.environ.get("LEKALO_CASES", "60")), 60 * int(os.environ.get("LEKALO_TIMES", "1000000")))
SHARED = os.environ.get("LEKALO_SHARED_DATA", "")
LIES = 4
WAIT = 60

PART = "0 0\n80 0\n80 60\n0 60\n"
TURN = 0.58


def blank():
    """The part with 5 mm around it, turned and shifted, so that one place is the best."""
    c, s = math.cos(TURN), math.sin(TURN)
    corners = [(-5, -5), (85, -5), (85, 65), (-5, 65)]
    return "".join(f"{c * x - s * y + 131.7:.4f} {s * x + c * y - 42.3:.4f}\n" for x, y in corners)


def run(folder, *words):
    return subprocess.run([LEKALO, *words], cwd=folder, capture_output=True, text=True, timeout=WAIT, check=False)


class Case:
    """A program, the words of the command beside it, and a part of the sentence that refuses it, or none."""

    def __init__(self, name, text, *words, refused=None, told=(), files=None, said=None):
        self.name, self.text, self.words, self.refused = name, text, words, refused
        self.told, self.files, self.said = told, files or {}, said
        self.chord = 1e-3


HEAD = "G21 G90 G17 G40 G80\nG54\nT1 M6\nS3000 M3\n"
TAIL = "G0 Z20.\nM5\nM30\n"


def own():
    """One program or more for each sentence of docs/design/nc-rewrite.md."""
    move = "G0 X3. Y4.\nG1 Z-1. F200.\nX20.5\nG2 X30.5 Y14. I0. J10.\nG3 X20.5 Y24. R10.\n"
    yield Case("home along Z", HEAD + "G53 G0 Z0.\n" + move + "G28 G91 Z0.\nG90\n" + move +
               "G91 G30 Z0.\nG90\nG30 Z5.\n" + move + "G91\nG28 Z0\nG90\n" + TAIL, "--control", "haas")
    yield Case("home in X and Y after Z", HEAD + move + "G91 G28 Z0.\nG28 X0. Y0.\nG90\n" + TAIL, "--control", "fanuc")
    yield Case("home in X and Y alone", HEAD + move + "G91 G28 X0. Y0.\nG90\n" + TAIL, refused="send Z home")
    yield Case("a point of the machine in X", HEAD + move + "G53 G0 X0.\n" + TAIL, refused="send Z home")
    yield Case("safe lines", "G0 G17 G40 G49 G80 G90 G94 G98\nG21\n" + HEAD + "G90 G80 G40 G49 G17\n" + move + TAIL,
               "--control", "fanuc")
    yield Case("a safe line with other modes", "G00 G17 G21 G40 G49 G54 G64 G80 G90 G97\n" + move + TAIL,
               "--control", "haas")
    yield Case("words that a shop allows", HEAD + "M130\n" + move + "M131 P2\n" + TAIL, "--control", "haas",
               "--allow", "shop.txt", files={"shop.txt": "M130 # the door\nM131\n"})
    yield Case("words that no shop allows", HEAD + "M130\n" + move + TAIL, "--control", "haas", refused="--allow")
    yield Case("the same offset again under g68", HEAD + move + "G54\n" + move + "T2 M6\nG54\n" + move + TAIL,
               "--control", "fanuc", "--nc-mode", "g68")
    yield Case("another offset under g68", HEAD + move + "G55\n" + move + TAIL, "--control", "fanuc",
               "--nc-mode", "g68", refused="G55")
    yield Case("two offsets", HEAD + move + "G55\n" + move + TAIL, "--control", "haas")
    yield Case("feed by turns and by time", HEAD + move + "G95 F.1\nG1 X5.\nG93\nG1 X8. F2.\nG2 X10. I1. F3.\nG94\n"
               "G1 X4. F200.\n" + TAIL, "--control", "haas")
    yield Case("feed by time and an upright arc", HEAD + move + "G93\nG18 G2 X25. Z-1. I2.25 K0. F4.\nG17 G94\n"
               "G1 X4. F200.\n" + TAIL, "--control", "haas")
    yield Case("dwells by P", HEAD + "G4 P1.5\n" + move + "G04 P500\n" + TAIL, "--control", "haas")
    yield Case("dwells by X and U", HEAD + "G4 X1.\n" + move + "G4 U0.5\nG4 P500\n" + TAIL, "--control", "fanuc")
    yield Case("a dwell by X elsewhere", HEAD + "G4 X1.\n" + move + TAIL, "--control", "linuxcnc", refused="G4")
    yield Case("tools", "%\nO1234 (A PART)\n" + HEAD + "T0101\n" + move + "T2\nM6 T2\nT3\n" + move + TAIL + "%\n")
    yield Case("comments of any form", "%\nO0007(NAME)\n(a (b) c)\n( \xe4\xf6\xfc \xd0\x9f )\n" + HEAD + "; all this; too\n" +
               move.replace("\n", " (x;y)\n") + TAIL + "%\n")
    yield Case("comments inside blocks", HEAD + "G1(feed)X3.(to)Y4.F100.\nX5. ; behind X9.\n(MSG, hello)\n" + move + TAIL,
               "--control", "linuxcnc")
    yield Case("a byte order mark and Latin-1", b"\xef\xbb\xbf(\xe9t\xe9)\r\n".decode("latin-1") + HEAD.replace("\n", "\r\n") +
               move + TAIL, told=("byte order mark",))
    yield Case("upright arcs", HEAD + move + "G0 Z5.\nG1 Z2. F90.\nG18 G3 X23.5 Z-1. I3. K0.\nG17 G1 X40.\n"
               "G19 G2 Y27. Z-4. J0. K-3.\nG17 G1 X50.\nG18 G2 X56. Z-4. R5.\nG17\n" + move + TAIL, "--control", "haas")
    yield Case("upright arcs, coarser", HEAD + move + "G18 G3 X23.5 Z2. I0. K3.\nG17 G1 X40.\n" + TAIL,
               "--control", "haas", "--chord-tolerance", "0.05")
    yield Case("M98", "%\nO1\n" + HEAD + "G0 X3. Y4. Z2.\nM98 P100\nM98 P0100 L3\n" + TAIL +
               "O100\nG91 G1 X2. Y1. F100.\nG90\nM99\n%\n", "--control", "fanuc")
    yield Case("M98 in one another", HEAD + "G0 X3. Y4. Z2.\nM98 P100 L2\n" + TAIL +
               "O100\nG91 G1 X2. F100.\nM98 P200\nG90\nM99\nO200\nG2 X2. I1.\nM99\n", "--control", "fanuc")
    yield Case("M98 of another file", HEAD + "M98 P100\n" + TAIL, refused="O100 is not in this file")
    yield Case("M97", HEAD + "G0 X3. Y4. Z2.\nM97 P900 L2\n" + TAIL + "N900 G91 G1 X2. F100.\nG90\nM99\n")
    yield Case("M97 without its block", HEAD + move + "M97 P900\n" + move + TAIL, told=("N900",))
    yield Case("M97 on LinuxCNC", HEAD + "G0 X3. Y4.\nM97 P900\n" + TAIL + "N900 G1 X5. F9.\nM99\n",
               "--control", "linuxcnc", refused="--control haas")
    yield Case("O words", "o<edge> sub\nG1 X[#<_wide>*2] Y3 F100\no<edge> endsub\n" + HEAD +
               "G0 X3 Y4 Z2\n#<_wide>=4\no<edge> call\n#<_wide>=[#<_wide>+1]\no<edge> call\n" + TAIL)
    yield Case("variables", HEAD + "#100=5.\n#101=[#100*2-1/4]\nG0 X#100 Y[#101+SIN[30]] Z2.\nG1 Z-#100 F[#100*20]\n"
               "X[SQRT[16]+ABS[-2]] Y-[#101/3]\nX[ATAN[1]/[1]] Y[COS[60]*FIX[3.7]+FUP[.2]+7 MOD 4]\n" + TAIL,
               "--control", "fanuc")
    yield Case("a variable of the control", HEAD + "G0 X#5221 Y4.\n" + TAIL, refused="#5221")
    yield Case("branches", HEAD + move + "IF [#1 GT 0] GOTO 5\nWHILE [1] DO1\nEND1\nG51 X1.\nM130\n" + TAIL,
               refused="line 10|in line 11, 12|G51|M130")
    holes = "X10. Y12. Z-6. R2.{} F80.\nX20.\nY30.\nX11. Y13.5\nG80\n"
    cycles = "".join(f"G98 {code} " + holes.format(more) for code, more in
                     (("G73", " Q1.5"), ("G81", ""), ("G82", " P500"), ("G83", " Q2."), ("G84", ""), ("G74", ""),
                      ("G85", ""), ("G86", ""), ("G89", " P300"), ("G76", " Q.2"), ("G87", " Q.2"), ("G88", " P1")))
    yield Case("canned cycles of Fanuc", HEAD + move + "G0 Z9.\n" + cycles + "G99 G81 X1. Y2. Z-3. R1. F90. K1\n"
               "G91 X2. Y1. K3\nG90 G80\n" + TAIL, "--control", "fanuc")
    yield Case("canned cycles of Haas", HEAD + move + "G0 Z9.\n" + cycles + "G83 X1. Y2. Z-9. R1. I3. J.5 K1. F90.\n"
               "G91 G81 X2. Y1. Z-3. R-1. L3\nG90 G80\n" + TAIL, "--control", "haas")
    yield Case("canned cycles of LinuxCNC", HEAD + "G0 X1 Y1 Z9\nG98 G81 X10 Y12 Z-6 R2 F80\nX20\nG82 X3 Z-2 R1 P.5\n"
               "G91 G83 X2 Y1 Z-3 R-1 Q1 L3\nG90 G80\nG0 Z9\n" + TAIL, "--control", "linuxcnc")
    yield Case("K beside a cycle on Haas is no number of holes", HEAD + "G0 X1. Y1. Z9.\nG81 X1. Y2. Z-3. R1. F90. K3\n" +
               TAIL, "--control", "haas", refused="K ")
    yield Case("guessed and told", HEAD + move + TAIL, told=("--control",))
    yield Case("GRBL", "G21 G90 G17 G94\nG54\nM3 S500\nG0 X1 Y1 Z2\nG1 Z-1 F90\nG2 X5 I2\nG93\nG1 X7 F2\nG94\nM5\nM2\n",
               "--control", "grbl")
    yield Case("cycles on GRBL", HEAD + "G81 X1 Y2 Z-3 R1 F9\n" + TAIL, "--control", "grbl", refused="--control linuxcnc")
    yield Case("Siemens", "N10 G54\nN20 TRANS X10\nN30 G0 X1 Y1\nN40 CYCLE83(5,0,2,-10)\n", refused="Siemens")
    yield Case("Siemens, a message", "%_N_PART_MPF\n;$PATH=/_N_MPF_DIR\nG0 X1 Y1\nM30\n", refused="Siemens")
    yield Case("Heidenhain", "0 BEGIN PGM PART MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n2 TOOL CALL 1 Z S3000\n"
               "3 L X+10 Y+10 R0 FMAX M3\n4 END PGM PART MM\n", refused="Heidenhain")
    yield Case("all unknown words", HEAD + move + "M130\nG51 X2.\nG92 X0.\nM131\nM130\nG12 I3.\nG43.4 H1\n" + TAIL,
               "--control", "haas", refused="M130|G51|G92|M131|G12|G43.4|lines 10, 14|--allow")
    yield Case("unknown words and broken ones", HEAD + "M130\nG0 X@3\nG1 X1..2\nG51\nX5. #\n" + TAIL, "--control",
               "haas", refused="line 5|line 6|line 7|line 8")
    yield Case("cutter compensation", HEAD + "G0 X-9. Y-9. Z2.\nG1 Z-1. F90.\nG41 D1 X0.\nY20.\nG2 X10. Y30. I10.\n"
               "G1 X40.\nG40 X50. Y50.\n" + TAIL, "--control", "haas")
    yield Case("inches", HEAD.replace("G21", "G20") + "G0 X.3 Y.4\nG1 Z-.1 F9.\nX2.05\nG2 X3.05 Y1.4 J1.\n" + TAIL)
    yield Case("steps", HEAD + "G0 X3. Y4.\nG91 G1 X2. F90.\nY3.\nG2 X4. R2.\nX1. Y1. I.5 J.5\nG90 G0 X0. Y0.\n" + TAIL)
    yield Case("frame of LinuxCNC", HEAD + move + TAIL, "--control", "linuxcnc", "--nc-mode", "offset")
    yield Case("blocks that may be skipped", HEAD + "/M8\n" + move + "/ N5 M1\n" + TAIL)
    yield Case("moves that may be skipped", HEAD + "/G0 X5. Y5.\n" + move + TAIL, refused="/")
    yield Case("look-ahead and rotary axes at rest", "O0003\n" + HEAD + "G05.1 Q1\n" + move + "G0 A0. B0.\n" + TAIL)
    yield Case("a rotary axis alone", HEAD + move + "G0 Z5.\nB0.\nX9. Y8.\nG1 Z-1. F90.\nA0. C0.\nX20.\n" + TAIL,
               told=("must stand at 0",))
    yield Case("a rotary axis alone under an arc", HEAD + move + "B0.\n" + TAIL, refused=":10:|write G0 before it")
    yield Case("modes of Haas", HEAD + "G103 P1\nG187 P3 E.01\nM31\nM33\nM88\nM89\nM41\nM19\nG69 G50\n" + move + TAIL,
               "--control", "haas")
    yield Case("polar words", HEAD + "G16\nG0 X10. Y30.\nG15\n" + TAIL, "--control", "fanuc", refused="polar")


class Drawn:
    """A random program in the words of one control."""

    def __init__(self, control, random_):
        self.control, self.random = control, random_
        self.mills = control != "grbl"
        self.lines, self.x, self.y, self.z, self.steps = [], 0.0, 0.0, 20.0, False
        self.tail = []

    def pick(self, *words):
        return self.random.choice(words)

    def number(self, value):
        text = f"{value:.4f}".rstrip("0")
        return text if self.random.random() < 0.9 or not text.endswith(".0") else text[:-2]

    def to(self, x, y):
        x, y = round(x, 4), round(y, 4)
        dx, dy = (x - self.x, y - self.y) if self.steps else (x, y)
        self.x, self.y = x, y
        return f"X{self.number(dx)} Y{self.number(dy)}"

    def place(self):
        return self.random.uniform(-40, 120), self.random.uniform(-40, 90)

    def write(self):
        say = self.lines.append
        if self.mills and self.control != "linuxcnc" and self.random.random() < 0.7:
            say("%")
            say(self.pick("O1234 (A PART)", "O0001", "O12345"))
        say(self.pick("G21 G90 G17 G40 G80 G94", "G20 G90 G17 G40 G94",
                      "G17 G21 G40 G80 G90 G94" if self.control == "linuxcnc" else "G0 G17 G21 G40 G80 G90 G94"))
        say(self.pick("G54", "", "(a comment; of words)"))
        if self.mills:
            say(self.pick("T1 M6", "M6 T2", "T3 M06"))
        say("S2000 M3")
        say("F150.")
        if self.mills:
            say(self.pick("G43 H1", "", "G49"))
        say("G0 " + self.to(*self.place()))
        say("G0 Z5.")
        self.z = 5.0
        for _ in range(self.random.randint(4, 25)):
            self.item()
        if self.steps:
            say("G90")
        say("G0 Z20.")
        say(self.pick("M30", "M2"))
        self.lines += self.tail
        if self.lines[0] == "%":
            say("%")
        end = self.pick("\n", "\n", "\r\n")
        return end.join(self.lines) + end

    def item(self):
        items = [self.line, self.line, self.line, self.arc, self.arc, self.radius, self.rest, self.rest, self.distance,
                 self.upright, self.home]
        if self.mills:
            items += [self.holes, self.holes, self.tool, self.call, self.variable, self.offset]
        self.random.choice(items)()

    def line(self):
        words = self.pick("G1", "G01", "G0", "g1") + " "
        x, y = self.place()
        if self.random.random() < 0.3:
            words += self.to(x, self.y).split()[0]
        elif self.random.random() < 0.3:
            words += self.to(self.x, y).split()[1]
        else:
            words += self.to(x, y)
        if self.random.random() < 0.3:
            words += " Z-.5" if self.steps else " Z-1.5"
        self.lines.append(words)

    def arc(self):
        r, begin, sweep = self.random.uniform(0.5, 30), self.random.uniform(0, 6.28), self.random.uniform(0.05, 6.2)
        i, j = round(-r * math.cos(begin), 4), round(-r * math.sin(begin), 4)
        way = self.pick(-1, 1)
        words = f"{'G3' if way > 0 else 'G02'} "
        if self.random.random() < 0.8:
            out = math.hypot(i, j)
            angle = math.atan2(-j, -i) + way * sweep
            words += self.to(self.x + i + out * math.cos(angle), self.y + j + out * math.sin(angle)) + " "
        words += f"I{self.number(i)} J{self.number(j)}" + self.pick("", "", " Z-2." if not self.steps else " Z-.25")
        self.lines.append(words)

    def radius(self):
        chord, angle = self.random.uniform(0.5, 30), self.random.uniform(0, 6.28)
        words = f"{self.pick('G2', 'G3')} " + self.to(self.x + chord * math.cos(angle), self.y + chord * math.sin(angle))
        self.lines.append(words + f" R{self.pick('', '-')}{chord * self.random.uniform(0.51, 2):.4f}")

    def rest(self):
        common = ["M8", "M9", "S1500", "F120.", "(note)", "G4 P1.", "M3 S900", "N50", "/M8", "M1", "G94", "G17", "G40"]
        theirs = {"haas": ["M31", "M33", "M88", "M89", "G187 P2", "G103 P1", "G103", "M19", "M41", "M10", "M11", "G50",
                           "G69", "(a (b) c)", "G64", "G61", "M138", "M139", "G97 S800", "A0."],
                  "fanuc": ["G4 X1.", "G4 U.5", "M29 S300", "G5.1 Q1", "G5.1 Q0", "M19", "G69", "G50", "M10", "M48",
                            "G64", "G61", "(a (b) c)", "G97 S800", "B0."],
                  "linuxcnc": ["G64 P0.01", "G61", "G61.1", "M48", "M49", "M64 P1", "G97 S900", "G91.1", "(MSG, hi)"],
                  "grbl": ["G61", "M7", "G91.1"]}
        word = self.random.choice(common + 2 * theirs[self.control])
        self.lines.append(f"G0 {word}" if word in ("A0.", "B0.") and self.on_arc() else word)

    def on_arc(self):
        """A rotary word alone is read under G0 and G1 only."""
        return re.findall(r"(?i)G0?([0-3])(?![\d.])", " ".join(self.lines))[-1] in "23"

    def distance(self):
        self.steps = not self.steps
        self.lines.append("G91" if self.steps else "G90")

    def upright(self):
        """A quarter in G18 or G19, then back in the plane."""
        if self.steps:
            self.distance()
        self.lines.append("G1 Z3.")
        self.lines.append(self.pick(f"G18 G3 X{self.number(self.x + 3)} Z0. I3. K0.",
                                    f"G18 G2 X{self.number(self.x + 3)} Z6. I3. K0.",
                                    f"G19 G2 Y{self.number(self.y + 3)} Z6. J3. K0.",
                                    f"G19 G3 Y{self.number(self.y + 3)} Z0. J3. K0."))
        self.lines.append("G17")
        self.lines.append("G1 " + self.to(*self.place()))

    def home(self):
        self.lines += [*self.pick(("G90", "G53 G0 Z0."), ("G91 G28 Z0.", "G90"), ("G28 Z15.",), ("G91", "G30 Z0.", "G90"),
                                  ("G91 G28 Z0.", "G28 X0. Y0.", "G90")), "G90"]
        self.steps = False
        self.lines.append("G0 " + self.to(*self.place()))
        self.lines.append("Z5.")

    def holes(self):
        if self.steps:
            self.distance()
        self.lines.append("G0 Z9.")
        codes = ["G81", "G82 P.5", "G83 Q1.5", "G73 Q1.", "G84", "G85", "G86 P.3", "G89 P.2"]
        if self.control in ("haas", "fanuc"):
            codes += ["G74", "G76 Q.2", "G87 Q.3", "G88 P.1", "G81 P.2"]
        if self.control == "haas":
            codes += ["G83 I2. J.5 K.5", "G73 I2. J.5 K.5"]
        self.lines.append(f"{self.pick('G98', 'G99')} {self.random.choice(codes)} {self.to(*self.place())} Z-4. R2.")
        for _ in range(self.random.randint(0, 3)):
            self.lines.append(self.to(*self.place()))
        if self.random.random() < 0.3:
            repeat = "K" if self.control == "fanuc" and self.random.random() < 0.7 else "L"
            self.lines.append(f"G91 X2.5 Y-1.25 {repeat}{self.random.randint(1, 4)}")
            self.lines.append("G90")
        self.lines.append("G80")
        self.lines.append("G0 Z9.")
        self.lines.append("G0 " + self.to(*self.place()))

    def tool(self):
        self.lines += [f"T{self.random.randint(1, 9)} M6", "M3 S1000", "G90", "G0 " + self.anew(), "G43 H2 Z12."]

    def anew(self):
        self.steps = False
        return self.to(*self.place())

    def offset(self):
        self.lines += [self.pick("G55", "G54", "G56"), "G90", "G0 " + self.anew(), "Z7."]

    def variable(self):
        if self.steps:
            self.distance()
        a, b = self.random.uniform(1, 9), self.random.uniform(1, 9)
        self.lines += [f"#101={a:.3f}", f"#102=[#101*2+{b:.3f}]", "G1 X[#102-#101/4] Y-#101", "G0 " + self.to(*self.place())]

    def call(self):
        if self.steps:
            self.distance()
        name = str(500 + len(self.tail))
        body = ["G91", "G1 X1.5 Y.25", "G2 X2. R1.", "G90"]
        if self.control == "haas" and self.random.random() < 0.5:
            self.tail += [f"N{name}", *body, "M99"]
            self.lines.append(f"M97 P{name} L2")
        else:
            self.tail += [f"O{name}", *body, "M99"]
            self.lines.append(f"M98 P{name}")
        self.lines.append("G0 " + self.to(*self.place()))


class Check:
    def __init__(self, folder):
        self.folder, self.faults, self.rewritten, self.refused, self.lies, self.open_lies = folder, [], 0, 0, 0, 0

    def fault(self, case, what):
        self.faults.append(f"{case.name}: {what}")
        print(f"FAULT {case.name}: {what}\n--- original\n{case.text}", flush=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "wb") as file:
            file.write(text.encode("latin-1", "replace") if isinstance(text, str) else text)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read().decode("latin-1")

    def run(self, case):
        self.write("in.nc", case.text)
        for name, text in case.files.items():
            self.write(name, text)
        for name in ("out.nc", "r.json"):
            if os.path.exists(self.path(name)):
                os.remove(self.path(name))
        ran = run(self.folder, "locate", "--part", "part.csv", "--blank", "blank.csv", "--nc", "in.nc", "--nc-out",
                  "out.nc", "-o", "r.json", *case.words)
        if case.refused is not None:
            self.refused += 1
            missing = [word for word in case.refused.split("|") if word not in ran.stderr]
            if ran.returncode != 3 or missing or os.path.exists(self.path("out.nc")):
                self.fault(case, f"exit {ran.returncode}, without {missing}: {ran.stderr}")
            return None
        if ran.returncode != 0:
            self.fault(case, f"exit {ran.returncode}: {ran.stderr}")
            return None
        self.rewritten += 1
        with open(self.path("r.json"), encoding="utf-8") as file:
            result = json.load(file)
        for word in case.told:
            if word not in ran.stderr and word not in json.dumps(result["nc"]["notes"]):
                self.fault(case, f"{word} is not told")
        self.compare(case, result)
        return result

    def compare(self, case, result):
        nc = result["nc"]
        written = self.read("out.nc")
        chord = float(case.words[case.words.index("--chord-tolerance") + 1]) if "--chord-tolerance" in case.words else 1e-3
        try:
            what = nc_reader.differences(case.text, written, nc["control"], (result["x"], result["y"], result["theta"]),
                                         nc["rounding_mm"], chord, nc["mode"])
        except Exception as error:  # pylint: disable=broad-except
            what = f"the second reader: {type(error).__name__} {error}"
        if what:
            self.fault(case, f"{what}\n--- written\n{written}")
        verified = run(self.folder, "verify", "r.json")
        if verified.returncode != 0:
            self.fault(case, f"verify gives {verified.returncode}: {verified.stdout}{verified.stderr}\n--- written\n{written}")
        else:
            self.lie(case, result, written)

    def lie(self, case, result, written):
        """Changes a word of the written program, and its digest in the result."""
        rng = random.Random(f"{SEED} {case.name}")
        for _ in range(LIES):
            changed = lie_about(written, rng, result["nc"]["rounding_mm"])
            if changed is None:
                continue
            text, what = changed
            self.write("out.nc", text)
            forged = json.loads(json.dumps(result))
            forged["nc"]["output"]["sha256"] = hashlib.sha256(text.encode("latin-1")).hexdigest()
            if "bytes" in forged["nc"]["output"]:
                forged["nc"]["output"]["bytes"] = len(text.encode("latin-1"))
            self.write("f.json", json.dumps(forged))
            verified = run(self.folder, "verify", "f.json")
            self.lies += 1
            if verified.returncode == 0:
                self.fault(case, f"verify confirms {what}\n--- written\n{written}")
            elif verified.returncode == 1:
                self.open_lies += 1
        self.write("out.nc", written)


def said_again(lines):
    """True where G90 or G91 is said again before a word depends on it."""
    for line in lines:
        code = nc_reader.without_comments(line.upper(), "linuxcnc")
        if re.search(r"G9[01](?!\d|\.)", code):
            return True
        if re.search(r"[XYZIJ]\s*[-+.\d]", code):
            return False
    return True


def lie_about(text, rng, rounding):
    """Changes one word of a block: a number, a code, or the block itself."""
    lines = text.split("\n")
    places = []
    for at, line in enumerate(lines):
        code = nc_reader.without_comments(line.rstrip("\r"), "linuxcnc")
        if "(" in line or ";" in line or not re.search(r"[GMXYZIJKRPQFSTHLD]\s*[-+.\d]", code) or code.strip().startswith("/"):
            continue
        places += [(at, m) for m in re.finditer(r"([GMXYZIJKRPQFSTHLD])\s*([-+]?[\d.]+)", line, re.I)]
    if not places:
        return None
    at, match = rng.choice(places)
    letter, number = match.group(1).upper(), match.group(2)
    line = lines[at]
    if letter == "G":
        others = {"0": "1", "00": "01", "1": "0", "01": "0", "2": "3", "02": "3", "3": "2", "90": "91", "91": "90", "20": "21",
                  "21": "20", "54": "55", "81": "85", "98": "99", "99": "98", "83": "81", "82": "81"}
        moves = re.search(r"[XYZIJ]\s*[-+.\d]", nc_reader.without_comments(line.upper(), "linuxcnc"))
        if number not in others or (float(number) < 4 and not moves):
            return None  # without a place a motion word may say what the next one says again
        if number in ("90", "91") and not moves and said_again(lines[at + 1:]):
            return None
        new = others[number]
    elif letter == "M":
        new = {"3": "4", "8": "9", "9": "8", "5": "3", "30": "2", "6": "1"}.get(number)
        if new is None:
            return None
    elif letter in "STHDLPQ" and float(number) == int(float(number)):
        new = str(int(float(number)) + 1)
    else:
        new = f"{float(number) + rng.choice((-1, 1)) * (20 * rounding + rng.choice((1e-3, 0.1, 3))):.6f}"
    lines[at] = line[:match.start(2)] + new + line[match.end(2):]
    return "\n".join(lines), f"line {at + 1}: {letter}{number} -> {letter}{new}"


def posts():
    """The programs of the shared data."""
    refused = {"06": "send Z home", "08": "O2000", "21": "G43.4", "30": "G10", "32": "G92", "34": "G54.1", "37": "G65",
               "44": "GOTO", "52": "G70", "70": "M130", "74": "O words"}
    for kind in ("fusion", "variants"):
        folder = os.path.join(SHARED, "nc", kind)
        for name in sorted(os.listdir(folder)):
            with open(os.path.join(folder, name), "rb") as file:
                text = file.read().decode("latin-1")
            yield Case(f"{kind}/{name}", text, refused=refused.get(name[:2]) if kind == "variants" else None)


def drawn():
    for k in range(CASES):
        control = ("haas", "fanuc", "linuxcnc", "grbl")[k % 4]
        rng = random.Random(f"{SEED} {k}")
        text = Drawn(control, rng).write()
        yield Case(f"drawn {SEED} {k}", text, "--control", control)


def main():
    with tempfile.TemporaryDirectory(prefix="lekalo-nc-") as folder:
        check = Check(folder)
        check.write("part.csv", PART)
        check.write("blank.csv", blank())
        for case in [*own(), *(posts() if SHARED else ()), *drawn()]:
            check.run(case)
    print(f"{check.rewritten} rewritten, {check.refused} refused, {check.lies} changed words, of which "
          f"{check.open_lies} left open; {len(check.faults)} faults")
    if check.faults:
        print("\n".join(fault.split("\n")[0] for fault in check.faults))
    return 1 if check.faults else 0


if __name__ == "__main__":
    sys.exit(main())
