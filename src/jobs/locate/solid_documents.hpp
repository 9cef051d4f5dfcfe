#pragma once

#include "solid_inputs.hpp"

namespace lekalo::jobs {

/// Does for solids what the other of this name does for outlines. Programs of three axes are shifted, and
/// turned about Z.
[[nodiscard]] Result<void> add_program(const SolidLocateJob& job, LocatedSolid& made);

/// Makes the picture, the report and the allowances that were asked for.
[[nodiscard]] Result<void> add_pictures(const SolidLocateJob& job, const SolidInputs& in, LocatedSolid& made);

}  // namespace lekalo::jobs
