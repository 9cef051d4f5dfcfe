#pragma once

#include <optional>
#include <vector>

#include "io/drawing/drawn_shapes.hpp"

namespace lekalo::io {

/// The cubic spline through points, twice continuously differentiable, with the lengths of the chords as
/// parameters. At an end it has the direction that is given there, else no curvature. The bound of the result
/// is what `point_error` of each coordinate and rounding do to it. Nothing where all points are one.
[[nodiscard]] std::optional<BoundedShape> spline_through(const std::vector<geom::Point>& points,
                                                         double point_error,
                                                         std::optional<geom::Point> begins,
                                                         std::optional<geom::Point> ends);

}  // namespace lekalo::io
