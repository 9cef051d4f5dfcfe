#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::io {

/// Most lines and arcs that take the place of one curve. An ellipse of a hundred bytes can be as large as the
/// Earth.
inline constexpr std::size_t kMostEdgesOfACurve = 250'000;

/// Lines and arcs instead of a drawn curve: each begins exactly where the one before ends, the first and the
/// last end where the curve does.
struct CurveEdges {
  std::vector<geom::Edge> edges;  ///< none: the curve is a single point
  double curve_error = 0;         ///< mm: proven distance from the curve, both ways; 0 for lines and arcs
  double rounding = 0;            ///< mm: of the computation, on top
};

/// The method and its proof: docs/design/drawing-regions.md. Fails with ErrorCode::bad_input and a sentence
/// that goes on after the curve's name, for numbers that make no curve (fault_of_shape) and where the
/// tolerance cannot be reached: by rounding, or within kMostEdgesOfACurve edges. Cost: O(edges degree^2).
/// \pre tolerance > 0
[[nodiscard]] Result<CurveEdges> edges_of(const Shape& shape, double tolerance);

}  // namespace lekalo::io
