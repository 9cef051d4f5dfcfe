#pragma once

#include <string>
#include <vector>

#include "lekalo/verify/layout.hpp"

namespace lekalo::verify {

/// Returns a sentence for each rule that is broken.
[[nodiscard]] std::vector<std::string> sentences(const std::vector<LayoutViolation>& violations);

}  // namespace lekalo::verify
