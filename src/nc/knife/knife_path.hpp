#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/geom/region.hpp"
#include "lekalo/nc/knife.hpp"

namespace lekalo::nc::detail {

/// The way of the axis of a knife with the blade down: places in multiples of the step, and for each the
/// edge of the contour that the tip is on.
struct KnifeStroke {
  std::vector<geom::Point> points;
  std::vector<std::size_t> edges;
};

/// Returns the strokes of one contour. \param heading  of the blade before, a unit vector
[[nodiscard]] std::vector<KnifeStroke> knife_strokes(const geom::Contour& contour,
                                                     const KnifeOptions& options, geom::Point heading);

/// Follows the tip of a drag knife and returns how far it is from the contour at most. `heading` becomes that
/// at the end of the stroke.
[[nodiscard]] double farthest_tip(const geom::Contour& contour, const KnifeStroke& stroke,
                                  const KnifeOptions& options, geom::Point& heading);

}  // namespace lekalo::nc::detail
