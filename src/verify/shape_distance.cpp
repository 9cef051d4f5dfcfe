#include "shape_distance.hpp"

#include <array>
#include <limits>
#include <utility>

namespace lekalo::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class Sure { no, maybe, yes };

Sure both(Sure a, Sure b) { return std::min(a, b); }
Sure either(Sure a, Sure b) { return std::max(a, b); }
Sure not_negative(Span a) { return a.low >= 0 ? Sure::yes : (a.high >= 0 ? Sure::maybe : Sure::no); }

/// Whether an arc has a point in a direction from its centre.
Sure faces(const Side& arc, const Vec& d) {
  if (arc.full) return Sure::yes;
  const Sure after = not_negative(cross(arc.first, d)), before = not_negative(cross(d, arc.last));
  const Span turn = cross(arc.first, arc.last);
  if (turn.low > 0) return both(after, before);
  if (turn.high < 0) return either(after, before);
  // Half a turn, a full one or nothing, but for rounding: which, dot and the ends tell; here all is possible.
  return dot(arc.first, arc.last).high < 0 && both(after, before) == Sure::yes ? Sure::yes : Sure::maybe;
}

/// The least of several candidates: those that may apply lower the lower end, those that surely do the upper.
class Least {
 public:
  void add(Span value, Sure applies) {
    if (applies == Sure::no) return;
    low_ = std::min(low_, std::max(0.0, value.low));
    if (applies == Sure::yes) high_ = std::min(high_, value.high);
  }
  [[nodiscard]] Span value() const { return {low_, high_}; }

 private:
  double low_ = kInfinity, high_ = kInfinity;
};

Span absolute(Span a) {
  if (a.low >= 0) return a;
  if (a.high <= 0) return {-a.high, -a.low};
  return {0, std::max(-a.low, a.high)};
}

Span widened(Span a, double by) { return outwards(a.low - by, a.high + by); }

/// Of a line: the foot of p on it, and whether it lies between the ends.
struct Foot {
  Span height;  ///< distance from p, signed
  Sure between = Sure::no;
};
Foot foot_of(const Vec& p, const Side& line) {
  const Vec along = line.to - line.from;
  return {cross(along, p - line.from) / length(along),
          both(not_negative(dot(along, p - line.from)), not_negative(dot(along, line.to - p)))};
}

Span distance_without_ends(const Vec& p, const Side& side, Sure& applies) {
  if (!side.arc) {
    const Foot foot = foot_of(p, side);
    applies = foot.between;
    return absolute(foot.height);
  }
  const Vec out = p - side.centre;
  applies = faces(side, out);
  return widened(absolute(length(out) - side.radius), side.off);
}

void add_ends(const Side& a, const Side& b, Least& least) {
  for (const Vec* end : {&a.from, &a.to}) least.add(distance(*end, b), Sure::yes);
  for (const Vec* end : {&b.from, &b.to}) least.add(distance(*end, a), Sure::yes);
}

void add_lines(const Side& a, const Side& b, Least& least) {
  const Vec u = a.to - a.from, v = b.to - b.from;
  const auto opposite = [](Span s, Span t) {
    const Span product = s * t;
    return product.high < 0 ? Sure::yes : (product.low <= 0 ? Sure::maybe : Sure::no);
  };
  least.add({0, 0}, both(opposite(cross(u, b.from - a.from), cross(u, b.to - a.from)),
                         opposite(cross(v, a.from - b.from), cross(v, a.to - b.from))));
}

void add_line_arc(const Side& line, const Side& arc, Least& least) {
  const Foot foot = foot_of(arc.centre, line);
  const Span height = absolute(foot.height);
  const Vec along = line.to - line.from;
  const Span whole = length(along);
  const Vec unit{along.x / whole, along.y / whole};
  const Span at = dot(unit, arc.centre - line.from);
  const Vec to_foot = line.from + Vec{unit.x * at, unit.y * at} - arc.centre;
  if (height.high >= arc.radius.low - arc.off) {  // the line may pass outside the circle
    const Sure outside = height.low >= arc.radius.high ? Sure::yes : Sure::maybe;
    least.add(widened(height - arc.radius, arc.off), both(outside, both(foot.between, faces(arc, to_foot))));
  }
  if (height.low > arc.radius.high + arc.off) return;
  // Where it may cross the circle. An open rounding of the root makes both crossings wide, never lost.
  const Span half = square_root((arc.radius - height) * (arc.radius + height));
  for (const Span step : {half, Span{-half.high, -half.low}}) {
    const Span place = at + step;
    const Vec p = line.from + Vec{unit.x * place, unit.y * place} - arc.centre;
    const Sure crosses = height.high < arc.radius.low ? Sure::yes : Sure::maybe;
    least.add({0, arc.off},
              both(crosses, both(both(not_negative(place), not_negative(whole - place)), faces(arc, p))));
  }
}

