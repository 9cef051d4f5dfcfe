#pragma once

#include "solid_inputs.hpp"

namespace lekalo::jobs {

/// Makes the picture, the report and the allowances that were asked for.
[[nodiscard]] Result<void> add_pictures(const SolidLocateJob& job, const SolidInputs& in, LocatedSolid& made);

}  // namespace lekalo::jobs
