#include "header.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <variant>

#include "io/text/refusal.hpp"

namespace lekalo::io {
namespace {

struct KnownUnit {
  std::string_view code;
  const char* name;
  DecimalFactor factor;
};

// $INSUNITS as the DXF reference numbers it; the rest are refused.
constexpr KnownUnit kUnits[] = {
    {"1", "inch", {254, -1}},      {"2", "foot", {3048, -1}},     {"3", "mile", {1609344, 0}},
    {"4", "mm", {1, 0}},           {"5", "cm", {1, 1}},           {"6", "m", {1, 3}},
    {"7", "km", {1, 6}},           {"8", "microinch", {254, -7}}, {"9", "mil", {254, -4}},
    {"10", "yard", {9144, -1}},    {"11", "angstrom", {1, -7}},   {"12", "nm", {1, -6}},
    {"13", "micrometre", {1, -3}}, {"14", "dm", {1, 2}},          {"15", "dam", {1, 4}},
    {"16", "hm", {1, 5}},
};

const char* other_unit(std::string_view code) {
  constexpr std::pair<std::string_view, const char*> kOthers[] = {
      {"17", "gigametres"},      {"18", "astronomical units"}, {"19", "light years"},
      {"20", "parsecs"},         {"21", "US survey feet"},     {"22", "US survey inches"},
      {"23", "US survey yards"}, {"24", "US survey miles"}};
  for (const auto& [known, word] : kOthers) {
    if (code == known) return word;
  }
  return "a number that stands for no unit";
}

}  // namespace

double DrawingUnit::millimetres() const noexcept {
  // Multipliers and powers up to 10^15 are doubles, so this is the nearest one to the ratio.
  double power = 1;
  for (int i = 0; i < std::abs(factor.exponent); ++i) power *= 10;
  return factor.exponent < 0 ? factor.multiplier / power : factor.multiplier * power;
}

bool suggests_inches(const std::vector<DrawnCurve>& curves, const DxfHeader& header) {
  constexpr double kSheetOfFeet = 120;
  geom::Point low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  bool on_32nds = true, off_halves = false;
  const auto see = [&](const geom::Point& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    for (const double c : {p.x, p.y}) {
      on_32nds = on_32nds && c * 32 == std::round(c * 32);
      off_halves = off_halves || c * 2 != std::round(c * 2);
    }
  };
  for (const DrawnCurve& curve : curves)
    if (const auto* edge = std::get_if<geom::Edge>(&curve.shape); edge && edge->kind == geom::EdgeKind::line)
      see(edge->from), see(edge->to);
  const double reach = std::max(high.x - low.x, high.y - low.y);
  return reach > 0 && reach < kSheetOfFeet && (header.english || (on_32nds && off_halves));
}

Result<DrawingUnit> drawing_unit(const DxfHeader& header, std::optional<LengthUnit> user_says,
                                 const std::string& name) {
  const char* asked = !user_says ? nullptr : *user_says == LengthUnit::inch ? "inch" : "mm";
  if (header.unit.empty() || header.unit == "0") {
    const LengthUnit unit = user_says.value_or(LengthUnit::millimetre);
    return DrawingUnit{asked == nullptr ? "mm" : asked, decimal_factor(unit), user_says.has_value()};
  }
  for (const KnownUnit& known : kUnits) {
    if (header.unit != known.code) continue;
    if (asked != nullptr && std::string_view(asked) != known.name) {
      return refuse_line(
          name, header.unit_line,
          fmt::format("$INSUNITS says {}, but {} was asked for; leave --units out or correct the file",
                      known.name, asked));
    }
    return DrawingUnit{known.name, known.factor, true};
  }
  return refuse_line(name, header.unit_line,
                     fmt::format("$INSUNITS {} ({}): save the drawing in mm (4) or inches (1)",
                                 excerpt(header.unit), other_unit(header.unit)));
}

}  // namespace lekalo::io
