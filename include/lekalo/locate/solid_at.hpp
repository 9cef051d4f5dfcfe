#pragma once

#include <optional>

#include "lekalo/locate/solid.hpp"

namespace lekalo::locate {

/// Measures the part at a pose that somebody chose, as place_solid measures the one that it finds: with the
/// contacts that hold it there. Nothing where the pose is not in the window. Refuses what place_solid
/// refuses.
[[nodiscard]] Result<std::optional<SolidPlacement>> solid_at(const SolidProblem& problem,
                                                             const SolidPose& pose,
                                                             const SolidOptions& options);

}  // namespace lekalo::locate
