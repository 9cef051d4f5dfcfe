#pragma once

#include <optional>

#include "shape.hpp"

namespace lekalo::verify {

/// Distances between points and outlines of shapes, enclosed. The formulas are those of a textbook. Every
/// case that rounding leaves open is taken into the lower end and left out of the upper one. There is no
/// index and no search: each call looks at every side.

/// Returns false when the arc certainly has no point in this direction from its centre.
[[nodiscard]] bool may_face(const Side& arc, const Vec& direction);
/// Returns true when it certainly has one.
[[nodiscard]] bool surely_faces(const Side& arc, const Vec& direction);

[[nodiscard]] Span distance(const Vec& p, const Side& side);
/// Returns a distance whose low end is 0 where the sides meet or may meet.
[[nodiscard]] Span distance(const Side& a, const Side& b);
[[nodiscard]] Span distance(const Vec& p, const Shape& shape);
[[nodiscard]] Span distance(const Shape& a, const Shape& b);

/// Returns some points of a side.
[[nodiscard]] std::vector<Vec> points_of(const Side& side);

}  // namespace lekalo::verify
