#pragma once

#include <array>
#include <optional>

#include "shape.hpp"

namespace lekalo::verify {

/// Stretches of outlines: lines, and arcs of less than half a turn, and how far they reach.

/// The corners of a convex set that holds a line, or an arc of less than half a turn.
struct Corners {
  std::array<Vec, 3> at;
  std::size_t count = 0;
};
[[nodiscard]] Corners corners_of(const Side& piece);

/// Returns a distance that no point of the piece exceeds from c.
[[nodiscard]] double farthest(const Side& piece, const Vec& c);
/// Returns a distance that no point of the piece exceeds from the side.
[[nodiscard]] double farthest(const Side& piece, const Corners& corners, const Side& side);

/// Returns two parts that make up the whole, about halves; an arc may have any sweep. Where an arc is too
/// short for rounding to cut it, both parts are the whole arc.
[[nodiscard]] std::array<Side, 2> halves(const Side& piece);

/// Returns the parts before and behind the place of a line, or of an arc of less than half a turn, that is
/// nearest to a point; an arc runs from its first direction to its last. Nothing where that is not surely
/// between the ends.
[[nodiscard]] std::optional<std::array<Side, 2>> cut_beside(const Side& piece, const Vec& point);
/// Returns about the first or the last 16th of a line, or of an arc of less than half a turn, and the
/// rest of it, in their order along it. Where an arc is too short for rounding to cut it, a part is the whole
/// arc.
[[nodiscard]] std::array<Side, 2> with_end_cut_off(const Side& piece, bool first);

}  // namespace lekalo::verify
