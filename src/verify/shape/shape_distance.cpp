#include "shape_distance.hpp"

#include <array>
#include <limits>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "verify/number/span.hpp"

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

/// The foot of p on a line. `between` says whether it lies between the ends.
struct Foot {
  Span height;  ///< signed distance of p from the line
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
  return absolute(length(out) - side.radius);
}

void add_ends(const Side& a, const Side& b, Least& least) {
  for (const Vec* end : {&a.from, &a.to}) least.add(nearer(distance(*end, b), a.off), Sure::yes);
  for (const Vec* end : {&b.from, &b.to}) least.add(nearer(distance(*end, a), b.off), Sure::yes);
}

void add_lines(const Side& a, const Side& b, Least& least) {
  const Vec u = a.to - a.from, v = b.to - b.from;
  const auto opposite = [](Span s, Span t) {
    const Span product = s * t;
    return product.high < 0 ? Sure::yes : (product.low > 0 ? Sure::no : Sure::maybe);
  };
  least.add({0, 0}, both(opposite(cross(u, b.from - a.from), cross(u, b.to - a.from)),
                         opposite(cross(v, a.from - b.from), cross(v, a.to - b.from))));
}

void add_line_arc(const Side& line, const Side& arc, Least& least) {
  const Foot foot = foot_of(arc.centre, line);
  const Span height = absolute(foot.height);
  const Vec along = line.to - line.from;
  const Span whole = length(along);
  const Vec u{along.x / whole, along.y / whole};
  const Span at = dot(u, arc.centre - line.from);
  const Vec to_foot = line.from + u * at - arc.centre;
  // The line may pass outside the circle.
  if (!(height.high < arc.radius.low)) {
    const Sure outside = height.low >= arc.radius.high ? Sure::yes : Sure::maybe;
    least.add(height - arc.radius, both(outside, both(foot.between, faces(arc, to_foot))));
  }
  if (height.low > arc.radius.high) return;
  // The line may cross the circle here. Where rounding leaves the root open, both crossings become wide, but
  // none is lost.
  const Span half = square_root((arc.radius - height) * (arc.radius + height));
  for (const Span step : {half, -half}) {
    const Span place = at + step;
    const Vec p = line.from + u * place - arc.centre;
    const Sure crosses = height.high < arc.radius.low ? Sure::yes : Sure::maybe;
    least.add({0, 0},
              both(crosses, both(both(not_negative(place), not_negative(whole - place)), faces(arc, p))));
  }
}

/// Adds the least distance of two arcs about nearly one centre. With one centre it would be that of the radii
/// where the arcs have a direction in common, and otherwise that of two ends. Moving one arc to the other's
/// centre changes it by no more than the move. Ends are among the candidates already, and when two stretches
/// of a circle meet, one holds an end of the other.
void add_concentric(const Side& a, const Side& b, Span apart, Least& least) {
  const bool may_meet = a.sweep == Sweep::full || b.sweep == Sweep::full || faces(a, b.first) != Sure::no ||
                        faces(a, b.last) != Sure::no || faces(b, a.first) != Sure::no ||
                        faces(b, a.last) != Sure::no;
  if (may_meet) least.add({absolute(a.radius - b.radius).low, kInfinity}, Sure::maybe);
  least.lower((apart + apart).high);
}

/// Two centres count as one when they are nearer than this share of the smaller radius. The result is then
/// wider by twice their distance, so only centres that rounding has moved apart should be so near.
constexpr double kOneCentre = 1e-13;

void add_arcs(const Side& a, const Side& b, Least& least) {
  const Vec between = b.centre - a.centre;
  const Span apart = length(between);
  if (!(apart.low > kOneCentre * std::min(a.radius.high, b.radius.high)))
    return add_concentric(a, b, apart, least);
  const auto axis = [&](Span gap, const Vec& of_a, const Vec& of_b) {
    // The circles do not stand so to each other.
    if (gap.high < 0) return;
    const Sure stands = gap.low >= 0 ? Sure::yes : Sure::maybe;
    least.add(gap, both(stands, both(faces(a, of_a), faces(b, of_b))));
  };
  axis(apart - a.radius - b.radius, between, -between);
  axis(a.radius - apart - b.radius, between, between);
  axis(b.radius - apart - a.radius, -between, -between);
  if ((apart - a.radius - b.radius).low > 0) return;
  if ((a.radius - apart - b.radius).low > 0 || (b.radius - apart - a.radius).low > 0) return;
  // The circles may cross at this distance along the line of their centres.
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

bool carriers_apart(const Side& a, const Side& b) {
  if (a.arc && !b.arc) return carriers_apart(b, a);
  if (a.arc) {
    const Span apart = squared(b.centre.x - a.centre.x) + squared(b.centre.y - a.centre.y);
    const Span off = just(a.off) + just(b.off), within = absolute(a.radius - b.radius) - off;
    return (within.low > 0 && squared(within).low > apart.high) ||
           apart.low > squared(a.radius + b.radius + off).high;
  }
  const Vec along = a.to - a.from;
  if (b.arc) {
    const Span height = cross(along, b.centre - a.from);
    return squared(height).low >
           ((squared(along.x) + squared(along.y)) * squared(b.radius + just(b.off))).high;
  }
  const auto on_one_side = [](const Vec& u, const Vec& v, const Vec& w) {
    const Span from = cross(u, v), to = cross(u, w);
    return (from.low > 0 && to.low > 0) || (from.high < 0 && to.high < 0);
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
