#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::io {

/// A pole in homogeneous coordinates: the point times its weight, and the weight.
struct WeightedPoint {
  double x = 0, y = 0, w = 1;
  [[nodiscard]] geom::Point point() const noexcept { return {x / w, y / w}; }
};

/// A rational Bezier curve over [0, 1]; weights above 0.
struct Bezier {
  std::size_t degree = 0;
  std::array<WeightedPoint, kHighestDegree + 1> poles;
};

/// Bezier pieces that follow each other, and how far rounding may have moved them, mm.
struct BezierChain {
  std::vector<Bezier> pieces;
  double error = 0;
};

/// The weights of one spline may differ by this factor at most: beyond it the products of poles and weights
/// lose digits that the bounds count on. Drawing programs stay below 1e3.
inline constexpr double kLargestWeightRatio = 1e9;
/// The largest |begin| of an EllipseArc, for the same reason.
inline constexpr double kLargestParameter = 64;

/// Every computed point of a curve (pieces, parts of pieces, points) lies within this times the curve's size
/// of the exact one, its size being the largest coordinate of its poles, or |centre| + |u| + |v|: all steps
/// are convex combinations, at most four times the degree of them (60), each with 11 units of rounding,
/// a sine or a shift before and products after, below 2^13 u in all. One bit is in reserve.
inline constexpr double kCurveRounding = 0x1p-39;

/// Names the fault of a shape's numbers, if there is one: not finite, too large, too few poles, knots that
/// descend or a curve that jumps where a knot stands more than `degree` times.
[[nodiscard]] std::optional<std::string> fault_of_shape(const Shape& shape);

/// \pre no fault_of_shape
[[nodiscard]] BezierChain bezier_chain(const Spline& spline);
[[nodiscard]] BezierChain bezier_chain(const EllipseArc& arc);

/// The curve over [begin, end], 0 <= begin < end <= 1.
[[nodiscard]] Bezier part_of(const Bezier& piece, double begin, double end) noexcept;
[[nodiscard]] geom::Point point_at(const Bezier& piece, double t) noexcept;

}  // namespace lekalo::io
