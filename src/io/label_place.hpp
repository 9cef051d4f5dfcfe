#pragma once

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::io::detail {

/// Where an outline has room for its name.
struct LabelPlace {
  geom::Point at;        ///< mm, in the material: the middle of the widest of a few rows
  double width_mm = 0;   ///< of the material there
  double height_mm = 0;  ///< of the whole outline
};
/// \pre not empty
[[nodiscard]] LabelPlace label_place(const geom::GridRegion& outline);

}  // namespace lekalo::io::detail
