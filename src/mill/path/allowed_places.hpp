#pragma once

#include <vector>

#include "lekalo/mill/pocket.hpp"

namespace lekalo::mill {

/// The places where the tool's middle may be. bad_input for options out of range, and where it may be
/// nowhere; other errors are those of geom::offset.
[[nodiscard]] Result<std::vector<geom::Region>> allowed_places(const std::vector<geom::Region>& pockets,
                                                               const PocketOptions& options);

}  // namespace lekalo::mill