void add_arcs(const Side& a, const Side& b, Least& least) {
  const Vec between = b.centre - a.centre;
  const Span apart = length(between);
  const double off = a.off + b.off;
  const Span zero{0, 0};
  const Vec back{zero - between.x, zero - between.y};
  const auto axis = [&](Span gap, const Vec& of_a, const Vec& of_b) {
    if (gap.high < 0) return;  // the circles do not stand so
    const Sure stands = gap.low >= 0 ? Sure::yes : Sure::maybe;
    least.add(widened(gap, off), both(stands, both(faces(a, of_a), faces(b, of_b))));
  };
  axis(apart - a.radius - b.radius, between, back);
  axis(a.radius - apart - b.radius, between, between);
  axis(b.radius - apart - a.radius, back, back);
  if (apart.low > a.radius.high + b.radius.high + off) return;
  if (a.radius.low > apart.high + b.radius.high + off || b.radius.low > apart.high + a.radius.high + off)
    return;
  if (!(apart.low > 0)) return least.add({0, kInfinity}, Sure::maybe);  // concentric and of one radius
  // Where the circles may cross.
  const Span along = (apart + (a.radius - b.radius) * (a.radius + b.radius) / apart) * Span{0.5, 0.5};
  const Span across = square_root((a.radius - along) * (a.radius + along));
  const Vec u{between.x / apart, between.y / apart};
  for (const Span side : {across, Span{-across.high, -across.low}}) {
    const Vec p{u.x * along - u.y * side, u.y * along + u.x * side};
    least.add({0, kInfinity}, both(Sure::maybe, both(faces(a, p), faces(b, p - between))));
  }
}

/// Half the extent of a side and the middle of its ends' box: to pass over pairs that are far apart.
struct Reach {
  double x = 0, y = 0, radius = 0;
};
Reach reach_of(const Side& side) {
  if (side.arc) {
    return {side.centre.x.low, side.centre.y.low,
            2 * (side.radius.high + side.off) + (side.centre.x.high - side.centre.x.low) +
                (side.centre.y.high - side.centre.y.low)};
  }
  const double x = 0.5 * (side.from.x.low + side.to.x.low), y = 0.5 * (side.from.y.low + side.to.y.low);
  const Vec half = side.to - side.from;
  const Span whole = length(half);
  return {x, y,
          0.51 * whole.high + (side.from.x.high - side.from.x.low) + (side.from.y.high - side.from.y.low)};
}

/// Some points of a side.
std::vector<Vec> points_of(const Side& side) {
  std::vector<Vec> points{side.from};
  if (!side.arc) {
    const Vec along = side.to - side.from;
    for (const double t : {0.5, 0.3125, 0.84375}) {
      const Span at{t, t};
      points.push_back(side.from + Vec{along.x * at, along.y * at});
    }
    return points;
  }
  for (const auto& [x, y] : {std::pair{0.6, 0.8}, {-0.8, 0.6}, {-0.28, -0.96}, {0.96, -0.28}}) {
    const Vec unit{outwards(x, x), outwards(y, y)};
    if (faces(side, unit) == Sure::yes)
      points.push_back(side.centre + Vec{unit.x * side.radius, unit.y * side.radius});
  }
  return points;
}

/// Whether an arc of which the ray from p to the right meets the circle's half at `x` counts; toggles.
Sure crosses_right(const Side& arc, const Vec& p, Span step, Span height) {
  const Span x = arc.centre.x + step;
  const Sure beyond = x.low > p.x.high ? Sure::yes : (x.high < p.x.low ? Sure::no : Sure::maybe);
  return both(beyond, faces(arc, {step, height}));
}

}  // namespace

bool may_face(const Side& arc, const Vec& direction) { return faces(arc, direction) != Sure::no; }

Span distance(const Vec& p, const Side& side) {
  Least least;
  least.add(length(side.from - p), Sure::yes);
  least.add(length(side.to - p), Sure::yes);
  Sure applies = Sure::no;
  const Span inner = distance_without_ends(p, side, applies);
  least.add(inner, applies);
  return least.value();
}

Span distance(const Side& a, const Side& b) {
  Least least;
  add_ends(a, b, least);
  if (!a.arc && !b.arc) add_lines(a, b, least);
  if (a.arc && b.arc) add_arcs(a, b, least);
  if (a.arc != b.arc) a.arc ? add_line_arc(b, a, least) : add_line_arc(a, b, least);
  return least.value();
}

Span distance(const Vec& p, const Shape& shape) {
  Span least{kInfinity, kInfinity};
  for (const Side& side : shape.sides) {
    const Span d = distance(p, side);
    least = {std::min(least.low, d.low), std::min(least.high, d.high)};
  }
  return least;
}

