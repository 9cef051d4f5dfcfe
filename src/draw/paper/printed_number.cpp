#include "printed_number.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lekalo/io/text/words.hpp"

namespace lekalo::draw {
namespace {

std::string without_minus_zero(std::string text) {
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  return zero && text.front() == '-' ? text.substr(1) : text;
}

double parsed(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

bool wrong_side(const std::string& text, double value, Rounding rounding) {
  return (rounding == Rounding::down && parsed(text) > value) ||
         (rounding == Rounding::up && parsed(text) < value);
}

/// Writes a number fixed-point or, with `scientific`, as d.dde-x: the nearest such number, or the next one on
/// the side asked for.
std::string directed(double value, int decimals, Rounding rounding, bool scientific) {
  const auto write = [&](double v) {
    return scientific ? fmt::format("{:.{}e}", v, decimals) : fmt::format("{:.{}f}", v, decimals);
  };
  std::string text = write(value);
  if (!wrong_side(text, value, rounding)) return text;
  const double exponent = scientific ? std::floor(std::log10(std::abs(value))) : 0;
  const double last_place = std::pow(10.0, exponent - decimals);
  // The number nearest to the value half a unit further is the next one on that side, unless the sum is
  // rounded back. Then a whole unit is added.
  for (const double units : {0.5, 1.0}) {
    const double shift = rounding == Rounding::down ? -units * last_place : units * last_place;
    text = write(value + shift);
    if (!wrong_side(text, value, rounding)) break;
  }
  return text;
}

std::string superscript(int number) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(number)) {
    text += c == '-' ? "⁻" : kDigits[c - '0'];
  }
  return text;
}

}  // namespace

int decimals_for(double size) {
  if (!(size > 0) || !std::isfinite(size)) return 6;
  const int power = static_cast<int>(std::floor(std::log10(size)));
  return power < 4 ? std::clamp(7 - power, 6, 14) : std::max(9 - power, 3);
}

std::string decimal(double value, int decimals, Rounding rounding) {
  if (!std::isfinite(value)) return "–";
  const double size = std::abs(value);
  const double readable = std::max(10 * std::pow(10.0, -decimals), decimals > 8 ? 1e-4 : 0.0);
  const bool scientific = (size != 0 && size < readable) || size >= 1e15;
  if (!scientific) return without_minus_zero(directed(value, decimals, rounding, false));
  const int exponent = static_cast<int>(std::floor(std::log10(size)));
  return directed(value, std::clamp(decimals + exponent, 3, 16), rounding, true);
}

std::string short_number_up(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size < 1e-3 || size >= 1e6) return directed(value, 1, Rounding::up, true);
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(size))));
  return directed(value, decimals, Rounding::up, false);
}

std::string LengthScale::text(double mm) const {
  return without_minus_zero(fmt::format("{:.{}f}", mm / unit, decimals));
}
std::string LengthScale::text_with_unit(double mm) const {
  return unit == 1 ? text(mm) + " mm" : text(mm) + "·" + unit_name;
}

LengthScale length_scale(double step, double largest) {
  const int step_power = static_cast<int>(std::floor(std::log10(step) + 1e-9));
  const int largest_power = static_cast<int>(std::floor(std::log10(largest) + 1e-9));
  if (step_power >= -4 && largest_power <= 5) return {1, "mm", std::max(0, -step_power)};
  return {std::pow(10.0, largest_power), "10" + superscript(largest_power) + " mm",
          std::max(0, largest_power - step_power)};
}

double round_length(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= value) return factor * power;
  }
  return power;
}

double tick_step(double low, double high, double width, double font_size) {
  const double range = high - low, largest = std::max(std::abs(low), std::abs(high));
  double share = 3;
  double step = round_length(range / share);
  for (; share > 0.4; share *= 0.7) {
    step = round_length(range / share);
    const double widest = font_size * io::text_width(length_scale(step, largest).text(low < 0 ? low : high));
    if (step / range * width > 1.3 * widest) break;
  }
  return step;
}

}  // namespace lekalo::draw
