#pragma once

#include "locate_inputs.hpp"

namespace lekalo::jobs {

/// Rewrites the job's program for the document's placement and records it there (`nc`), unless the placement
/// does not allow it or misses the allowance, with or without the rounding of the program; then a warning
/// says why there is none.
[[nodiscard]] Result<void> add_program(const LocateJob& job, Located& made);

/// Makes the picture, the report, the allowances and the drawing that were asked for.
[[nodiscard]] Result<void> add_pictures(const LocateJob& job, const LocateInputs& in, Located& made);

}  // namespace lekalo::jobs
