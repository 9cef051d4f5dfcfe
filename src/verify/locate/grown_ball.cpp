#include "grown_ball.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "lekalo/base/stop.hpp"
#include "verify/number/surely.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/shape_inside.hpp"
#include "verify/shape/stretch.hpp"

namespace lekalo::verify {
namespace {

/// For one ball at most this many pieces are looked at.
constexpr std::size_t kMostPieces = 4096;
/// A piece shorter than this share of the ball and its coordinates is not halved, because rounding would
/// decide about its halves.
constexpr double kShortest = 0x1p-47;

double middle_of(Span a) { return 0.5 * a.low + 0.5 * a.high; }

/// Returns half a circle, counter-clockwise from a direction to the opposite one.
Side half_circle(const Vec& centre, const Vec& first, double radius) {
  Side half;
  half.arc = true, half.sweep = Sweep::half;
  half.centre = centre, half.radius = just(radius);
  half.first = first, half.last = -first;
  half.from = centre + first * half.radius, half.to = centre - first * half.radius;
  return half;
}

/// Returns an arc's parallel on a circle of another radius.
Side with_radius(const Side& arc, Span radius) {
  Side other = arc;
  other.radius = radius;
  other.ccw = true, other.off = 0;
  other.from = arc.centre + arc.first * other.radius, other.to = arc.centre + arc.last * other.radius;
  return other;
}

/// Encloses a point of the piece that is about as near to c as any.
Vec nearest_point(const Side& piece, const Vec& c) {
  if (piece.arc) {
    const Vec enclosed = c - piece.centre;
    // About the arc's centre every direction will do, and the enclosed one may be any.
    const Vec out{just(middle_of(enclosed.x)), just(middle_of(enclosed.y))};
    if (surely_faces(piece, out)) return piece.centre + unit(out) * piece.radius;
    return length(piece.from - c).high < length(piece.to - c).high ? piece.from : piece.to;
  }
  const Vec along = piece.to - piece.from;
  const double share = middle_of(dot(c - piece.from, along)) / middle_of(dot(along, along));
  // A share that is no number becomes 0.
  return piece.from + along * just(std::min(std::max(0.0, share), 1.0));
}

/// Says whether all of this, a point or a piece, is surely farther than `by` from a side.
template <class Place>
bool surely_off(const Place& place, const Shape& part, std::size_t side, double by) {
  return gap(box_of(place), part.tree->box(side)) > by ||
         surely_above(distance(place, part.sides[side]), just(by));
}

class GrownBall {
 public:
  GrownBall(const Shape& part, const std::vector<double>& growth, const Vec& c, double wanted)
      : part_(part), c_(c), wanted_(wanted) {
    for (std::size_t k = 0; k < part.sides.size(); ++k) {
      const Side& side = part.sides[k];
      const double apart = distance(c, side).low;
      const bool rim = growth[k] < 0;
      // A rim is taken to be wider by what the arc's ends miss its circle, so that it holds the true one.
      const double by = rim ? (just(-growth[k]) + just(side.off)).high : growth[k];
      if (rim) rims_.push_back({k, by});
      if (surely_above(just(apart) - just(by), just(wanted))) continue;
      if (!(by > side.off)) add(side);
      if (!(by > 0)) continue;
      if (!rim) grown_.push_back({k, by});
      add_parallels(side, by);
    }
  }

  double radius() {
    if (!(wanted_ > 0) || !holds_middle()) return -kInfinity;
    const double shortest = kShortest * (wanted_ + length(c_).high);
    for (std::size_t looked = 0; !open_.empty(); ++looked) {
      ask();
      std::ranges::pop_heap(open_, std::greater(), &Piece::apart);
      const Piece piece = std::move(open_.back());
      open_.pop_back();
      const bool turns_far = piece.side.sweep != Sweep::less;
      const Covered covered = turns_far ? Covered::partly : what_covers(piece);
      if (covered == Covered::wholly) continue;
      // No other piece is nearer.
      if (covered == Covered::no || looked == kMostPieces ||
          (!turns_far && surely_above(just(shortest), length(piece.side.to - piece.side.from))))
        return piece.apart;
      for (const Side& half : halves(piece.side)) add(half, piece.apart);
    }
    return wanted_;
  }

 private:
  struct Piece {
    Side side;
    double apart = {};  ///< from c, at least
  };
  /// A side and the width of what it grows to, or of its rim.
  struct Strip {
    std::size_t side = 0;
    double by = 0;
  };
  enum class Covered { no, partly, wholly };

