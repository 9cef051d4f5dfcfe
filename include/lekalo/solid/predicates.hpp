#pragma once

#include "lekalo/solid/vector.hpp"

namespace lekalo::solid {

/// Says on which side of the plane through a, b and c the point p lies: +1 where a, b, c turn
/// counter-clockwise as seen from p, -1 on the other side, 0 on the plane. It is the sign of (b - a) x (c -
/// a) . (p - a), exact: a floating-point filter answers nearly always, else an expansion of exact products
/// does. \pre every coordinate is 0 or its magnitude lies from 2^-320 to 2^320, so that no product of three
/// underflows or overflows. Source: Shewchuk 1997, section 4.3, for the idea; bound and code are our own.
[[nodiscard]] int side_of_plane(Vector a, Vector b, Vector c, Vector p) noexcept;

}  // namespace lekalo::solid
