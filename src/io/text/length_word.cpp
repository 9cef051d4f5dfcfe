#include "lekalo/io/text/length_word.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "lekalo/base/units.hpp"

namespace lekalo::io {
namespace {

struct Unit {
  std::string_view name;
  double mm;
};
constexpr std::array kUnitsOfLength{Unit{"mm", 1},
                                    Unit{"cm", 10},
                                    Unit{"m", 1000},
                                    Unit{"inch", kMillimetresPerInch},
                                    Unit{"in", kMillimetresPerInch},
                                    Unit{"\"", kMillimetresPerInch},
                                    Unit{"ft", 12 * kMillimetresPerInch},
                                    Unit{"'", 12 * kMillimetresPerInch}};

std::string_view without_spaces(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool is_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// "1/8" and "1 1/2", whose parts are whole numbers.
std::optional<double> fraction_of(std::string_view text) {
  const std::size_t slash = text.find('/');
  std::string_view above = without_spaces(text.substr(0, slash));
  const std::string_view below = without_spaces(text.substr(slash + 1));
  double whole = 0;
  if (const std::size_t blank = above.find(' '); blank != std::string_view::npos) {
    const std::string_view before = above.substr(0, blank);
    if (!is_digits(before)) return std::nullopt;
    whole = *number_of(before);
    above = without_spaces(above.substr(blank));
  }
  if (!is_digits(above) || !is_digits(below) || *number_of(below) == 0) return std::nullopt;
  return whole + *number_of(above) / *number_of(below);
}

}  // namespace

std::optional<double> length_of(std::string_view word) {
  word = without_spaces(word);
  double mm = 1;
  for (const Unit& unit : kUnitsOfLength) {
    if (word.size() <= unit.name.size() || word.substr(word.size() - unit.name.size()) != unit.name) continue;
    mm = unit.mm;
    word = without_spaces(word.substr(0, word.size() - unit.name.size()));
    break;
  }
  const auto number = word.find('/') == std::string_view::npos ? number_of(word) : fraction_of(word);
  if (!number) return std::nullopt;
  return *number * mm;
}

std::optional<PlaneSize> size_of(std::string_view word) {
  for (std::size_t at = word.find('x'); at != std::string_view::npos; at = word.find('x', at + 1)) {
    const std::string_view right = word.substr(at + 1);
    std::string left(word.substr(0, at));
    const auto height = length_of(right);
    if (!height || !length_of(left)) continue;
    if (left.find_last_of("0123456789.") == left.find_last_not_of(' '))
      left += right.substr(right.find_last_of("0123456789.") + 1);
    return PlaneSize{*length_of(left), *height};
  }
  return std::nullopt;
}

}  // namespace lekalo::io
