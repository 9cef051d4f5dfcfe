#pragma once

#include <optional>
#include <vector>

#include "lekalo/layout/workspace.hpp"

namespace lekalo::layout {

/// Returns the valid place found nearest to where the placements lie, moved as one, or none when there is
/// none on the sheet. The search tries rings of starts around the place, and draws each start towards the
/// place along whatever is in the way.
[[nodiscard]] std::optional<std::vector<Placement>> nearest_place(const Workspace& workspace,
                                                                  const std::vector<Placement>& placements);

/// Returns the place edge to edge with the nearest neighbour or border within reach (SnapCommand), or none
/// when nothing fits.
[[nodiscard]] std::optional<Placement> snapped(const Workspace& workspace, const Placement& placement,
                                               std::int64_t reach);

}  // namespace lekalo::layout
