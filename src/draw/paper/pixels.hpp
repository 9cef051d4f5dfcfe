#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lekalo::draw {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend constexpr bool operator==(const Colour&, const Colour&) = default;
};

/// Rows of pixels from the top.
struct Pixels {
  int columns = 0, rows = 0;
  std::vector<Colour> colours;
};

/// PNG bytes; the same for the same pixels and library. \pre at least one pixel, at most 20,000 each way
[[nodiscard]] std::string pixels_png(const Pixels& pixels);

}  // namespace lekalo::draw
