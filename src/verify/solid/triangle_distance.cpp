#include "triangle_distance.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

using NearTriangle = std::array<Near3, 3>;

NearTriangle middle_of(const Triangle3& t) {
  NearTriangle middle{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) middle[k][axis] = t[k][axis].low / 2 + t[k][axis].high / 2;
  return middle;
}

/// A point of a triangle: the shares of its corners.
using Shares = Near3;

/// Two nearest points of two triangles, as far as doubles tell.
struct Proposal {
  double squared = kInfinity;
  Shares a{}, b{};
};

Near3 point_at(const NearTriangle& t, const Shares& shares) {
  return t[0] * shares[0] + t[1] * shares[1] + t[2] * shares[2];
}

class Proposer {
 public:
  Proposer(const NearTriangle& a, const NearTriangle& b) : a_(a), b_(b) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) edges(i, j);
    for (std::size_t k = 0; k < 3; ++k) {
      face(b_, a_[k], [&](const Shares& shares) { take(corner(k), shares); });
      face(a_, b_[k], [&](const Shares& shares) { take(shares, corner(k)); });
      pierce(a_, b_, k, [&](const Shares& edge, const Shares& shares) { take(edge, shares); });
      pierce(b_, a_, k, [&](const Shares& edge, const Shares& shares) { take(shares, edge); });
    }
  }
  [[nodiscard]] const Proposal& best() const { return best_; }

 private:
  static Shares corner(std::size_t k) {
    Shares shares{};
    shares[k] = 1;
    return shares;
  }
  static Shares on_edge(std::size_t k, double share) {
    Shares shares{};
    shares[k] = 1 - share;
    shares[(k + 1) % 3] = share;
    return shares;
  }

  void take(const Shares& a, const Shares& b) {
    const Near3 way = point_at(b_, b) - point_at(a_, a);
    if (const double squared = dot(way, way); squared < best_.squared) best_ = {squared, a, b};
  }

  void edges(std::size_t i, std::size_t j) {
    const Near3 u = a_[(i + 1) % 3] - a_[i], v = b_[(j + 1) % 3] - b_[j], w = b_[j] - a_[i];
    const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
    // Any place is one to begin at where edges are parallel or without length, so that 0 may divide.
    const auto within = [](double x) { return std::max(0.0, std::min(x, 1.0)); };  // NaN becomes 0
    const double from = within((uw * vv - vw * uv) / (uu * vv - uv * uv)), t = within((from * uv - vw) / vv);
    take(on_edge(i, within((t * uv + uw) / uu)), on_edge(j, t));
  }

  /// Takes the foot of a point on the inside of a triangle.
  template <class Take>
  static void face(const NearTriangle& t, const Near3& p, const Take& take) {
    const Near3 n = normal(t);
    Shares shares{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Near3& from = t[(k + 1) % 3];
      shares[k] = dot(n, cross(t[(k + 2) % 3] - from, p - from));
      if (!(shares[k] > 0)) return;
    }
    take(shares * (1 / (shares[0] + shares[1] + shares[2])));
  }

  /// Takes the point where edge k of one triangle passes through the other.
  template <class Take>
  static void pierce(const NearTriangle& edge, const NearTriangle& t, std::size_t k, const Take& take) {
    const Near3 &from = edge[k], &to = edge[(k + 1) % 3];
    const Near3 n = normal(t);
    const double before = dot(n, from - t[0]), after = dot(n, to - t[0]);
    if (!(before * after < 0)) return;
    const double share = before / (before - after);
    const Near3 p = from * (1 - share) + to * share;
    face(t, p, [&](const Shares& shares) { take(on_edge(k, share), shares); });
  }

  const NearTriangle &a_, &b_;
  Proposal best_;
};

/// Returns a number that the distance of the triangles is not below: the gap between them along a direction.
double gap_along(const Near3& direction, const Triangle3& a, const Triangle3& b) {
  const Vec3 n{just(direction[0]), just(direction[1]), just(direction[2])};
  Span of_a = dot(n, a[0]), of_b = dot(n, b[0]);
  for (std::size_t k = 1; k < 3; ++k) {
    const Span x = dot(n, a[k]), y = dot(n, b[k]);
    of_a = {std::min(of_a.low, x.low), std::max(of_a.high, x.high)};
    of_b = {std::min(of_b.low, y.low), std::max(of_b.high, y.high)};
  }
  const double between = std::max(step_down(of_b.low - of_a.high), step_down(of_a.low - of_b.high));
  return std::max(0.0, (just(between) / length(n)).low);
}

