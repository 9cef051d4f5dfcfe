#pragma once

#include <optional>
#include <string_view>

namespace lekalo::verify {

/// Limits of a tolerance class of ISO 286 in um, by a table of the checker's own: the one of GB/T 1800, while
/// makers have another. None for what has no limits here.
struct ClassLimits {
  double lower = 0, upper = 0;
};
[[nodiscard]] std::optional<ClassLimits> iso286_limits(double diameter_mm, std::string_view tolerance_class);

}  // namespace lekalo::verify
