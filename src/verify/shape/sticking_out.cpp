#include "sticking_out.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>

#include "lekalo/base/stop.hpp"
#include "shape_distance.hpp"
#include "shape_inside.hpp"
#include "stretch.hpp"
#include "verify/number/surely.hpp"

namespace lekalo::verify {
namespace {

/// At most this many pieces of the outline, and as many squares, are looked at; the enclosure stays as wide
/// as it is then.
constexpr std::size_t kMostPieces = 20'000;
/// All pieces together look at about this many sides, so that large shapes get fewer pieces.
constexpr std::size_t kMostLooks = 4'000'000;

// ---- the outline -----------------------------------------------------------------------------------------

struct Stretch {
  Side piece;
  /// No point of the piece sticks out by more.
  double high = 0;
};

/// The thing that may stick out most comes first.
struct ByHigh {
  template <class Thing>
  bool operator()(const Thing& a, const Thing& b) const {
    return a.high < b.high;
  }
};

class Search {
 public:
  Search(const Shape& part, const Shape& blank, double tolerance, double enough)
      : part_(part),
        blank_(blank),
        tolerance_(tolerance),
        enough_(enough),
        most_pieces_(std::min(kMostPieces, kMostLooks / (part.sides.size() + blank.sides.size()) + 1)) {}

  Span run() {
    along_the_outline();
    if (!decided()) inside_the_outline();
    // Every point of the part is no farther from a point of the blank than some point of the part's outline.
    double at_most = 0;
    for (const Side& side : part_.sides) at_most = std::max(at_most, farthest(side, blank_.sides[0].from));
    return {low_, std::min(high_, at_most)};
  }

 private:
  [[nodiscard]] double goal() const { return low_ + tolerance_; }
  [[nodiscard]] bool decided() const { return low_ > enough_; }
  [[nodiscard]] Span from_blank(const Vec& p) const { return distance(p, blank_); }

  /// Raises the low end where a point of the part sticks out by more.
  void reached_at(const Vec& p, double off) {
    const double out = (from_blank(p) - just(off)).low;
    if (!(out > low_)) return;
    if (holds(blank_, p) == false) low_ = out;
  }

  [[nodiscard]] double most_of(const Side& piece) const {
    const Corners corners = corners_of(piece);
    double most = kInfinity;
    const Box box = box_of(piece);
    // No point of the piece is nearer to a side than their boxes are to one another.
    blank_.tree->visit_near(
        box, most, [&](std::size_t k) { most = std::min(most, farthest(piece, corners, blank_.sides[k])); });
    // None of the piece sticks out when all of it lies in the blank's material.
    const Vec middle = (piece.from + piece.to) * just(0.5);
    if (surely_above(from_blank(middle), just(farthest(piece, middle)) + just(piece.off)) &&
        holds(blank_, middle) == true)
      return 0;
    return most;
  }

  void add(const Side& piece, double at_most) {
    // Only an arc of less than half a turn has corners.
    if (piece.sweep != Sweep::less) {
      for (const Side& half : halves(piece)) add(half, at_most);
      return;
    }
    reached_at(piece.from, piece.off);
    open_.push({piece, std::min(at_most, most_of(piece))});
  }

  void along_the_outline() {
    for (const Side& side : part_.sides) {
      add(side, kInfinity);
      if (decided()) return;
    }
    for (std::size_t looked = 0; !open_.empty(); ++looked) {
      ask(1 + blank_.sides.size());
      const Stretch top = open_.top();
      if (top.high <= goal() || looked == most_pieces_ || decided()) break;
      open_.pop();
      for (const Side& half : halves(top.piece)) add(half, top.high);
    }
    high_ = open_.empty() ? kInfinity : std::max(low_, open_.top().high);
  }

  struct Square {
    Vec centre;
    double half = 0, high = 0;
  };

