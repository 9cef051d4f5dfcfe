#include "shape_distance.hpp"

#include <array>
#include <limits>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "verify/number/surely.hpp"

namespace lekalo::verify {
namespace {

enum class Sure { no, maybe, yes };

Sure both(Sure a, Sure b) { return std::min(a, b); }
Sure either(Sure a, Sure b) { return std::max(a, b); }
Sure not_negative(Span a) { return a.low >= 0 ? Sure::yes : (a.high < 0 ? Sure::no : Sure::maybe); }

/// Says whether an arc has a point in a direction from its centre.
Sure faces(const Side& arc, const Vec& d) {
  if (arc.sweep == Sweep::full) return Sure::yes;
  const Sure after = not_negative(cross(arc.first, d)), before = not_negative(cross(d, arc.last));
  if (arc.sweep == Sweep::less) return both(after, before);
  if (arc.sweep == Sweep::more) return either(after, before);
  // In an arc of half a turn the two must say the same; if they do not, nothing is known.
  return after == before ? after : Sure::maybe;
}

/// The least of several candidates. Candidates that may apply lower the lower end, and those that surely
/// apply lower the upper end too.
class Least {
 public:
  void add(Span value, Sure applies) {
    if (applies == Sure::no) return;
    low_ = std::min(low_, std::max(0.0, value.low));
    if (applies == Sure::yes) high_ = std::min(high_, value.high);
  }
  /// Lowers the lower end, because all candidates may be nearer by this much.
  void lower(double by) { low_ = std::max(0.0, (just(low_) - just(by)).low); }
  [[nodiscard]] Span value() const { return {low_, high_}; }

