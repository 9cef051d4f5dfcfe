#include "lekalo/fit/corrected.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lekalo::fit {
namespace {

constexpr double kResolution = 1e-4;  // mm, of a turned diameter and of its place
constexpr double kMostLeft = 0.001, kPartLeft = 0.05;

const std::vector<Growth>& growths(const Pressed& pressed, Surface surface) {
  return surface == Surface::outside ? pressed.rings.back().outer : pressed.rings.front().inner;
}

double rounded(double value) { return std::round(value / kResolution) * kResolution; }

/// The turned diameter at a place, straight between the points.
double diameter_at(const std::vector<TurnedPoint>& profile, double z) {
  const auto next =
      std::find_if(profile.begin(), profile.end(), [&](const TurnedPoint& p) { return p.z >= z; });
  if (next == profile.begin()) return profile.front().diameter;
  if (next == profile.end()) return profile.back().diameter;
  const TurnedPoint& last = *std::prev(next);
  return last.diameter + (z - last.z) / (next->z - last.z) * (next->diameter - last.diameter);
}

/// The variation of what is turned at each place and grows from there.
template <class Turned>
double variation(const std::vector<Growth>& surface, Turned turned) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const Growth& g : surface) {
    const double diameter = turned(g.z) + g.diameter;
    least = std::min(least, diameter), most = std::max(most, diameter);
  }
  return most - least;
}

}  // namespace

Result<Corrected> corrected(const Assembly& assembly, const std::vector<std::vector<double>>& interferences,
                            const std::vector<Pressed>& pressed, std::size_t at, Surface surface) {
  if (surface == Surface::bore && assembly.rings.front().inner_diameter == 0)
    return failure(ErrorCode::bad_input,
                   "the shaft has no bore that could be made cylindrical; give --bore, or choose the "
                   "outside");
  Corrected made;
  made.surface = surface;
  made.nominal = surface == Surface::outside ? assembly.rings.back().outer_diameter
                                             : assembly.rings.front().inner_diameter;
  for (const Growth& g : growths(pressed[at], surface)) {
    const TurnedPoint point{rounded(g.z), rounded(made.nominal - g.diameter)};
    if (made.profile.empty() || point.z > made.profile.back().z) made.profile.push_back(point);
  }
  const int ring = surface == Surface::outside ? static_cast<int>(assembly.rings.size()) - 1 : 0;
  const auto turned = [&](double z) { return diameter_at(made.profile, z); };
  Pressing again(
      assembly, {},
      {{ring, surface == Surface::outside, [&](double z) { return (turned(z) - made.nominal) / 2; }}});
  for (std::size_t i = 0; i < interferences.size(); ++i) {
    LEKALO_TRY(Pressed one, again.press(interferences[i]));
    made.variations.push_back({variation(growths(pressed[i], surface), [&](double) { return made.nominal; }),
                               variation(growths(one, surface), turned)});
    made.pressed.push_back(std::move(one));
  }
  const Variation& left = made.variations[at];
  if (!(left.after <= std::max(kMostLeft, kPartLeft * left.before)))
    return failure(
        ErrorCode::bad_input,
        fmt::format(
            "pressed again with the turned profile the surface still varies by {:.3g} um of {:.3g}; no "
            "profile is written",
            1000 * left.after, 1000 * left.before));
  return made;
}

}  // namespace lekalo::fit
