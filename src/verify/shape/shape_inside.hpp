#pragma once

#include <optional>

#include "shape.hpp"

namespace lekalo::verify {

/// Winding numbers decide what lies inside what, so a contour need not be simple or run one way. Where
/// rounding leaves the answer open, or a contour winds about a point more than once, the functions return
/// nothing.

/// Says whether p is inside the outer contour of a piece and in none of its holes.
[[nodiscard]] std::optional<bool> holds(const Shape& shape, const Vec& p);

/// Returns the distance from the outline, positive in the material.
[[nodiscard]] Span signed_distance(const Vec& p, const Shape& shape);

/// Says whether all of `inner`'s material lies in `outer`'s.
/// \pre their outlines do not meet
[[nodiscard]] std::optional<bool> lies_within(const Shape& inner, const Shape& outer);

/// Returns the first fault of a shape: sides that meet (or cannot be told from it) and are not neighbours, a
/// hole outside its outer contour or in another hole, a piece in the material of another. In a shape with a
/// fault the outline is not the boundary of the material, and no distance from the one says anything about
/// the other.
[[nodiscard]] std::optional<std::string> fault_of(const Shape& shape);

}  // namespace lekalo::verify