Vec3 point_at(const Triangle3& t, const Shares& shares) {
  const Span sum = just(shares[0]) + just(shares[1]) + just(shares[2]);
  Vec3 p{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    p[axis] =
        (t[0][axis] * just(shares[0]) + t[1][axis] * just(shares[1]) + t[2][axis] * just(shares[2])) / sum;
  return p;
}

// ---- exactly ----------------------------------------------------------------------------------------------

using WholeTriangle = std::array<Whole3, 3>;

/// Makes the unit 1 / unit one that every coordinate is a multiple of.
template <std::size_t Count>
void refine(Integer& unit, const std::array<Exact3, Count>& points) {
  for (const Exact3& p : points)
    for (const Fraction& x : p) unit = lcm(unit, x.get_den());
}
template <std::size_t Count>
std::array<Whole3, Count> whole(const std::array<Exact3, Count>& points, const Integer& unit) {
  std::array<Whole3, Count> made;
  for (std::size_t k = 0; k < Count; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      made[k][axis] = points[k][axis].get_num() * (unit / points[k][axis].get_den());
  return made;
}

/// The least of squared lengths, as a fraction that is not reduced.
class Least {
 public:
  void take(const Integer& numerator, const Integer& denominator) {
    if (numerator * denominator_ < numerator_ * denominator)
      numerator_ = numerator, denominator_ = denominator;
  }
  [[nodiscard]] Fraction value() const {
    Fraction value(numerator_, denominator_);
    value.canonicalize();
    return value;
  }

 private:
  Integer numerator_ = 1, denominator_ = 0;
};

/// Says whether a share of a length is of its inside; nothing is of a length of 0.
bool is_within(const Integer& share, const Integer& all) {
  return sgn(share) * sgn(Integer(all - share)) > 0;
}

/// Takes the first end of an edge and its inside; its other end is the first one of the next.
void to_edge(const Whole3& p, const Whole3& from, const Whole3& to, Least& least) {
  const Whole3 along = to - from, way = p - from;
  least.take(dot(way, way), 1);
  const Integer all = dot(along, along);
  if (!is_within(dot(way, along), all)) return;
  const Whole3 across = cross(way, along);
  least.take(dot(across, across), all);
}

/// Takes the insides of two edges.
void between_edges(const Whole3& a, const Whole3& b, const Whole3& c, const Whole3& d, Least& least) {
  const Whole3 u = b - a, v = d - c, w = c - a, n = cross(u, v);
  const Integer all = dot(n, n);  // 0 where they are parallel
  if (!is_within(dot(cross(w, v), n), all) || !is_within(dot(cross(w, u), n), all)) return;
  const Integer height = dot(w, n);
  least.take(height * height, all);
}

/// Takes the inside of a triangle.
void to_face(const Whole3& p, const WholeTriangle& t, Least& least) {
  const Whole3 n = normal(t);
  for (std::size_t k = 0; k < 3; ++k)
    if (dot(n, cross(t[(k + 1) % 3] - t[k], p - t[k])) <= 0) return;
  const Integer height = dot(n, p - t[0]);
  least.take(height * height, dot(n, n));
}

/// Says whether the edge passes from one side of the triangle's plane to the other through its inside.
bool pierces(const Whole3& from, const Whole3& to, const WholeTriangle& t) {
  const Whole3 n = normal(t);
  const auto height = [&](const Whole3& p) { return sgn(dot(n, p - t.front())); };
  if (height(from) * height(to) >= 0) return false;
  const auto side = [&](std::size_t k) {
    return sgn(dot(cross(t[k] - from, t[(k + 1) % 3] - from), to - from));
  };
  return side(0) == side(1) && side(1) == side(2);
}

}  // namespace

Span distance(const Triangle3& a, const Triangle3& b, double limit) {
  ask();
  const NearTriangle near_a = middle_of(a), near_b = middle_of(b);
  const Proposal best = Proposer(near_a, near_b).best();
  double low = gap_along(point_at(near_b, best.b) - point_at(near_a, best.a), a, b);
  if (low > limit) return {low, kInfinity};
  // Along a face that both lie flat to, its own normal is more exact than the way between two points.
  for (const NearTriangle* t : {&near_a, &near_b}) low = std::max(low, gap_along(normal(*t), a, b));
  if (low > limit) return {low, kInfinity};
  const double high = length(point_at(b, best.b) - point_at(a, best.a)).high;
  return {low, std::isnan(high) ? kInfinity : high};
}

ExactDistance exact_distance(const ExactTriangle& a, const ExactTriangle& b) {
  ask(50);
  Integer unit = 1;
  for (const ExactTriangle* t : {&a, &b}) refine(unit, *t);
  const WholeTriangle s = whole(a, unit), t = whole(b, unit);
  ExactDistance found;
  Least least;
  for (std::size_t i = 0; i < 3; ++i) {
    const Whole3 &from = s[i], &to = s[(i + 1) % 3];
    to_face(s[i], t, least);
    to_face(t[i], s, least);
    for (std::size_t j = 0; j < 3; ++j) {
      const Whole3 &begin = t[j], &end = t[(j + 1) % 3];
      to_edge(s[i], begin, end, least);
      to_edge(t[j], from, to, least);
      between_edges(from, to, begin, end, least);
    }
    if (pierces(from, to, t) || pierces(t[i], t[(i + 1) % 3], s)) {
      least.take(0, 1);
      found.pierces = true;
    }
  }
  found.squared = least.value() / Fraction(unit * unit);
  return found;
}

bool pierces(const Exact3& from, const Exact3& to, const ExactTriangle& t) {
  ask(5);
  const std::array<Exact3, 2> ends{from, to};
  Integer unit = 1;
  refine(unit, ends);
  refine(unit, t);
  const auto [p, q] = whole(ends, unit);
  return pierces(p, q, whole(t, unit));
}

Fraction exact_squared_distance(const Exact3& p, const ExactTriangle& t) {
  ask(10);
  const std::array<Exact3, 1> point{p};
  Integer unit = 1;
  refine(unit, point);
  refine(unit, t);
  const Whole3 from = whole(point, unit)[0];
  const WholeTriangle to = whole(t, unit);
  Least least;
  to_face(from, to, least);
  for (std::size_t k = 0; k < 3; ++k) to_edge(from, to[k], to[(k + 1) % 3], least);
  return least.value() / Fraction(unit * unit);
}

}  // namespace lekalo::verify
