#include "touching.hpp"

#include <algorithm>
#include <map>

#include "lekalo/base/stop.hpp"
#include "shape_distance.hpp"
#include "shape_inside.hpp"
#include "verify/number/surely.hpp"

namespace lekalo::verify {
namespace {

struct Spot {
  Fraction x, y;
};
Spot operator+(const Spot& a, const Spot& b) { return {a.x + b.x, a.y + b.y}; }
Spot operator-(const Spot& a, const Spot& b) { return {a.x - b.x, a.y - b.y}; }
Spot operator-(const Spot& a) { return {-a.x, -a.y}; }
Spot operator*(const Fraction& by, const Spot& a) { return {by * a.x, by * a.y}; }
bool operator==(const Spot& a, const Spot& b) { return a.x == b.x && a.y == b.y; }
Fraction cross(const Spot& a, const Spot& b) { return a.x * b.y - a.y * b.x; }
Fraction dot(const Spot& a, const Spot& b) { return a.x * b.x + a.y * b.y; }

Span enclosed(const Fraction& value) {
  const double cut = cut_to_double(value);
  return outwards(cut, cut);
}
Vec enclosed(const Spot& spot) { return {enclosed(spot.x), enclosed(spot.y)}; }

/// Returns the sign of a + b sqrt(s), s >= 0. It is that of the sum of the squares, each with its term's
/// sign.
int sign(const Fraction& a, const Fraction& b, const Fraction& s) {
  return sgn(Fraction(sgn(a) * a * a + sgn(b) * b * b * s));
}
/// The point rational + irrational sqrt(root).
struct RootSpot {
  Spot rational, irrational;
  Fraction root;
};

/// A side in fractions, counter-clockwise if it is an arc, with the places where it is cut.
struct ExactSide {
  /// `known` is false for an arc whose ends do not lie on one circle exactly, and for lines that join such an
  /// arc, which have its decimals.
  bool arc = false, full = false, known = true;
  Spot from, to, centre;
  Fraction squared_radius;
  /// An arc turns by less than half a turn for 1, by half for 0, by more for -1.
  int turn = 0;
  std::vector<Spot> cuts;

