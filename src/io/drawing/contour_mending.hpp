#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "contour_closing.hpp"
#include "lekalo/geom/curve_faces.hpp"

namespace lekalo::io {

/// An edge that bounds no area, and the curve that it comes from.
struct LooseEdge {
  geom::Edge edge;
  std::uint32_t curve = 0;
};

struct Mended {
  /// Each by itself free of faults. Outer ones run counter-clockwise, holes clockwise.
  std::vector<LooseContour> contours;
  /// Along these no contour runs.
  std::vector<LooseEdge> marks;
  std::vector<MovedCurve> moved;  ///< none by more than `repair`
};

/// How far mends may go, mm.
struct MendLimits {
  double speck = 0.01;  ///< loops and spikes no longer than this are cut off
  double repair = 0.2;  ///< no outline moves further
};

/// Says whether a contour that lines make where they cross is no larger than twice `repair`, or nowhere wider
/// than `repair` and a speck, so that no larger disc fits into it: then nobody drew it as a part or a hole.
[[nodiscard]] bool is_by_product(const geom::Contour& contour, const MendLimits& limits);

/// Makes contours that meet nowhere but in corners out of contours that cross or touch themselves or each
/// other, by the rule. Loops that lie within `repair` of the corner by which they hang on the rest are joined
/// to it through a neck, or cut off if they are specks or no neck will do; other by-products are marks, and
/// larger loops contours of their own. Spikes and slivers are cut off up to the size of a speck, and marks
/// beyond it. Where a hole touches, its corner is moved into the hole.
///
/// Loops that enclose nothing, or no more than slivers, are marks alone. Nothing where that leaves a contour
/// with a fault.
[[nodiscard]] std::optional<Mended> mended(const std::vector<LooseContour>& contours, geom::FillRule rule,
                                           const MendLimits& limits);

/// Corners that touch are pulled apart by this on either side, mm: a hundred steps of the grid of layouts.
/// A smaller number makes necks that layouts lose in rounding, a larger one is loss.
inline constexpr double kNeck = 1e-4;

}  // namespace lekalo::io
