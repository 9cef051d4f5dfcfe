#pragma once

#include <limits>
#include <optional>

#include "shape.hpp"

namespace lekalo::verify {

/// Distances between points and outlines of shapes, enclosed. The formulas are those of a textbook. Every
/// case that rounding leaves open is taken into the lower end and left out of the upper one. A side is looked
/// at unless its box is surely farther than what was found.

inline constexpr std::size_t kNoSide = std::numeric_limits<std::size_t>::max();

/// Returns the box of an enclosed point.
[[nodiscard]] Box box_of(const Vec& p);

/// Returns false when the arc certainly has no point in this direction from its centre.
[[nodiscard]] bool may_face(const Side& arc, const Vec& direction);
/// Returns true when it certainly has one.
[[nodiscard]] bool surely_faces(const Side& arc, const Vec& direction);
/// Returns true when the nearest point to p of the line or circle that carries the side is certainly on it.
[[nodiscard]] bool surely_beside(const Side& side, const Vec& p);

[[nodiscard]] Span distance(const Vec& p, const Side& side);
/// Returns a distance whose low end is 0 where the sides meet or may meet.
[[nodiscard]] Span distance(const Side& a, const Side& b);
/// Says whether two sides surely do not meet because the lines or circles that carry them do not, which is
/// much cheaper than their distance. Those of nested circles and slanting slots have boxes that all meet.
[[nodiscard]] bool carriers_apart(const Side& a, const Side& b);
/// Returns the distance from a shape's outline, with one side left out if it is named.
[[nodiscard]] Span distance(const Vec& p, const Shape& shape, std::size_t except = kNoSide);
[[nodiscard]] Span distance(const Side& side, const Shape& shape);
[[nodiscard]] Span distance(const Shape& a, const Shape& b);
/// Returns some points of a side.
[[nodiscard]] std::vector<Vec> points_of(const Side& side);

}  // namespace lekalo::verify