  [[nodiscard]] Spot along() const { return to - from; }
};

ExactSide exact_side(const WrittenSide& written, const ExactShift& shift) {
  const auto placed = [&](const Decimal& x, const Decimal& y) -> Spot {
    const Fraction value = to_fraction(x);
    return {(shift.mirrored ? Fraction(-value) : value) + to_fraction(shift.x),
            to_fraction(y) + to_fraction(shift.y)};
  };
  ExactSide side;
  side.arc = written.arc;
  side.from = placed(written.from_x, written.from_y), side.to = placed(written.to_x, written.to_y);
  if (!side.arc) return side;
  side.centre = placed(written.centre_x, written.centre_y);
  if (written.ccw == shift.mirrored) std::swap(side.from, side.to);
  const Spot a = side.from - side.centre, b = side.to - side.centre;
  side.full = side.from == side.to;
  side.squared_radius = dot(a, a);
  side.known = side.squared_radius == dot(b, b);
  side.turn = sgn(cross(a, b));
  return side;
}

/// Returns where a point of the line or circle that carries a side stands: -1 beyond the side, 0 at an end, 1
/// between the ends.
int standing(const ExactSide& side, const RootSpot& p) {
  const auto sign_of = [&](auto&& linear) {
    return sign(linear(p.rational - (side.arc ? side.centre : side.from)), linear(p.irrational), p.root);
  };
  if (!side.arc) {
    const Spot u = side.along();
    const int after = sign_of([&](const Spot& v) { return dot(u, v); });
    const int before = sign(dot(u, side.to - p.rational), -dot(u, p.irrational), p.root);
    return std::min(after, before);
  }
  // The one end of a full circle is no corner.
  if (side.full) return 1;
  const Spot first = side.from - side.centre, last = side.to - side.centre;
  const int after = sign_of([&](const Spot&v) { return cross(first, v); }),
            before = sign_of([&](const Spot&v) { return cross(v, last); });
  // The result is 0 at the ends alone: across from one of them the other number decides.
  return side.turn == -1 ? std::max(after, before) : std::min(after, before);
}
int standing(const ExactSide& side, const Spot& p) { return standing(side, {p, {}, {}}); }

bool carries(const ExactSide& side, const Spot& p) {
  if (!side.arc) return cross(side.along(), p - side.from) == 0;
  const Spot out = p - side.centre;
  return dot(out, out) == side.squared_radius;
}
bool same_carrier(const ExactSide& a, const ExactSide& b) {
  if (a.arc != b.arc) return false;
  if (a.arc) return a.centre == b.centre && a.squared_radius == b.squared_radius;
  return cross(a.along(), b.along()) == 0 && cross(a.along(), b.from - a.from) == 0;
}

/// Step 9 of docs/design/verify.md: cuts two sides where they touch. Returns false where they cross inside
/// both.
bool cut_where_they_touch(ExactSide& a, ExactSide& b) {
  for (auto [one, other] : {std::pair{&a, &b}, {&b, &a}})
    for (const Spot& end : {one->from, one->to})
      if (carries(*other, end) && standing(*other, end) >= 0) {
        other->cuts.push_back(end);
        // The one end of a full circle is such an end too.
        one->cuts.push_back(end);
      }
  if (same_carrier(a, b)) return true;
  const auto is_inside_both = [&](const RootSpot& p) { return standing(a, p) > 0 && standing(b, p) > 0; };
  if (!a.arc && !b.arc) {
    const Fraction turn = cross(a.along(), b.along());
    if (turn == 0) return true;
    const Fraction share = cross(b.from - a.from, b.along()) / turn;
    return !is_inside_both({a.from + share * a.along(), {}, {}});
  }
  // The carriers meet at middle +- sqrt(root) across.
  Spot middle, across;
  Fraction root;
  if (a.arc && b.arc) {
    const Spot between = b.centre - a.centre;
    const Fraction apart = dot(between, between);
    if (apart == 0) return true;
    const Fraction share = (apart + a.squared_radius - b.squared_radius) / (2 * apart);
    middle = a.centre + share * between, across = {-between.y, between.x};
    root = a.squared_radius / apart - share * share;
  } else {
    const ExactSide &line = a.arc ? b : a, &arc = a.arc ? a : b;
    across = line.along();
    const Fraction whole = dot(across, across);
    middle = line.from + Fraction(dot(arc.centre - line.from, across) / whole) * across;
    const Spot height = middle - arc.centre;
    root = (arc.squared_radius - dot(height, height)) / whole;
  }
  if (sgn(root) < 0) return true;
  // Tangent carriers touch and do not cross. Where they touch in an end it is a cut already.
  if (sgn(root) == 0) {
    if (is_inside_both({middle, {}, {}})) a.cuts.push_back(middle), b.cuts.push_back(middle);
    return true;
  }
  return !is_inside_both({middle, across, root}) && !is_inside_both({middle, -across, root});
}

/// Returns the ends and cuts in order along the side, each once.
std::vector<Spot> stops_of(const ExactSide& side) {
  std::vector<Spot> spots = side.cuts;
  if (!side.full) spots.push_back(side.from), spots.push_back(side.to);
  if (spots.empty()) spots.push_back(side.from);
  const Spot u = side.along();
  const Spot first = (side.full ? spots.front() : side.from) - side.centre;
  // Returns a number that grows along the side: of a line, or of a circle, there first for half a turn.
  const auto place = [&](const Spot& p) -> Fraction {
    if (!side.arc) return dot(u, p - side.from);
    const Spot v = p - side.centre;
    if (cross(first, v) > 0 || v == first) return -dot(first, v);
    return 2 * side.squared_radius + dot(first, v);
  };
  std::map<Fraction, Spot> in_order;
  for (const Spot& p : spots) in_order.emplace(place(p), p);
  std::vector<Spot> stops;
  for (const auto& [at, p] : in_order) stops.push_back(p);
  if (side.full) stops.push_back(stops.front());
  return stops;
}

/// The middle of a stretch and a direction across it.
struct Middle {
  Vec at, across;
};
Middle middle_of(const ExactSide& side, const Spot& from, const Spot& to) {
  if (!side.arc) {
    const Vec along = enclosed(to - from);
    return {enclosed(from + Fraction(1, 2) * (to - from)), unit({-along.y, along.x})};
  }
  const Spot u = from - side.centre, v = to - side.centre;
  // The chord turned to the right points outwards, however far the arc turns.
  const Vec outwards_to = from == to ? -enclosed(u) : Vec{enclosed(v.y - u.y), enclosed(u.x - v.x)};
  const Vec direction = unit(outwards_to);
  return {enclosed(side.centre) + direction * square_root(enclosed(side.squared_radius)), direction};
}

class Touching {
 public:
  Touching(const Shape& part, const Shape& blank, const ExactShift& shift)
      : part_(placed(part, {just(1),
                            just(0),
                            shift.mirrored,
                            {enclosed(to_fraction(shift.x)), enclosed(to_fraction(shift.y))}})),
        blank_(blank) {
    for (const WrittenSide& side : part.exact) of_part_.push_back(exact_side(side, shift));
    for (const WrittenSide& side : blank.exact) of_blank_.push_back(exact_side(side, {}));
  }

