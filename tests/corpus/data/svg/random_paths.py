#!/usr/bin/python3
"""Writes random.svg: paths of all commands in every spelling, under chains of transforms. The same every time."""
import pathlib, random

r = random.Random(7)


def number():
    v = r.choice([r.uniform(-40, 40), round(r.uniform(-40, 40)), round(r.uniform(-1, 1), 2), r.uniform(-4e4, 4e4) / 1000])
    text = r.choice([f"{v:.6g}", f"{v:.3f}", f"{v:.2e}", f"{v:+.4f}"])
    if r.random() < 0.5 and "e" not in text:
        text = text.replace("0.", ".") if text.startswith(("0.", "-0.", "+0.")) else text
    return text


def joined(parts):
    text = parts[0]
    for part in parts[1:]:
        glue = r.choice([" ", ",", " , ", "\n", ""])
        if glue == "" and not (part[0] in "+-" or (part[0] == "." and ("." in text.split()[-1] or "e" in text[-4:]))):
            glue = " "
        if glue == "" and part[0] == "." and "." not in text[-3:]:
            glue = " "
        text += glue + part
    return text


def command(letter):
    upper = letter.upper()
    count = r.choice([1, 1, 1, 2, 3])
    parts = []
    for _ in range(count):
        if upper == "A":
            # Radii that are too small: svgelements makes them larger by a little more than needed.
            end = [number(), number()]
            least = 0.55 * (float(end[0]) ** 2 + float(end[1]) ** 2) ** 0.5 + 1
            radii = [f"{r.uniform(least, 60 + least):.5g}", f"{r.uniform(least, 60 + least):.5g}"]
            if r.random() < 0.4:
                radii[1] = radii[0]
            flags = r.choice("01") + r.choice(["", " ", ","]) + r.choice("01")
            parts += [radii[0], radii[1], f"{r.uniform(-200, 200):.4g}", flags + " " + end[0], end[1]]
        else:
            parts += [number() for _ in range({"M": 2, "L": 2, "T": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4}[upper])]
    return letter + r.choice(["", " "]) + joined(parts)


def transform():
    def one():
        n = lambda low, high: f"{r.uniform(low, high):.5g}"
        return r.choice([
            lambda: f"translate({n(-50, 50)},{n(-50, 50)})", lambda: f"translate({n(-50, 50)})",
            lambda: f"scale({n(0.3, 3)})", lambda: f"scale({n(0.3, 3)} {n(-3, -0.3)})",
            lambda: f"rotate({n(-180, 180)})", lambda: f"rotate({n(-180, 180)}, {n(-50, 50)}, {n(-50, 50)})",
            lambda: f"skewX({n(-50, 50)})", lambda: f"skewY({n(-50, 50)})",
            lambda: f"matrix({n(0.5, 2)} {n(-1, 1)} {n(-1, 1)} {n(0.5, 2)} {n(-50, 50)} {n(-50, 50)})"])()
    return r.choice([" ", ", "]).join(one() for _ in range(r.choice([0, 1, 1, 2, 3])))


lines = ['<svg xmlns="http://www.w3.org/2000/svg" width="500mm" height="400mm" viewBox="0 0 500 400">']
for i in range(200):
    data = command(r.choice("Mm"))
    last = "M"
    for _ in range(r.randrange(1, 8)):
        letter = r.choice("LlHhVvCcSsQqTtaaMm")
        # After a curve of the other degree there is no control point to mirror; svgelements takes that one.
        if (letter in "Ss" and last in "QT") or (letter in "Tt" and last in "CS"):
            letter = "l"
        closing = r.random() < 0.1
        last = "Z" if closing else letter.upper()
        data += r.choice(["", " "]) + (r.choice("Zz") if closing else command(letter))
    lines.append(f'<path id="p{i}" transform="{transform()}" d="{data}"/>')
lines.append("</svg>")
pathlib.Path(__file__).with_name("random.svg").write_text("\n".join(lines) + "\n")