 private:
  double low_ = kInfinity, high_ = kInfinity;
};

/// Returns the distance of a point that lies no more than `off` from one at the given distance.
Span nearer(Span distance, double off) {
  return off > 0 ? Span{std::max(0.0, (distance - just(off)).low), distance.high} : distance;
}

/// Says whether the nearest point to p of the line or circle that carries a side is on the side.
Sure beside(const Side& side, const Vec& p) {
  if (side.arc) return faces(side, p - side.centre);
  const Vec along = side.to - side.from;
  return both(not_negative(dot(along, p - side.from)), not_negative(dot(along, side.to - p)));
}

/// Returns the distance of p from the line or circle that carries a side.
Span distance_from_carrier(const Vec& p, const Side& side) {
  if (side.arc) return absolute(length(p - side.centre) - side.radius);
  const Vec along = side.to - side.from;
  return absolute(cross(along, p - side.from) / length(along));
}

void add_ends(const Side& a, const Side& b, Least& least) {
  for (const Vec* end : {&a.from, &a.to}) least.add(nearer(distance(*end, b), a.off), Sure::yes);
  for (const Vec* end : {&b.from, &b.to}) least.add(nearer(distance(*end, a), b.off), Sure::yes);
}

void add_lines(const Side& a, const Side& b, Least& least) {
  const Vec u = a.to - a.from, v = b.to - b.from;
  const auto opposite = [](Span s, Span t) {
    const Span product = s * t;
    return is_positive(-product) ? Sure::yes : (is_positive(product) ? Sure::no : Sure::maybe);
  };
  least.add({0, 0}, both(opposite(cross(u, b.from - a.from), cross(u, b.to - a.from)),
                         opposite(cross(v, a.from - b.from), cross(v, a.to - b.from))));
}

void add_line_arc(const Side& line, const Side& arc, Least& least) {
  const Span height = distance_from_carrier(arc.centre, line);
  const Vec along = line.to - line.from;
  const Span whole = length(along);
  const Vec u{along.x / whole, along.y / whole};
  const Span at = dot(u, arc.centre - line.from);
  if (height.low >= arc.radius.high) {
    // The line passes outside the circle.
    const Vec to_foot = line.from + u * at - arc.centre;
    return least.add(height - arc.radius, both(beside(line, arc.centre), faces(arc, to_foot)));
  }
  // The line may cross the circle here. Where rounding leaves the root open, both crossings become wide, but
  // neither they nor a foot just outside are lost.
  const Span half = square_root((arc.radius - height) * (arc.radius + height));
  const Sure crosses = surely_above(arc.radius, height) ? Sure::yes : Sure::maybe;
  for (const Span step : {half, -half}) {
    const Span place = at + step;
    const Vec p = line.from + u * place - arc.centre;
    least.add({0, 0},
              both(crosses, both(both(not_negative(place), not_negative(whole - place)), faces(arc, p))));
  }
}

/// Two centres count as one when they are nearer than this share of the smaller radius. The result is then
/// wider by twice their distance, so only centres that rounding has moved apart should be so near.
constexpr double kOneCentre = 1e-13;

void add_arcs(const Side& a, const Side& b, Least& least) {
  const Vec between = b.centre - a.centre;
  const Span apart = length(between);
  // With one centre the least distance is that of an end from the other arc, as one of two arcs that have a
  // direction in common begins there. Ends are among the candidates already. Moving one arc to the other's
  // centre changes this distance, and those of the ends, by no more than the move.
  if (!surely_above(apart, just(kOneCentre * std::min(a.radius.high, b.radius.high))))
    return least.lower((apart + apart).high);
  const auto axis = [&](Span whole, Span parts, const Vec& of_a, const Vec& of_b) {
    if (!(whole.low >= parts.high)) return false;
    least.add(whole - parts, both(faces(a, of_a), faces(b, of_b)));
    return true;
  };
  // Circles beside each other, or one in the other.
  if (axis(apart, a.radius + b.radius, between, -between) ||
      axis(a.radius, apart + b.radius, between, between) ||
      axis(b.radius, apart + a.radius, -between, -between))
    return;
  // The circles may cross at this distance along the line of their centres. Where rounding leaves the root
  // open, the crossings become wide, and hold the nearest points of circles that hardly miss each other.
  const Span along = (apart + (a.radius - b.radius) * (a.radius + b.radius) / apart) * just(0.5);
  const Span across = square_root((a.radius - along) * (a.radius + along));
  const Vec u = unit(between);
  for (const Span side : {across, -across}) {
    const Vec p{u.x * along - u.y * side, u.y * along + u.x * side};
    least.add({0, kInfinity}, both(Sure::maybe, both(faces(a, p), faces(b, p - between))));
  }
}

}  // namespace

bool may_face(const Side& arc, const Vec& direction) { return faces(arc, direction) != Sure::no; }
bool surely_faces(const Side& arc, const Vec& direction) { return faces(arc, direction) == Sure::yes; }
bool surely_beside(const Side& side, const Vec& p) { return beside(side, p) == Sure::yes; }

std::vector<Vec> points_of(const Side& side) {
  std::vector<Vec> points{side.from};
  if (!side.arc) {
    const Vec along = side.to - side.from;
    for (const double t : {0.5, 0.3125, 0.84375}) {
      points.push_back(side.from + along * just(t));
    }
    return points;
  }
  for (const auto& [x, y] : {std::pair{0.6, 0.8}, {-0.8, 0.6}, {-0.28, -0.96}, {0.96, -0.28}}) {
    const Vec direction{outwards(x, x), outwards(y, y)};
    if (faces(side, direction) == Sure::yes) points.push_back(side.centre + direction * side.radius);
  }
  return points;
}

Span distance(const Vec& p, const Side& side) {
  Least least;
  least.add(nearer(length(side.from - p), side.off), Sure::yes);
  least.add(nearer(length(side.to - p), side.off), Sure::yes);
  least.add(distance_from_carrier(p, side), beside(side, p));
  return least.value();
}

Span distance(const Side& a, const Side& b) {
  Least least;
  add_ends(a, b, least);
  if (a.arc)
    b.arc ? add_arcs(a, b, least) : add_line_arc(b, a, least);
  else
    b.arc ? add_line_arc(a, b, least) : add_lines(a, b, least);
  return least.value();
}

bool carriers_apart(const Side& a, const Side& b) {
  if (a.arc && !b.arc) return carriers_apart(b, a);
  if (a.arc) {
    const Span apart = length(b.centre - a.centre), off = just(a.off) + just(b.off);
    return surely_above(absolute(a.radius - b.radius) - off, apart) ||
           surely_above(apart, a.radius + b.radius + off);
  }
  const Vec along = a.to - a.from;
  if (b.arc) {
    const Span height = cross(along, b.centre - a.from);
    return surely_above(squared(height),
                        (squared(along.x) + squared(along.y)) * squared(b.radius + just(b.off)));
  }
  const auto on_one_side = [](const Vec& u, const Vec& v, const Vec& w) {
    const Span from = cross(u, v), to = cross(u, w);
    return (is_positive(from) && is_positive(to)) || (is_positive(-from) && is_positive(-to));
  };
  return on_one_side(along, b.from - a.from, b.to - a.from) ||
         on_one_side(b.to - b.from, a.from - b.from, a.to - b.from);
}

Box box_of(const Vec& p) { return {p.x.low, p.y.low, p.x.high, p.y.high}; }

Span distance(const Vec& p, const Shape& shape, std::size_t except) {
  Span least{kInfinity, kInfinity};
  shape.tree->visit_near(box_of(p), least.high, [&](std::size_t k) {
    if (k == except) return;
    const Span d = distance(p, shape.sides[k]);
    least = {std::min(least.low, d.low), std::min(least.high, d.high)};
  });
  return least;
}

Span distance(const Side& side, const Shape& shape) {
  Span least{kInfinity, kInfinity};
  shape.tree->visit_near(box_of(side), least.high, [&](std::size_t k) {
    const Span d = distance(side, shape.sides[k]);
    least = {std::min(least.low, d.low), std::min(least.high, d.high)};
  });
  return least;
}

Span distance(const Shape& a, const Shape& b) {
  Span least{kInfinity, kInfinity};
  for (std::size_t i = 0; i < a.sides.size(); ++i)
    b.tree->visit_near(a.tree->box(i), least.high, [&](std::size_t j) {
      ask();
      const Span d = distance(a.sides[i], b.sides[j]);
      least = {std::min(least.low, d.low), std::min(least.high, d.high)};
    });
  return least;
}

}  // namespace lekalo::verify
