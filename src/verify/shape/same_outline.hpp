#pragma once

#include "shape.hpp"

namespace lekalo::verify {

/// Says whether two shapes have the same decimals on all sides, whatever their order, directions and first
/// points. Without faults they are the same set of points then.
[[nodiscard]] bool same_outline(const Shape& a, const Shape& b);

}  // namespace lekalo::verify
