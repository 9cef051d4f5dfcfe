#pragma once

#include "lekalo/mill/pocket.hpp"

namespace lekalo::mill {

/// The path of one level, from Z 0 to -options.depth: a rapid motion to the safe height, the entry, all cuts
/// and links, and a lift to the safe height at the end.
/// \param allowed  where the tool's middle may be: one piece
[[nodiscard]] Result<PocketPath> level_path(const geom::Region& allowed, const PocketOptions& options);

}  // namespace lekalo::mill
