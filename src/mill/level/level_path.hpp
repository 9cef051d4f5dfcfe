#pragma once

#include <vector>

#include "lekalo/mill/pocket.hpp"
#include "mill/front/fronts.hpp"

namespace lekalo::mill {

/// The path of one level, from Z 0 to -options.depth: a rapid motion to the safe height, the entry, all cuts
/// and links, and a lift to the safe height at the end (docs/design/pocket.md).
/// \param allowed  where the tool's middle may be: one piece
/// \param cleared, left  the same divided: where nothing stands, because other tools have been there, and
/// what is to be cut. With nothing cleared the entry is a helix, else the tool comes down where it is.
[[nodiscard]] Result<PocketPath> level_path(const geom::Region& allowed, const PocketOptions& options,
                                            const std::vector<geom::Region>& cleared,
                                            const std::vector<geom::Region>& left,
                                            const AreaListener& listener);

}  // namespace lekalo::mill
