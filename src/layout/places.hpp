#pragma once

#include <optional>
#include <vector>

#include "lekalo/layout/workspace.hpp"

namespace lekalo::layout {

/// The valid place found nearest to where the placements lie, moved as one; none when there is none on the
/// sheet. Rings of starts around the place, each drawn towards it along whatever is in the way.
[[nodiscard]] std::optional<std::vector<Placement>> nearest_place(const Workspace& workspace,
                                                                  const std::vector<Placement>& placements);

/// Edge to edge with the nearest neighbour or border within reach (SnapCommand); none when nothing fits.
[[nodiscard]] std::optional<Placement> snapped(const Workspace& workspace, const Placement& placement,
                                               std::int64_t reach);

}  // namespace lekalo::layout
