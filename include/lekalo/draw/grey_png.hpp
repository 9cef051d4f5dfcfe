#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::draw {

/// A grey picture whose numbers matter: no gamma, no palette, no alpha.
struct GreyImage {
  std::size_t columns = 0, rows = 0;
  /// The bits of a pixel, 8 or 16.
  int bits = 16;
  std::vector<std::uint16_t> pixels;  ///< rows from the top
  /// Keys (1 to 79 letters) and values, Latin-1.
  std::vector<std::pair<std::string, std::string>> texts;
};

/// PNG bytes; the same for the same image and library. ErrorCode::environment when the library fails.
/// \pre columns * rows pixels, each below 2^bits; 1 to 30,000 columns and rows
[[nodiscard]] Result<std::string> grey_png(const GreyImage& image);

/// Law: parse_grey_png(grey_png(i)) is i. bad_input, naming the file, for what is no PNG, is damaged, is not
/// grey with 8 or 16 bits, or has more than 30,000 columns or rows or 10^8 pixels.
[[nodiscard]] Result<GreyImage> parse_grey_png(std::string_view bytes, const std::string& name);

}  // namespace lekalo::draw
