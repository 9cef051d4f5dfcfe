#pragma once

#include <vector>

#include "lekalo/mill/pocket.hpp"

namespace lekalo::mill {

/// The path of one level, from Z 0 to -options.depth: a rapid motion to the safe height, the entry, all cuts
/// and links, and a lift to the safe height at the end.
/// \param allowed      where the tool's middle may be: one piece
/// \param cut_already  where it need not be any more, though it may; may be empty
[[nodiscard]] Result<PocketPath> level_path(const geom::Region& allowed, const PocketOptions& options,
                                            const std::vector<geom::Region>& cut_already);

}  // namespace lekalo::mill
