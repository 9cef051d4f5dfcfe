#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::phi {

/// An outline with its box's low corner in the origin, laid out for speed. Coordinates are whole numbers
/// below 2^41, so doubles hold them, and their differences, exactly.
struct FlatOutline {
  geom::GridRegion region;  ///< moved to the origin
  std::int64_t width = 0, height = 0;
  bool box = false;  ///< an axis-parallel rectangle without holes
};

[[nodiscard]] FlatOutline flat_outline(const geom::GridRegion& region);

}  // namespace lekalo::phi
