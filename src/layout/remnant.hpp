#pragma once

#include "lekalo/layout/workspace.hpp"

namespace lekalo::layout {

/// Returns a large axis-parallel rectangle within `within` that nothing on the sheet meets: no part, defect,
/// hole or border. It is the largest one of a raster of cells that are free for certain, with each side then
/// moved out as far as it goes. The result is empty (low == high) where no cell is free.
[[nodiscard]] geom::GridBox free_rectangle(const Workspace& workspace, Sheet sheet,
                                           const geom::GridBox& within);

}  // namespace lekalo::layout
