#include "lekalo/layout/document.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lekalo::layout {
namespace {

bool within(geom::GridRotation rotation, double from_degrees, double to_degrees) {
  if (to_degrees - from_degrees >= 360.0) return true;
  return geom::is_between(rotation, geom::rotation_from_degrees(from_degrees),
                          geom::rotation_from_degrees(to_degrees));
}

}  // namespace

bool is_day(std::string_view text) {
  constexpr std::string_view kForm = "0000-00-00";
  if (text.size() != kForm.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (kForm[i] == '-' ? text[i] != '-' : text[i] < '0' || text[i] > '9') return false;
  const auto number = [&](std::size_t first, std::size_t count) {
    unsigned value = 0;
    for (const char digit : text.substr(first, count))
      value = 10 * value + static_cast<unsigned>(digit - '0');
    return value;
  };
  const unsigned year = number(0, 4), month = number(5, 2), day = number(8, 2);
  constexpr std::array<unsigned, 13> kDays{0, 31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (month < 1 || month > 12) return false;
  const bool leap = month == 2 && year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return day >= 1 && day <= kDays[month] + (leap ? 1U : 0U);
}

geom::GridRegion placed_outline(const Part& part, const Placement& placement) {
  return geom::moved(geom::turned(part.outline.polygon, placement.rotation, placement.mirrored),
                     placement.at);
}

bool rotation_allowed(const Part& part, geom::GridRotation rotation) {
  return part.rotations.empty() ||
         std::any_of(part.rotations.begin(), part.rotations.end(),
                     [&](const AngleRange& range) { return within(rotation, range.from, range.to); });
}

bool grain_allowed(const Part& part, const Stock& stock, geom::GridRotation rotation, bool mirrored) {
  if (!part.grain || !stock.grain_degrees) return true;
  const double grain = mirrored ? 180.0 - part.grain->degrees : part.grain->degrees;
  const double middle = *stock.grain_degrees - grain, tolerance = part.grain->tolerance_degrees;
  return within(rotation, middle - tolerance, middle + tolerance) ||
         within(rotation, middle + 180.0 - tolerance, middle + 180.0 + tolerance);
}

std::int64_t wanted(const Document& document, std::uint32_t part) {
  std::int64_t count = document.parts[part].demand;
  for (const Kit& kit : document.kits)
    for (const KitPiece& piece : kit.pieces)
      if (piece.part == part) count += kit.demand * piece.count;
  return count;
}

}  // namespace lekalo::layout
