#pragma once

#include <optional>

#include "shape.hpp"

namespace lekalo::verify {

/// Distances between points and outlines of shapes, enclosed: by the formulas of a textbook, every case that
/// rounding leaves open taken into the lower end and left out of the upper one. No index, no search: each
/// call looks at every side.

/// False when the arc certainly has no point in this direction from its centre.
[[nodiscard]] bool may_face(const Side& arc, const Vec& direction);
/// True when it certainly has one.
[[nodiscard]] bool surely_faces(const Side& arc, const Vec& direction);

[[nodiscard]] Span distance(const Vec& p, const Side& side);
/// low is 0 where the sides meet or may meet.
[[nodiscard]] Span distance(const Side& a, const Side& b);
[[nodiscard]] Span distance(const Vec& p, const Shape& shape);
[[nodiscard]] Span distance(const Shape& a, const Shape& b);

/// Some points of a side.
[[nodiscard]] std::vector<Vec> points_of(const Side& side);

}  // namespace lekalo::verify