  struct Nearest {
    /// The vector from the nearest point y to the disc's centre.
    Vec from;
    /// The length and the direction of `from`.
    Span apart;
    Vec away;
    /// n . (x - y) may be less than n . from by this much.
    double blur = 0;
    /// The curvature of the distance from y's side, and infinite where that is not known.
    Span curve;
  };
  static void add_nearest(const Side& side, const Vec& centre, double radius, Span reach,
                          std::vector<Nearest>& near);
  /// Returns a bound for the distance from the blank where it has a local maximum in the disc, or nothing if
  /// it has none. `out` is the distance of the disc's centre, and nothing above `known` is looked for.
  [[nodiscard]] std::optional<double> maximum_in(const Vec& centre, double radius, Span out,
                                                 double known) const;

  using Squares = std::priority_queue<Square, std::vector<Square>, ByHigh>;

  void add(Squares& open, const Vec& centre, double half, double at_most) {
    const double radius = 1.4142136 * half;
    const Span out = from_blank(centre);
    double high = std::min(at_most, (out + just(radius)).high);
    // No point of the square sticks out by more than the outline does.
    if (high <= high_) return;
    const Span to_part = signed_distance(centre, part_);
    // The square holds no material of the part.
    if (surely_above(-to_part, just(radius))) return;
    // All of the square lies in the blank.
    if (surely_above(out, just(radius)) && holds(blank_, centre) == true) return;
    const std::optional<double> maximum = maximum_in(centre, radius, out, high);
    if (!maximum) return;
    high = std::min(high, *maximum);
    if (is_positive(to_part)) reached_at(centre, 0);
    open.push({centre, half, high});
  }

  void inside_the_outline() {
    Squares open;
    const Span x = just(0.5) * (just(part_.low_x) + just(part_.high_x)),
               y = just(0.5) * (just(part_.low_y) + just(part_.high_y));
    const double blur = (x.high - x.low) + (y.high - y.low);
    const double half = 0.500001 * std::max((just(part_.high_x) - just(part_.low_x)).high,
                                            (just(part_.high_y) - just(part_.low_y)).high) +
                        2 * blur;
    add(open, {x, y}, half, kInfinity);
    for (std::size_t looked = 0; !open.empty(); ++looked) {
      ask(1 + blank_.sides.size());
      const Square top = open.top();
      if (top.high <= std::max(goal(), high_) || looked == most_pieces_ || decided()) break;
      open.pop();
      const double quarter = 0.5 * top.half;
      for (const double dx : {-quarter, quarter})
        for (const double dy : {-quarter, quarter})
          add(open, top.centre + Vec{just(dx), just(dy)}, quarter, top.high);
    }
    if (!open.empty()) high_ = std::max(high_, open.top().high);
    high_ = std::max(high_, low_);
  }