  /// \param least  a distance that the piece is known not to fall below
  void add(const Side& side, double least = 0) {
    double apart = std::max(least, distance(c_, side).low);
    // Rounding hides the direction of a short line, and with it the distance from it.
    if (side.sweep == Sweep::less)
      apart = std::max(apart, (length(side.from - c_) - length(side.to - side.from) - just(side.off)).low);
    if (apart >= wanted_) return;
    open_.push_back({side, apart});
    std::ranges::push_heap(open_, std::greater(), &Piece::apart);
  }

  /// Adds what holds all points whose distance from the side is `by`. A point of them whose nearest point is
  /// an end of the side lies behind that end. A point further in than an arc's centre is nearest to an end.
  void add_parallels(const Side& side, double by) {
    if (side.arc) {
      add(with_radius(side, side.radius + just(by)));
      if (!surely_above(just(by), side.radius)) add(with_radius(side, side.radius - just(by)));
      if (side.sweep == Sweep::full) return;
      add(half_circle(side.centre + side.first * side.radius, -side.first, by));
      add(half_circle(side.centre + side.last * side.radius, side.last, by));
      return;
    }
    const Vec along = side.to - side.from;
    const Vec left = unit(Vec{-along.y, along.x});
    add(side_between(side.from + left * just(by), side.to + left * just(by)));
    add(side_between(side.from - left * just(by), side.to - left * just(by)));
    add(half_circle(side.from, left, by));
    add(half_circle(side.to, -left, by));
  }

  [[nodiscard]] bool may_reach(const Strip& strip, const Vec& p) const {
    return gap(box_of(p), part_.tree->box(strip.side)) < strip.by &&
           surely_above(just(strip.by), distance(p, part_.sides[strip.side]));
  }
  /// Says whether every point of the piece is nearer to the strip's side than the strip is wide.
  [[nodiscard]] bool reaches(const Strip& strip, const Side& piece, const Corners& corners) const {
    const Side& side = part_.sides[strip.side];
    return surely_above(just(strip.by), just(farthest(piece, corners, side)) + just(side.off));
  }
  /// Says whether all of this, a point or a piece, is further from every rim's side than the rim is wide.
  template <class Place>
  [[nodiscard]] bool off_rims(const Place& place) const {
    return std::all_of(rims_.begin(), rims_.end(),
                       [&](const Strip& rim) { return surely_off(place, part_, rim.side, rim.by); });
  }

  [[nodiscard]] bool holds_middle() const {
    const auto reaches_middle = [&](const Strip& strip) {
      const Side& side = part_.sides[strip.side];
      return (just(distance(c_, side).high) + just(side.off)).high <= strip.by;
    };
    if (std::any_of(grown_.begin(), grown_.end(), reaches_middle)) return true;
    return holds(part_, c_) == true && off_rims(c_);
  }

  /// Says whether the piece surely has no point on the grown part's outline. Where it may have, one of its
  /// points that are nearest to c tells whether halving it is of any use.
  Covered what_covers(const Piece& piece) {
    const Corners corners = corners_of(piece.side);
    const Vec nearest = nearest_point(piece.side, c_);
    bool here = false;
    for (Strip& strip : grown_) {
      if (!may_reach(strip, nearest)) continue;
      here = true;
      if (!reaches(strip, piece.side, corners)) continue;
      // The next piece is often covered by the same strip, which is asked first then.
      std::swap(grown_.front(), strip);
      return Covered::wholly;
    }
    // This covers the outline of what a side grows to alone: no side is apart from the part's outline, and no
    // outline of a rim is off the rims. What of these is not in the grown part lies behind its outline, which
    // is nearer.
    if (holds(part_, nearest) == true) {
      here = here || off_rims(nearest);
      if (off_rims(piece.side) && is_positive(distance(piece.side, part_))) return Covered::wholly;
    }
    return here ? Covered::partly : Covered::no;
  }

