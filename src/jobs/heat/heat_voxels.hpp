#pragma once

#include <optional>
#include <string>

#include "lekalo/jobs/heat.hpp"

namespace lekalo::jobs {

/// The size of voxels against that of what they divide: docs/design/heat.md, "Limits".

/// bad_input with one sentence where voxels are larger than the stock is thick or wide, or the pocket wide.
[[nodiscard]] Result<void> check_voxels(const HeatJob& job, const HeatSource& source);

/// A sentence where the thinnest of the stock, the floor under the deepest cut, and what stands between a
/// wall and the outside has fewer than four voxels across.
[[nodiscard]] std::optional<std::string> thin_voxels(const HeatJob& job, const HeatFound& found);

}  // namespace lekalo::jobs
