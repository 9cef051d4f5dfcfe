#pragma once

#include "lekalo/field/r_function.hpp"
#include "lekalo/geom/point.hpp"

namespace lekalo::field {

/// Function of local zeroing of a segment: 0 exactly on it, positive elsewhere. The source gives no formula;
/// these are Rvachev's trimmed segment (V. Shapiro, Acta Numerica 2007) in two forms. With f the distance
/// from the line, c the middle, L the length, t = (L^2 / 4 - |x - c|^2) / L:
///   normalised  sqrt(f^2 + ((sqrt(t^2 + f^4 / L^2) - t) / 2)^2): near the segment the distance, in mm
///   algebraic   f^2 / L - t + sqrt(f^4 / L^2 + t^2): near the segment the square of the distance, in mm
/// Away from the segment both grow with the square of the distance over L.
enum class FlozForm { normalised, algebraic };

/// A segment with what its functions need; the same for either direction, to the bit.
struct FlozSegment {
  geom::Point middle, along;  ///< `along` is a unit vector
  double length = 1;
};

/// \pre a != b, both finite
[[nodiscard]] FlozSegment floz_segment(geom::Point a, geom::Point b) noexcept;

/// Value and gradient, the gradient 0 on the segment itself. Value within 16 units in the last place of the
/// largest of |x - c|, L and the value, for |x - c| <= 1e6 L.
[[nodiscard]] Jet floz(const FlozSegment& segment, geom::Point x, FlozForm form) noexcept;

/// Bounds on the value over the disc of this radius about x; the larger the disc, the wider apart.
struct FlozBounds {
  double low = 0, high = 0;
};
[[nodiscard]] FlozBounds floz_bounds(const FlozSegment& segment, geom::Point x, double radius,
                                     FlozForm form) noexcept;

}  // namespace lekalo::field
