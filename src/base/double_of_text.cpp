#include "lekalo/base/double_of_text.hpp"

#include <charconv>
#include <cmath>
#ifndef __cpp_lib_to_chars
#include <cstdlib>
#include <string>
#endif

namespace lekalo {

std::optional<double> double_of_text(std::string_view text) {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t from = at;
    while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
    return at - from;
  };
  if (text.starts_with('-')) ++at;
  std::size_t count = digits();
  if (at < text.size() && text[at] == '.') ++at, count += digits();
  if (count == 0) return std::nullopt;
  const bool is_zero = text.substr(0, at).find_first_of("123456789") == std::string_view::npos;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (digits() == 0) return std::nullopt;
  }
  if (at != text.size()) return std::nullopt;

  double value = 0;
#ifdef __cpp_lib_to_chars
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc{} && !is_zero)
    return std::nullopt;
#else  // WebAssembly: the only locale is "C", and its strtod rounds to the nearest too
  value = std::strtod(std::string(text).c_str(), nullptr);
#endif
  if (!std::isfinite(value) || (value == 0 && !is_zero)) return std::nullopt;
  return value;
}

}  // namespace lekalo
