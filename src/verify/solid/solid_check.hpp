#pragma once

#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/read/json.hpp"

namespace lekalo::verify {

/// Rechecks a result for solids, which is one that has a quaternion.
[[nodiscard]] Result<LocateReport> check_solids(const LocateInputs& inputs, Json written);

}  // namespace lekalo::verify
