#pragma once

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::io {

/// The place where an outline has room for its name.
struct LabelPlace {
  geom::Point at;       ///< mm, in the material: the middle of the widest of a few rows
  double width_mm = 0;  ///< of the material there
};
/// \pre not empty
[[nodiscard]] LabelPlace label_place(const geom::GridRegion& outline);

/// A line of text, so many times as wide as it is high, where it is largest within the material in one of a
/// few rows; a height of 0 where nothing of `least` has room. Heights mm, up to `most`. Cost: about 100 times
/// the points.
struct LabelFit {
  geom::Point middle;
  double height = 0;
};
[[nodiscard]] LabelFit fitted_label(const geom::GridRegion& outline, double wide, double least, double most);

}  // namespace lekalo::io
