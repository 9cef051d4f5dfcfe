#pragma once

#include "lekalo/jobs/phases.hpp"
#include "solid_inputs.hpp"

namespace lekalo::jobs {

/// Makes the mesh of a blank from its points, and writes it as the file that counts as the blank. bad_input
/// where nobody says how, or where the points enclose nothing.
[[nodiscard]] Result<void> mesh_points(const SolidLocateJob& job, const io::SolidFile& file,
                                       const PhaseListener& phases, SolidInputs& in);

/// Holds the guaranteed blank against all points that it was made from: one that lies deeper in it than
/// points are uncertain by says that a statement is not true. bad_input then; none is, where parts are
/// unknown. \pre the blank has its widths
[[nodiscard]] Result<void> hold_against_points(const SolidLocateJob& job, SolidInputs& in);

}  // namespace lekalo::jobs
