#pragma once

#include <optional>
#include <string_view>

namespace lekalo::io {

/// Reads a length as people write it, in millimetres: a number, a fraction or both, and a unit behind it, mm
/// where there is none: "3", "3 mm", "2.5cm", "1/8in", "1 1/2 in", "2ft", "0.5m". Nothing for other words.
[[nodiscard]] std::optional<double> length_of(std::string_view word);

/// The sides of a rectangle.
struct PlaneSize {
  double width_mm = 0, height_mm = 0;
};
/// Reads "3000x1500", "8ftx4ft", "48x96in"; a unit that stands once, at the end, counts for both. Nothing for
/// other words.
[[nodiscard]] std::optional<PlaneSize> size_of(std::string_view word);

}  // namespace lekalo::io
