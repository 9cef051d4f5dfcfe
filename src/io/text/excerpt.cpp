#include "lekalo/io/text/excerpt.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lekalo::io {
namespace {

/// The length of the UTF-8 sequence that begins here, 0 when it is none or not printable.
std::size_t printable_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  // C1 controls (U+0080 to U+009F) and everything that is not plain two- or three-byte text stay hexadecimal.
  const std::size_t length = byte(0) >= 0xc3 && byte(0) < 0xe0   ? 2
                             : byte(0) >= 0xe1 && byte(0) < 0xed ? 3
                                                                 : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return 0;
  }
  return length;
}

}  // namespace

std::string excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string out = "'";
  for (std::size_t at = 0, shown = 0; at < text.size(); ++shown) {
    if (shown == kLongest) return out + "...'";
    const std::size_t length = printable_length(text.substr(at));
    if (length == 0) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at]));
    } else {
      out += text.substr(at, length);
    }
    at += std::max<std::size_t>(length, 1);
  }
  return out + "'";
}

}  // namespace lekalo::io
