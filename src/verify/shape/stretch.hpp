#pragma once

#include <array>

#include "shape.hpp"

namespace lekalo::verify {

/// Stretches of outlines: lines, and arcs of less than half a turn, and how far they reach.

/// Corners of a convex set that holds a line, or an arc of less than half a turn.
struct Corners {
  std::array<Vec, 3> at;
  std::size_t count = 0;
};
[[nodiscard]] Corners corners_of(const Side& piece);

/// No point of the piece is farther from c.
[[nodiscard]] double farthest(const Side& piece, const Vec& c);
/// No point of the piece is farther from the side.
[[nodiscard]] double farthest(const Side& piece, const Corners& corners, const Side& side);

/// Two parts that make up the whole, about halves; arcs of any sweep. Where an arc is too short for rounding
/// to cut it, twice the arc.
[[nodiscard]] std::array<Side, 2> halves(const Side& piece);

}  // namespace lekalo::verify
