#pragma once

#include <cstdint>
#include <string>

#include "lekalo/layout/document.hpp"

namespace lekalo::layout {

/// A thickness in mm, with as many of four decimals as it needs; a grid step is less than half of the last.
[[nodiscard]] std::string thickness_text(std::int64_t steps);

/// A material for people: "steel, 2 mm", "steel", "2 mm" or "no material".
[[nodiscard]] std::string words_of(const Material& material);

}  // namespace lekalo::layout
