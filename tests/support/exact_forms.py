"""Functions of poses over a box of them, in fractions, as docs/formats.md bounds them."""
import math
from exact_solids import F, cross, dot, plus, times

# m (1 + xx) (level + slope.t + bend uu + (R(x) p).u), where u = at + turn t + around x t.
def form(m, p, at, turn=F(0), level=F(0), slope=[F(0)] * 3, bend=F(0), around=[F(0)] * 3):
    return m, p, at, turn, level, slope, bend, around
def height(m, p, n, more): return form(m, p, n, level=more, slope=n)  # m (n.(R(x) p + t) + more)

def largest(forms, cell):  # the largest Bernstein coefficient of their sum
    values, ends = [], [(lo, (lo + hi) / 2, hi) for lo, hi in cell[3:]]
    # Of each axis the coefficients of x and of xx, as whole numbers of 1 / all and of 1 / all / all.
    all = math.lcm(*(x.denominator for three in ends for x in three))
    firsts = [[int(x * all) for x in three] for three in ends]
    seconds = [[lo * lo, lo * hi, hi * hi] for lo, _, hi in firsts]
    for t in ([cell[k][n >> k & 1] for k in range(3)] for n in range(8)):
        c, linear, square, mixed = F(0), [F(0)] * 3, [F(0)] * 3, [F(0)] * 3
        for m, p, at, turn, level, slope, bend, around in forms:
            u = plus(plus(at, times(t, turn)), cross(around, t))
            h, along = level + dot(slope, t) + bend * dot(u, u), dot(p, u)
            c += m * (h + along)
            linear = plus(linear, times(cross(p, u), 2 * m))
            square = plus(square, [m * (h - along + 2 * p[k] * u[k]) for k in range(3)])
            mixed = plus(mixed, [2 * m * (p[k - 2] * u[k - 1] + p[k - 1] * u[k - 2]) for k in range(3)])
        unit = math.lcm(*(x.denominator for x in (c, *linear, *square, *mixed)))
        c, *rest = (x.numerator * (unit // x.denominator) for x in (c, *linear, *square, *mixed))
        linear, square, mixed = [all * x for x in rest[:3]], rest[3:6], rest[6:]
        most = max(dot(linear, x) + dot(square, xx) + dot(mixed, [x[k - 2] * x[k - 1] for k in range(3)])
                   for x, xx in ([[of[k][n // 3 ** k % 3] for k in range(3)] for of in (firsts, seconds)] for n in range(27)))
        values.append(F(c * all * all + most, unit * all * all))
    return max(values)
