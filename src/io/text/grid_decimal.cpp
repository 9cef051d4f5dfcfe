#include "grid_decimal.hpp"

#include <string_view>

#include "lekalo/base/assert.hpp"
#include "lekalo/base/double_of_text.hpp"
#include "lekalo/geom/grid.hpp"

namespace lekalo::io::detail {
namespace {

using geom::Int128;

constexpr int kMostPlaces = 17;

/// The value steps * 10^places / 2^bits rounded down, and a flag that the nearest integer is one more (ties
/// count as nearer to it).
struct Scaled {
  std::int64_t floor = 0;
  bool up = false;
};
Scaled scaled(std::int64_t steps, Int128 power, int bits) {
  const Int128 product = Int128{steps} * power, floor = product >> bits;
  return {static_cast<std::int64_t>(floor), product - (floor << bits) >= (Int128{1} << (bits - 1))};
}

/// Writes n / 10^places.
void append_decimal(std::string& text, std::int64_t n, int places) {
  if (n < 0) text += '-';
  std::string digits = std::to_string(n < 0 ? -n : n);
  if (digits.size() <= static_cast<std::size_t>(places))
    digits.insert(0, static_cast<std::size_t>(places) + 1 - digits.size(), '0');
  text.append(digits, 0, digits.size() - static_cast<std::size_t>(places));
  if (places == 0) return;
  text += '.';
  text.append(digits, digits.size() - static_cast<std::size_t>(places));
}

/// Tries 0, 1, 2... places of `choose`'s integer until `back` gives the steps again.
template <class Choose, class Back>
void append_shortest(std::string& text, std::int64_t steps, int bits, const Choose& choose,
                     const Back& back) {
  Int128 power = 1;
  const std::size_t before = text.size();
  for (int places = 0; places <= kMostPlaces; ++places, power *= 10) {
    const std::int64_t n = choose(scaled(steps, power, bits));
    // A decimal that is off by more than a step cannot give the steps again.
    const Int128 off = (Int128{n} << bits) - Int128{steps} * power;
    if (off > power || off < -power) continue;
    append_decimal(text, n, places);
    const auto value = double_of_text(std::string_view(text).substr(before));
    LEKALO_ASSERT(value);
    if (back(*value) == steps) return;
    text.resize(before);
  }
  LEKALO_ASSERT(!"17 places are finer than every step");
}

std::int64_t nearest(Scaled s) { return s.floor + (s.up ? 1 : 0); }

}  // namespace

void append_mm(std::string& text, std::int64_t steps) {
  append_shortest(text, steps, 20, nearest, [](double mm) { return geom::grid_from_mm(mm); });
}

void append_gap(std::string& text, std::int64_t steps) {
  append_shortest(
      text, steps, 20, [](Scaled s) { return s.floor; }, [](double mm) { return geom::grid_from_mm_up(mm); });
}

void append_rotation_step(std::string& text, std::int64_t steps) {
  append_shortest(text, steps, 52, nearest, [](double c) { return geom::rotation_from_pair(c, 0).c; });
}

}  // namespace lekalo::io::detail
