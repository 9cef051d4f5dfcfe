#include "stretch.hpp"

#include <algorithm>
#include <optional>

#include "shape_distance.hpp"
#include "verify/number/surely.hpp"

namespace lekalo::verify {
namespace {

/// Says whether all corners surely lie where an arc of a blank is nearest to along its radius.
bool all_face(const Side& arc, const Corners& corners) {
  if (arc.sweep == Sweep::full) return true;
  bool after = true, before = true;
  for (std::size_t i = 0; i < corners.count; ++i) {
    const Vec d = corners.at[i] - arc.centre;
    after = after && is_positive(cross(arc.first, d));
    before = before && is_positive(cross(d, arc.last));
  }
  // A half-plane that holds the corners holds all between them. An arc of less than half a turn faces the
  // intersection of two half-planes, a longer one their union, of which one must hold all.
  return arc.sweep == Sweep::more ? after || before : after && before;
}

/// Says whether a direction is surely less than half a turn behind an arc's beginning, and before its end.
bool surely_between(const Side& arc, const Vec& direction) {
  return is_positive(cross(arc.first, direction)) && is_positive(cross(direction, arc.last));
}

double middle_of(Span a) { return 0.5 * a.low + 0.5 * a.high; }

/// Returns a direction near the middle of an arc that surely cuts it in two of less than half a turn.
///
/// Any cut will do, so it is made of new doubles. The enclosure of the exact middle would be about twice as
/// wide as those of the ends, and would say nothing after some tens of halvings.
std::optional<Vec> about_the_middle(const Side& arc) {
  const double ax = middle_of(arc.first.x), ay = middle_of(arc.first.y), bx = middle_of(arc.last.x),
               by = middle_of(arc.last.y);
  double x = ax + bx, y = ay + by;
  if (arc.sweep == Sweep::more) x = -x, y = -y;
  // The sum says little of directions that are far apart; the right of the chord points outwards for any
  // sweep.
  if (ax * bx + ay * by < 0) x = by - ay, y = ax - bx;
  const Vec towards{just(x), just(y)};
  if (!surely_not_zero(towards)) return std::nullopt;
  const Vec cut = unit(towards);
  // Two turns of less than a half each add up to this arc's turn, and not to a full turn more.
  if (surely_between(arc, cut)) return cut;
  return std::nullopt;
}

/// Returns the parts of an arc of less than half a turn before and behind a direction between its ends.
std::array<Side, 2> parts(const Side& arc, const Vec& direction) {
  std::array<Side, 2> two{arc, arc};
  two[0].last = two[1].first = direction;
  for (Side& part : two) {
    part.from = part.centre + part.first * part.radius;
    part.to = part.centre + part.last * part.radius;
    part.ccw = true;
  }
  return two;
}

}  // namespace

Corners corners_of(const Side& piece) {
  if (!piece.arc) return {{piece.from, piece.to, {}}, 2};
  const Vec sum = piece.first + piece.last;
  const Vec tip = sum * (piece.radius / (just(1) + dot(piece.first, piece.last)));
  return {{piece.centre + piece.first * piece.radius, piece.centre + piece.last * piece.radius,
           piece.centre + tip},
          3};
}

double farthest(const Side& piece, const Vec& c) {
  double most = std::max(length(piece.from - c).high, length(piece.to - c).high);
  if (!piece.arc) return most;
  const Vec away = piece.centre - c;
  if (may_face(piece, away)) most = std::max(most, (length(away) + piece.radius).high);
  return most + piece.off;
}

double farthest(const Side& piece, const Corners& corners, const Side& side) {
  double most = std::min(farthest(piece, side.from), farthest(piece, side.to));
  // The distance from a line is a convex function, so it is largest in a corner.
  if (!side.arc) {
    double in_corners = 0;
    for (std::size_t i = 0; i < corners.count; ++i)
      in_corners = std::max(in_corners, distance(corners.at[i], side).high);
    return std::min(most, (just(in_corners) + just(piece.off)).high);
  }
  if (!all_face(side, corners)) return most;
  const double outside = (just(farthest(piece, side.centre)) - side.radius).high;
  const double inside = (side.radius - just(distance(side.centre, piece).low)).high;
  return std::min(most, (just(std::max({outside, inside, 0.0})) + just(piece.off)).high);
}

std::array<Side, 2> halves(const Side& piece) {
  std::array<Side, 2> two{piece, piece};
  if (!piece.arc) {
    two[0].to = two[1].from = (piece.from + piece.to) * just(0.5);
    return two;
  }
  two[0].sweep = two[1].sweep = piece.sweep == Sweep::full ? Sweep::half : Sweep::less;
  // The middle of an arc of half a turn.
  Vec middle{-piece.first.y, piece.first.x};
  if (piece.sweep == Sweep::full) {
    middle = -piece.first;
  } else if (piece.sweep != Sweep::half) {
    const std::optional<Vec> about = about_the_middle(piece);
    if (!about && piece.sweep == Sweep::less) return two;
    if (about) middle = *about;
    // An arc of hardly less than a full turn still turns by more than a half without its first quarter.
    if (!about) two[1].sweep = Sweep::more;
  }
  std::array<Side, 2> cut = parts(piece, middle);
  for (std::size_t i = 0; i < 2; ++i) cut[i].sweep = two[i].sweep;
  return cut;
}

std::optional<std::array<Side, 2>> cut_beside(const Side& piece, const Vec& point) {
  if (piece.arc) {
    const Vec away = point - piece.centre;
    const Vec towards{just(middle_of(away.x)), just(middle_of(away.y))};
    if (!surely_not_zero(towards)) return std::nullopt;
    const Vec direction = unit(towards);
    if (!surely_between(piece, direction)) return std::nullopt;
    return parts(piece, direction);
  }
  const Vec along = piece.to - piece.from;
  const double share = middle_of(dot(point - piece.from, along)) / middle_of(dot(along, along));
  if (!(share > 0 && share < 1)) return std::nullopt;
  std::array<Side, 2> two{piece, piece};
  two[0].to = two[1].from = piece.from + along * just(share);
  return two;
}

std::array<Side, 2> with_end_cut_off(const Side& piece, bool first) {
  Side end = piece;
  for (int k = 0; k < 4; ++k) end = halves(end)[first ? 0 : 1];
  Side rest = piece;
  if (!piece.arc) {
    (first ? rest.from : rest.to) = first ? end.to : end.from;
  } else {
    rest = parts(piece, first ? end.last : end.first)[first ? 1 : 0];
  }
  return first ? std::array<Side, 2>{end, rest} : std::array<Side, 2>{rest, end};
}

}  // namespace lekalo::verify