  [[nodiscard]] bool from_inside() {
    for (std::size_t i = 0; i < of_part_.size(); ++i)
      for (const std::size_t j : sides_meeting(blank_, part_.tree->box(i))) {
        ask();
        if (is_positive(distance(part_.sides[i], blank_.sides[j]))) continue;
        if (!of_part_[i].known || !of_blank_[j].known) return false;
        if (!cut_where_they_touch(of_part_[i], of_blank_[j])) return false;
      }
    return all(of_part_, part_,
               [&](std::size_t i, const Middle& m) { return part_stretch_is_inside(i, m); }) &&
           all(of_blank_, blank_, [&](std::size_t j, const Middle& m) {
             return is_shared(of_part_, of_blank_[j], part_, m) || holds(part_, m.at) == false;
           });
  }

  [[nodiscard]] bool touches() const {
    return std::any_of(of_part_.begin(), of_part_.end(), [](const ExactSide& s) { return !s.cuts.empty(); });
  }

 private:
  static std::vector<std::size_t> sides_meeting(const Shape& shape, const Box& box) {
    std::vector<std::size_t> sides;
    shape.tree->visit([&](const Box& other) { return meet(box, other); },
                      [&](std::size_t side) { sides.push_back(side); });
    std::sort(sides.begin(), sides.end());
    return sides;
  }

  template <class Check>
  static bool all(const std::vector<ExactSide>& sides, const Shape& shape, Check&& check) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
      // A side that touches nothing is told by any of its points.
      if (!sides[i].known) {
        if (!check(i, {points_of(shape.sides[i]).front(), {}})) return false;
        continue;
      }
      const std::vector<Spot> stops = stops_of(sides[i]);
      for (std::size_t k = 0; k + 1 < stops.size(); ++k)
        if (!check(i, middle_of(sides[i], stops[k], stops[k + 1]))) return false;
    }
    return true;
  }

  /// Says whether a stretch of `side` lies on one of `others`.
  static bool is_shared(const std::vector<ExactSide>& others, const ExactSide& side, const Shape& shape,
                        const Middle& middle) {
    for (const std::size_t j : sides_meeting(shape, box_of(middle.at))) {
      ask();
      if (!side.known || !others[j].known || !same_carrier(side, others[j])) continue;
      if (surely_beside(shape.sides[j], middle.at)) return true;
    }
    return false;
  }

  [[nodiscard]] bool part_stretch_is_inside(std::size_t i, const Middle& middle) const {
    if (!is_shared(of_blank_, of_part_[i], blank_, middle)) return holds(blank_, middle.at) == true;
    // The points to its left and right are taken nearer than any other side of the part. Where the part has
    // material at such a point, the blank must have it too. A side of the blank between would lie in the
    // part.
    double near = distance(middle.at, part_, i).low;
    if (of_part_[i].arc) near = std::min(near, part_.sides[i].radius.low);
    for (const double step : {near / 4, -near / 4}) {
      const Vec beside = middle.at + middle.across * just(step);
      if (holds(part_, beside) != false && holds(blank_, beside) != true) return false;
    }
    return true;
  }

  Shape part_;
  const Shape& blank_;
  std::vector<ExactSide> of_part_, of_blank_;
};

}  // namespace

Touch touches_from_inside(const Shape& part, const Shape& blank, const ExactShift& shift) {
  Touching touching(part, blank, shift);
  const bool inside = touching.from_inside();
  return {inside, touching.touches()};
}

}  // namespace lekalo::verify
