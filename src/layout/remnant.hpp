#pragma once

#include "lekalo/layout/workspace.hpp"

namespace lekalo::layout {

/// A large axis-parallel rectangle within `within` that nothing on the sheet meets: no part, defect, hole or
/// border. The largest one of a raster of cells that are free for certain, each side then moved out as far as
/// it goes. Empty (low == high) where no cell is free.
[[nodiscard]] geom::GridBox free_rectangle(const Workspace& workspace, Sheet sheet,
                                           const geom::GridBox& within);

}  // namespace lekalo::layout
