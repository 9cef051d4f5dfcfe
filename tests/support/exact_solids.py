"""Vectors and closed meshes in fractions, for what holds claims about solids against docs/formats.md."""
import math, operator, struct
from fractions import Fraction as F

def dot(a, b): return sum(map(operator.mul, a, b))
def plus(a, b): return list(map(operator.add, a, b))
def sub(a, b): return list(map(operator.sub, a, b))
def times(a, m): return [x * m for x in a]
def cross(a, b): return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
def normal(t): return cross(sub(t[1], t[0]), sub(t[2], t[0]))
def sign(x): return (x > 0) - (x < 0)
def stl(path):
    data = open(path, "rb").read()[84:]
    return [[[F(x) for x in row[k:k + 3]] for k in (3, 6, 9)] for *row, _ in struct.iter_unpack("<12fH", data)]
def product(a, b):  # of quaternions
    return [a[0] * b[0] - dot(a[1:], b[1:])] + plus(plus(times(b[1:], a[0]), times(a[1:], b[0])), cross(a[1:], b[1:]))
def turned(q, p): return times(product(product(q, [0] + p), q[:1] + times(q[1:], -1))[1:], 1 / dot(q, q))

def root(x, up=False):  # exactly, or to 40 places
    n = x.numerator * x.denominator * 10 ** 80
    r = math.isqrt(n)
    return F(r + (up and r * r != n), x.denominator * 10 ** 40)

def squared_distance(p, t):
    n = normal(t)
    if any(n) and all(dot(n, cross(sub(t[k - 2], t[k]), sub(p, t[k]))) >= 0 for k in range(3)):
        return dot(n, sub(p, t[0])) ** 2 / dot(n, n)
    def way(w, e): return sub(w, times(e, min(max(dot(w, e) / (dot(e, e) or 1), 0), 1)))  # of doubles too
    return min(dot(w, w) for w in (way(sub(p, t[k]), sub(t[k - 2], t[k])) for k in range(3)))

def inside(p, mesh):  # straight up from p, which counts as moved by a trifle along y and by less along x
    def turn(a, b):
        e, w = sub(b, a), sub(p, a)
        return sign(e[0] * w[1] - e[1] * w[0]) or sign(e[0]) or -sign(e[1])
    def over(t):  # else no point of it is above or below p
        return all(min(q[k] for q in t) <= p[k] <= max(q[k] for q in t) for k in (0, 1))
    around = [(t, {turn(t[k], t[k - 2]) for k in range(3)}) for t in mesh if over(t)]
    return sum(sides == {-sign(dot(normal(t), sub(p, t[0])))} != {0} for t, sides in around) % 2 == 1

def ball_holds(ball, mesh, wanted):
    p, square = ball[:3], ball[3] ** 2
    def off(t): return sum(max(min(c) - x, x - max(c), 0) ** 2 for x, c in zip(p, zip(*t)))  # the box of t at least
    squares = [squared_distance(p, t) for t in mesh if off(t) <= square]
    return all(far >= square for far in squares) and (0 in squares or inside(p, mesh) == wanted)
