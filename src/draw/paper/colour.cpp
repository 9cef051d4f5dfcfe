#include "colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lekalo::draw {
namespace {

constexpr std::array<Colour, 9> kStops{{{253, 147, 11},
                                        {249, 114, 51},
                                        {231, 90, 87},
                                        {206, 71, 111},
                                        {175, 59, 129},
                                        {141, 51, 140},
                                        {106, 45, 143},
                                        {69, 39, 138},
                                        {29, 34, 125}}};

std::uint8_t between(std::uint8_t a, std::uint8_t b, double share) {
  return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
}

}  // namespace

Colour scale_colour(int step) {
  const double place =
      static_cast<double>(std::clamp(step, 0, kColourSteps - 1)) * (kStops.size() - 1.0) / (kColourSteps - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  const double share = place - static_cast<double>(i);
  const Colour a = kStops[i], b = kStops[i + 1];
  return {between(a.red, b.red, share), between(a.green, b.green, share), between(a.blue, b.blue, share)};
}

Colour colour_of_status(std::string_view status) {
  if (status == "optimal") return kGood;
  return status == "infeasible" ? kOutside : kDoubt;
}

int scale_step(double value, double low, double high) {
  if (!(value > low)) return 0;
  if (!(value < high)) return kColourSteps - 1;
  const double share = (value - low) / (high - low);
  return std::min(static_cast<int>(share * kColourSteps), kColourSteps - 1);
}

ColourRange colour_range(double least, double greatest, double rounding, double size) {
  ColourRange range{std::max(0.0, least), std::max(0.0, greatest)};
  // An even allowance is shown in one colour, because differences that nobody can measure would otherwise be
  // stretched over all colours.
  if (!(range.high - range.low > 0.02 * range.high)) range.low = 0;
  // If there is no allowance anywhere, all of it is shown as thin, on a scale that fits the size of the
  // blank.
  if (!(range.high > rounding)) range.high = 0.01 * size;
  return range;
}

}  // namespace lekalo::draw