  const Shape& part_;
  const Shape& blank_;
  double tolerance_, enough_;
  std::size_t most_pieces_;
  double low_ = 0, high_ = kInfinity;
  std::priority_queue<Stretch, std::vector<Stretch>, ByHigh> open_;
};

/// Looks for a local maximum of the distance in a disc. At a local maximum x the nearest points y of the
/// blank are not all to one side: no n has n . (x - y) > 0 for all of them. When x moves, the nearest point
/// of a line moves by no more than x does. That of an arc about c moves by no more than radius / |x - c|
/// times as much, or it is an end.
///
/// A distance from a convex set, or from a circle, is at most d + u . s + s^2 curve / 2 a step s away, where
/// u is its gradient. So the least of two such distances is at most half the sum of those. A groove of even
/// width needs this bound, because there the maximum is a ridge.
std::optional<double> Search::maximum_in(const Vec& centre, double radius, Span out, double known) const {
  std::vector<Nearest> near;
  const Span reach = out + just(2 * radius);
  std::vector<std::size_t> sides;
  blank_.tree->visit_near(box_of(centre), reach.high, [&](std::size_t k) {
    if (!surely_above(distance(centre, blank_.sides[k]), reach)) sides.push_back(k);
  });
  for (const std::size_t k : sides) {
    const Side& side = blank_.sides[k];
    // The bounds below fail near the centre of an arc.
    if (side.arc && !surely_above(length(centre - side.centre), just(2 * radius))) return kInfinity;
    add_nearest(side, centre, radius, reach, near);
  }
  // The distance from one line has no maximum, and that from one arc has it in the centre.
  if (sides.size() == 1) return std::nullopt;
  for (Nearest& one : near) {
    one.apart = length(one.from);
    if (!surely_not_zero(one.from)) return kInfinity;
    one.away = unit(one.from);
  }
  if (near.empty()) return known;
  std::ranges::stable_sort(near, {}, [](const Nearest& one) { return one.apart.low; });
  // Two directions are tried for n: away from the nearest point, and away from all of them.
  std::array<Vec, 2> tries{near.front().away, Vec{}};
  for (const Nearest& one : near) tries[1] = tries[1] + one.away;
  for (Vec& n : tries) {
    if (!surely_above(length(n), just(1e-6))) continue;
    n = unit(n);
    const bool all = std::all_of(near.begin(), near.end(), [&](const Nearest& one) {
      return surely_above(dot(n, one.from), just(one.blur) * just(1.000001));
    });
    if (all) return std::nullopt;
  }
  // Half the sum is no less than half of the two distances, so that pairs are left where those are too far.
  const Span r = just(radius);
  double least = known;
  for (auto a = near.begin(); a != near.end(); ++a) {
    for (auto b = a; b != near.end(); ++b) {
      if (!(0.5 * (a->apart.low + b->apart.low) < least)) break;
      const Span sum =
          a->apart + b->apart + length(a->away + b->away) * r + just(0.5) * (a->curve + b->curve) * r * r;
      least = std::min(least, (just(0.5) * sum).high);
    }
  }
  return least;
}

/// Adds the points of a side that may be nearest to a point of the disc.
void Search::add_nearest(const Side& side, const Vec& centre, double radius, Span reach,
                         std::vector<Nearest>& near) {
  // Returns the curvature of a distance from something convex, which is not known where that is not apart.
  const auto curve_at = [&](Span apart) { return just(1) / (apart - just(radius)); };
  const auto add = [&](const Vec& from, double blur, Span curve) {
    near.push_back({from, {}, {}, blur, curve});
  };
  if (!side.arc) {
    const Vec along = side.to - side.from;
    const Span whole = length(along);
    const Span share = dot(along, centre - side.from) / squared(whole);
    const Span clamped{std::clamp(share.low, 0.0, 1.0), std::clamp(share.high, 0.0, 1.0)};
    const Vec from = centre - (side.from + along * clamped);
    const Span play = just(radius) / whole;
    const bool between = surely_above(share, play) && surely_above(just(1), share + play) &&
                         surely_above(length(from), just(radius));
    return add(from, 2 * radius, between ? just(0) : curve_at(length(from)));
  }
  const Vec w = centre - side.centre;
  const Span far = length(w), apart = absolute(far - side.radius);
  const double factor = (side.radius / (far - just(radius))).high, blur = (1 + factor) * radius;
  // The disc lies on one side of the circle, and where the arc faces: between the directions of its ends,
  // or beyond one of them when that is more than half a turn.
  const double after = cross(side.first, w).low, before = cross(w, side.last).low;
  const double faced = side.sweep == Sweep::more ? std::max(after, before) : std::min(after, before);
  const bool beside = surely_above(apart, just(radius)) && (side.sweep == Sweep::full || faced > radius);
  // Inside a circle the distance from it is concave.
  const Span curve = surely_above(far, side.radius) ? curve_at(far) : just(0);
  add(w - unit(w) * side.radius, blur, beside ? curve : just(kInfinity));
  for (const Vec* end : {&side.from, &side.to})
    if (!surely_above(length(centre - *end) - just(side.off), reach))
      add(centre - *end, radius + side.off, curve_at(length(centre - *end)));
}

}  // namespace

Span sticking_out(const Shape& placed_part, const Shape& blank, double tolerance, double enough) {
  return Search(placed_part, blank, tolerance, enough).run();
}

}  // namespace lekalo::verify
