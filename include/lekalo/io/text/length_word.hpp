#pragma once

#include <optional>
#include <string_view>

namespace lekalo::io {

/// Reads a length as people write it, in millimetres: a number, a fraction or both, and a unit behind it, mm
/// where there is none: "3", "3 mm", "2.5cm", "1/8in", "1 1/2 in", "2ft", "0.5m". Nothing for other words.
[[nodiscard]] std::optional<double> length_of(std::string_view word);

}  // namespace lekalo::io
