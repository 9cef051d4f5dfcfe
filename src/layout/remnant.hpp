#pragma once

#include <span>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::layout {

/// Returns a large axis-parallel rectangle within `within` and the material that none of the outlines meets.
/// It is the largest one of a raster of cells that are free for certain, with each side then moved out as far
/// as it goes. The result is empty (low == high) where no cell is free. Cost: O(edges + cells that they
/// pass).
[[nodiscard]] geom::GridBox free_rectangle(const geom::GridRegion& material,
                                           std::span<const geom::GridRegion> outlines,
                                           const geom::GridBox& within);

}  // namespace lekalo::layout
