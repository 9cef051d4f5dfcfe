#include "search_limits.hpp"

#include <fmt/core.h>

#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::locate {

Result<void> check_limits(const AngleWindow& window, double gap, double min_allowance) {
  if (!(window.from <= window.to) || !(std::abs(window.from) <= geom::kMaxAngle) ||
      !(std::abs(window.to) <= geom::kMaxAngle))
    return failure(ErrorCode::usage, fmt::format("angle window from {} to {} rad is empty or not finite",
                                                 window.from, window.to));
  if (window.to - window.from > kTurnAbove)
    return failure(ErrorCode::usage, "angle window is wider than a full circle");
  if (!(gap > 0) || !std::isfinite(gap))
    return failure(ErrorCode::usage, fmt::format("gap {} mm must be a positive number", gap));
  if (!std::isfinite(min_allowance))
    return failure(ErrorCode::usage, "minimum allowance is not a finite number");
  return {};
}

}  // namespace lekalo::locate