Span distance(const Shape& a, const Shape& b) {
  std::vector<Reach> reach;
  for (const Side& side : b.sides) reach.push_back(reach_of(side));
  Span least{kInfinity, kInfinity};
  for (const Side& one : a.sides) {
    const Reach r = reach_of(one);
    for (std::size_t j = 0; j < b.sides.size(); ++j) {
      const double dx = r.x - reach[j].x, dy = r.y - reach[j].y;
      const double near = std::sqrt(dx * dx + dy * dy) * (1 - 1e-12) - r.radius - reach[j].radius;
      if (near > least.high) continue;
      const Span d = distance(one, b.sides[j]);
      least = {std::min(least.low, d.low), std::min(least.high, d.high)};
    }
  }
  return least;
}

namespace {

/// A ray's direction as a rotation that takes it to the right.
struct Ray {
  Span cosine, sine;
};
Vec turned(const Vec& v, const Ray& ray) {
  return {ray.cosine * v.x - ray.sine * v.y, ray.sine * v.x + ray.cosine * v.y};
}
Side turned(Side side, const Ray& ray) {
  for (Vec* v : {&side.from, &side.to, &side.centre, &side.first, &side.last}) *v = turned(*v, ray);
  return side;
}

/// How often the ray from p to the right crosses a side, modulo 2; nothing when rounding leaves it open.
std::optional<bool> crosses(const Side& side, const Vec& p) {
  if (!side.arc) {
    if (side.from.x.high < p.x.low && side.to.x.high < p.x.low) return false;
    // Half-open in y: an end at p's height counts as below.
    const auto above = [&](const Vec& end) {
      return end.y.low > p.y.high ? Sure::yes : (end.y.high < p.y.low ? Sure::no : Sure::maybe);
    };
    const Sure from = above(side.from), to = above(side.to);
    if (from == Sure::maybe || to == Sure::maybe) return std::nullopt;
    if (from == to) return false;
    const Span turn = cross(side.to - side.from, p - side.from);
    if (turn.low <= 0 && turn.high >= 0) return std::nullopt;
    return (turn.low > 0) == (to == Sure::yes);
  }
  if (side.centre.x.high + side.radius.high + side.off < p.x.low) return false;
  // Level with an end, which may be off the circle, nothing is counted.
  const auto level = [&](const Vec& end) {
    const Span gap = p.y - end.y;
    return gap.low <= side.off && gap.high >= -side.off;
  };
  if (!side.full && (level(side.from) || level(side.to))) return std::nullopt;
  const Span height = p.y - side.centre.y;
  if (height.low > side.radius.high || height.high < -side.radius.high) return false;
  if (height.high > side.radius.low || height.low < -side.radius.low) return std::nullopt;
  const Span half = square_root((side.radius - height) * (side.radius + height));
  bool odd = false;
  for (const Span step : {half, Span{-half.high, -half.low}}) {
    const Sure counts = crosses_right(side, p, step, height);
    if (counts == Sure::maybe) return std::nullopt;
    if (counts == Sure::yes) odd = !odd;
  }
  return odd;
}

}  // namespace

std::optional<bool> holds(const Shape& shape, const Vec& p) {
  // Where one ray grazes an end or a tangent, another does not: the first along x, the others of Pythagorean
  // triples, whose angles are no fractions of a turn as the corners of regular shapes are.
  constexpr std::array<std::array<double, 3>, 6> kTriples{
      {{1, 0, 1}, {3, 4, 5}, {-5, 12, 13}, {-8, -15, 17}, {7, -24, 25}, {-21, 20, 29}}};
  for (const auto& [a, b, c] : kTriples) {
    const bool straight = b == 0;
    const Ray ray{Span{a, a} / Span{c, c}, Span{b, b} / Span{c, c}};
    const Vec q = straight ? p : turned(p, ray);
    bool inside = false, decided = true;
    for (const Side& side : shape.sides) {
      const std::optional<bool> odd = straight ? crosses(side, q) : crosses(turned(side, ray), q);
      if (!odd) {
        decided = false;
        break;
      }
      if (*odd) inside = !inside;
    }
    if (decided) return inside;
  }
  return std::nullopt;
}

Span signed_distance(const Vec& p, const Shape& shape) {
  const Span d = distance(p, shape);
  const std::optional<bool> in = holds(shape, p);
  if (!in) return {-d.high, d.high};
  return *in ? d : Span{-d.high, -d.low};
}

std::optional<bool> lies_within(const Shape& inner, const Shape& outer) {
  // Each contour lies on one side of every other; any of its points tells which, if rounding lets it.
  const auto all = [](const Shape& points, const Shape& shape, bool wanted) -> std::optional<bool> {
    for (std::size_t c = 0; c + 1 < points.contour_starts.size(); ++c) {
      std::optional<bool> in;
      for (std::size_t k = points.contour_starts[c]; k < points.contour_starts[c + 1] && !in; ++k)
        for (const Vec& p : points_of(points.sides[k]))
          if (!in) in = holds(shape, p);
      if (!in) return std::nullopt;
      if (*in != wanted) return false;
    }
    return true;
  };
  const auto inside = all(inner, outer, true);
  if (!inside || !*inside) return inside;
  return all(outer, inner, false);
}

}  // namespace lekalo::verify
