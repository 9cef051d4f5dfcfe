#pragma once

#include "lekalo/base/error.hpp"
#include "lekalo/locate/placement.hpp"

namespace lekalo::locate {

/// Fails with ErrorCode::usage for a window that is empty, not finite or wider than a full circle, a gap that
/// is not a positive number, and a minimum allowance that is not finite.
[[nodiscard]] Result<void> check_limits(const AngleWindow& window, double gap, double min_allowance);

}  // namespace lekalo::locate