  const Shape& part_;
  const Vec& c_;
  double wanted_;
  std::vector<Strip> grown_, rims_;
  std::vector<Piece> open_;  ///< a heap, the nearest first
};

/// A circle about (x, y), or without a radius a line through it in the unit direction (dx, dy): in doubles,
/// because what is derived from it is looked at again.
struct Carrier {
  double x = {}, y = {}, radius = {}, dx = {}, dy = {};
};
struct Place {
  double x = {}, y = {};
};

Place middle_of(const Vec& p) { return {middle_of(p.x), middle_of(p.y)}; }

/// Returns the lines and circles that bound a rim.
std::vector<Carrier> bounds_of_rim(const Side& side, double by) {
  const Place from = middle_of(side.from), to = middle_of(side.to);
  std::vector<Carrier> bounds{{from.x, from.y, by}, {to.x, to.y, by}};
  if (side.arc) {
    const Place centre = middle_of(side.centre);
    for (const double radius : {middle_of(side.radius) - by, middle_of(side.radius) + by})
      if (radius > 0) bounds.push_back({centre.x, centre.y, radius});
    return bounds;
  }
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (!(length > 0)) return bounds;
  const double dx = (to.x - from.x) / length, dy = (to.y - from.y) / length;
  for (const double side_by : {-by, by})
    bounds.push_back({from.x - side_by * dy, from.y + side_by * dx, {}, dx, dy});
  return bounds;
}

/// Returns the point of a line or circle that is nearest to p: no number where that is its centre.
Place foot_on(const Carrier& a, const Place& p) {
  if (a.radius == 0) {
    const double along = (p.x - a.x) * a.dx + (p.y - a.y) * a.dy;
    return {a.x + along * a.dx, a.y + along * a.dy};
  }
  const double far = std::hypot(p.x - a.x, p.y - a.y);
  return {a.x + a.radius / far * (p.x - a.x), a.y + a.radius / far * (p.y - a.y)};
}

/// Returns where two of them meet: none of it is a number where they do not.
std::array<Place, 2> meetings(const Carrier& a, const Carrier& b) {
  if (a.radius == 0 && b.radius == 0) {
    const double t = ((b.x - a.x) * b.dy - (b.y - a.y) * b.dx) / (a.dx * b.dy - a.dy * b.dx);
    const Place at{a.x + t * a.dx, a.y + t * a.dy};
    return {at, at};
  }
  if (b.radius == 0) return meetings(b, a);
  // The chord that the line, or that both circles have in common, about the foot of b's centre.
  Place foot = foot_on(a, {b.x, b.y});
  double dx = a.dx, dy = a.dy;
  if (a.radius > 0) {
    const double apart = std::hypot(b.x - a.x, b.y - a.y);
    const double along = (apart * apart + a.radius * a.radius - b.radius * b.radius) / (2 * apart);
    dx = -(b.y - a.y) / apart, dy = (b.x - a.x) / apart;
    foot = {a.x + along * dy, a.y - along * dx};
  }
  const double off = std::hypot(foot.x - b.x, foot.y - b.y);
  const double half = std::sqrt((b.radius - off) * (b.radius + off));
  return {Place{foot.x + half * dx, foot.y + half * dy}, {foot.x - half * dx, foot.y - half * dy}};
}

}  // namespace

double off_rims(const Shape& part, const std::vector<double>& growth, const Vec& p) {
  // A point of the rims' outline is looked for a little beyond it, where it is surely off them.
  constexpr double kPast = 0x1p-40, kPastOfCoordinates = 0x1p-48;
  std::vector<std::size_t> rims;
  for (std::size_t k = 0; k < growth.size(); ++k)
    if (growth[k] < 0) rims.push_back(k);
  const auto in_rest = [&](const Vec& q) {
    const auto is_off = [&](std::size_t k) { return surely_off(q, part, k, -growth[k]); };
    return std::all_of(rims.begin(), rims.end(), is_off) && holds(part, q) == true;
  };
  if (in_rest(p)) return 0;

  const Place at = middle_of(p);
  const double past = kPastOfCoordinates * std::max({part.high_x, -part.low_x, part.high_y, -part.low_y});
  double off = kInfinity;
  const auto try_at = [&](const Place& q) {
    if (!(std::hypot(q.x - at.x, q.y - at.y) < off)) return;
    const Vec there{just(q.x), just(q.y)};
    if (in_rest(there)) off = std::min(off, length(there - p).high);
  };
  std::vector<std::vector<Carrier>> bounds;
  for (const std::size_t k : rims) {
    bounds.push_back(bounds_of_rim(part.sides[k], -growth[k] * (1 + kPast) + past));
    for (const Carrier& bound : bounds.back()) try_at(foot_on(bound, at));
  }
  // The nearest point may lie where two rims meet, both of which are no further from p then, or the ends of
  // one.
  for (std::size_t i = 0; i < rims.size(); ++i) {
    if (distance(p, part.sides[rims[i]]).low + growth[rims[i]] > off) continue;
    for (std::size_t j = 0; j <= i; ++j)
      for (const Carrier& a : bounds[i])
        for (const Carrier& b : bounds[j])
          for (const Place& q : meetings(a, b)) try_at(q);
  }
  return off;
}

double grown_ball(const Shape& part, const std::vector<double>& growth, const Vec& c, double wanted) {
  return GrownBall(part, growth, c, wanted).radius();
}

}  // namespace lekalo::verify
