#pragma once

#include "solid_inputs.hpp"

namespace lekalo::jobs {

/// Moves the nominal mesh to the touches, writes it as the file that counts as the blank, and gives its
/// triangles their widths. bad_input where the touches do not fit, or are none. \pre the job has a nominal
/// mesh, options of a scan and of touches, and a name for the mesh
[[nodiscard]] Result<void> move_nominal(const SolidLocateJob& job, SolidInputs& in);

}  // namespace lekalo::jobs
