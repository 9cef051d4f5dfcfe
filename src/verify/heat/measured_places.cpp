#include "measured_places.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

/// The maker takes a place for one of the stock within this, mm, and rounding may stand on the other side.
constexpr double kAside = 0.01 + 1e-6;
constexpr double kSecondsRounding = 1e-6;

/// Says whether the tool is over a place, well inside its rim, while its tip is well below it.
bool takes_off(const CutPiece& piece, const std::array<double, 3>& at, double reach) {
  const double dx = piece.to_x - piece.from_x, dy = piece.to_y - piece.from_y, dz = piece.to_z - piece.from_z;
  const double length = std::sqrt(dx * dx + dy * dy), x = at[0] - piece.from_x, y = at[1] - piece.from_y;
  const double sinks = at[2] - kAside - piece.from_z;
  if (!(length > 0))
    return std::sqrt(x * x + y * y) < reach && std::min(piece.from_z, piece.to_z) < at[2] - kAside;
  const double along = (x * dx + y * dy) / length, across = (x * dy - y * dx) / length;
  if (!(std::abs(across) < reach)) return false;
  const double half = std::sqrt(reach * reach - across * across);
  // The way on which the rim is about the place, and the tip at both of its ends.
  const double begin = std::max(0.0, along - half), end = std::min(length, along + half);
  return begin < end && std::min(begin * dz, end * dz) / length < sinks;
}

}  // namespace

std::string no_place_for(const CheckedMeasurement& m, const CutHistory& history, const CheckedStock& stock,
                         double diameter, double top) {
  if (!(m.seconds >= 0 && m.seconds <= history.seconds + kSecondsRounding))
    return "is outside of the program's time";
  const double inside =
      std::min({stock.inside(m.at[0], m.at[1]), top - m.at[2], m.at[2] - (top - stock.thickness)});
  if (!(inside >= -kAside)) return "is outside of the stock";
  for (const CutPiece& piece : history.pieces) {
    ask();
    if (piece.start > m.seconds - kSecondsRounding) break;
    if (takes_off(piece, m.at, diameter / 2 - kAside))
      return "is in the air, since the tool was there before";
  }
  return {};
}

CheckedRange supported_heat(const CheckedMeasurement& m, double ambient, double middle_work) {
  const auto [coolest, warmest] = std::minmax_element(m.rises.begin(), m.rises.end());
  const double low = m.celsius - m.uncertainty - ambient, high = m.celsius + m.uncertainty - ambient;
  return {std::max(0.0, low * middle_work / *warmest), high * middle_work / *coolest};
}

}  // namespace lekalo::verify
