#include "stretch.hpp"

#include <algorithm>

#include "shape_distance.hpp"

namespace lekalo::verify {
namespace {

/// Whether all corners surely lie where an arc of a blank is nearest to along its radius.
bool all_face(const Side& arc, const Corners& corners) {
  if (arc.sweep == Sweep::full) return true;
  bool after = true, before = true;
  for (std::size_t i = 0; i < corners.count; ++i) {
    const Vec d = corners.at[i] - arc.centre;
    after = after && cross(arc.first, d).low >= 0;
    before = before && cross(d, arc.last).low >= 0;
  }
  // A half-plane holds what lies between the corners; what an arc faces is both of two, or either.
  return arc.sweep == Sweep::more ? after || before : after && before;
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
  if (!side.arc) {  // the distance from a line is a convex function: largest in a corner
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
  const Span turn = dot(piece.first, piece.last);
  const Vec chord = piece.last - piece.first, sum = piece.first + piece.last;
  Vec middle{chord.y, -chord.x};
  if (piece.sweep == Sweep::full) middle = -piece.first;
  if (piece.sweep == Sweep::less && turn.low > 0) middle = sum;
  if (piece.sweep == Sweep::more && turn.low > 0) middle = -sum;
  middle = unit(middle);
  two[0].last = two[1].first = middle;
  for (Side& half : two) {
    half.sweep = piece.sweep == Sweep::full ? Sweep::half : Sweep::less;
    half.from = half.centre + half.first * half.radius;
    half.to = half.centre + half.last * half.radius;
    half.ccw = true;
  }
  return two;
}

}  // namespace lekalo::verify
