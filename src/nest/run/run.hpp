#pragma once

#include "wanted.hpp"

namespace lekalo::nest {

/// Runs the strands until the budget is spent, a stop is asked for, or nothing is left to be gained, and
/// gives the best layout. docs/design/nest.md, step 10.
[[nodiscard]] Nested run(const Problem& problem, const Wanted& wanted, const Options& options,
                         const RunControl& control);

}  // namespace lekalo::nest
