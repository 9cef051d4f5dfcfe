#pragma once

#include <functional>

#include "lekalo/jobs/nest.hpp"

namespace lekalo::jobs {

/// Has the signature of nest::nest.
using Nester =
    std::function<Result<nest::Nested>(const layout::Document&, const nest::Options&, const RunControl&)>;

/// Does with the findings of any nester what nest() does with those of its own: a test hands in one that
/// breaks rules.
[[nodiscard]] Result<Nested> nest_checked(const Nester& nester, const layout::Document& document,
                                          const NestOptions& options, const RunControl& control);

}  // namespace lekalo::jobs
