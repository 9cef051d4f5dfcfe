"""Functions of poses over a box of them, in fractions, as docs/formats.md bounds them."""
from exact_solids import F, cross, dot, plus, times

# m (1 + xx) (level + slope.t + bend uu + (R(x) p).u), where u = at + turn t + around x t.
def form(m, p, at, turn=F(0), level=F(0), slope=[F(0)] * 3, bend=F(0), around=[F(0)] * 3):
    return m, p, at, turn, level, slope, bend, around
def height(m, p, n, more): return form(m, p, n, level=more, slope=n)  # m (n.(R(x) p + t) + more)

def largest(forms, cell):  # the largest Bernstein coefficient of their sum
    values, ends = [], [([lo, (lo + hi) / 2, hi], [lo * lo, lo * hi, hi * hi]) for lo, hi in cell[3:]]
    for t in ([cell[k][n >> k & 1] for k in range(3)] for n in range(8)):
        c, linear, square, mixed = F(0), [F(0)] * 3, [F(0)] * 3, [F(0)] * 3
        for m, p, at, turn, level, slope, bend, around in forms:
            u = plus(plus(at, times(t, turn)), cross(around, t))
            h, along = level + dot(slope, t) + bend * dot(u, u), dot(p, u)
            c += m * (h + along)
            linear = plus(linear, times(cross(p, u), 2 * m))
            square = plus(square, [m * (h - along + 2 * p[k] * u[k]) for k in range(3)])
            mixed = plus(mixed, [2 * m * (p[k - 2] * u[k - 1] + p[k - 1] * u[k - 2]) for k in range(3)])
        for n in range(27):
            x, xx = [[ends[k][one][n // 3 ** k % 3] for k in range(3)] for one in (0, 1)]
            values.append(c + dot(linear, x) + dot(square, xx) + dot(mixed, [x[k - 2] * x[k - 1] for k in range(3)]))
    return max(values)
