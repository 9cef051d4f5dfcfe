#include "lekalo/fit/corrected.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lekalo::fit {
namespace {

constexpr double kResolution = 1e-4;  // mm, of a turned diameter and of its place
constexpr double kMostLeft = 0.001, kPartLeft = 0.05;

/// The growths of a surface; the seat ends with the hub.
std::vector<Growth> growths(const Pressed& pressed, Surface surface) {
  if (surface == Surface::outside) return pressed.rings.back().outer;
  if (surface == Surface::bore) return pressed.rings.front().inner;
  const std::vector<Growth>& hub = pressed.rings[1].inner;
  std::vector<Growth> seat;
  for (const Growth& g : pressed.rings.front().outer)
    if (g.z >= hub.front().z && g.z <= hub.back().z) seat.push_back(g);
  return seat;
}

/// The mean of what is there, by the parabolas of the elements.
double mean_of(const std::vector<Growth>& surface) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < surface.size(); i += 2)
    sum += (surface[i + 2].z - surface[i].z) / 6 *
           (surface[i].diameter + 4 * surface[i + 1].diameter + surface[i + 2].diameter);
  return sum / (surface.back().z - surface.front().z);
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

/// By how much growths differ.
double variation(const std::vector<Growth>& surface) {
  const auto [least, most] =
      std::minmax_element(surface.begin(), surface.end(),
                          [](const Growth& a, const Growth& b) { return a.diameter < b.diameter; });
  return most->diameter - least->diameter;
}

/// The variation of diameters that grow.
double variation(const std::vector<TurnedPoint>& before, const std::vector<double>& growths) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double diameter = before[i].diameter + growths[i];
    least = std::min(least, diameter), most = std::max(most, diameter);
  }
  return most - least;
}

/// Diameters by which the seat changes, so that the hub's bore stays a cylinder: docs/design/fit.md, step 12.
Result<std::vector<Growth>> seat_changes(const Assembly& assembly, std::vector<double> interference,
                                         const Pressed& pressed) {
  const double shaft_over = interference[0];
  interference[0] = mean_of(pressed.rings[1].inner);
  LEKALO_TRY(const Pressed held, Pressing(assembly, {}, {}, FirstSeat::cylinder).press(interference));
  std::vector<Growth> changes = growths(held, Surface::seat);
  for (Growth& g : changes) g.diameter = interference[0] - shaft_over - g.diameter;
  return changes;
}

tl::unexpected<Error> with_profile(const Error& error) {
  return failure(error.code, "pressed again with the turned profile: " + error.message);
}

}  // namespace

std::string_view name_of(Surface surface) noexcept {
  switch (surface) {
    case Surface::outside:
      return "outside";
    case Surface::bore:
      return "bore";
    case Surface::seat:
      return "seat";
  }
  return "";
}

Result<Corrected> corrected(const Assembly& assembly, const std::vector<std::vector<double>>& interferences,
                            const std::vector<Pressed>& pressed, std::size_t at, Surface surface,
                            double seat_diameter) {
  if (surface == Surface::bore && assembly.rings.front().inner_diameter == 0)
    return failure(ErrorCode::bad_input,
                   "the shaft has no bore that could be made cylindrical; give --bore, or choose the "
                   "outside");
  Corrected made;
  made.surface = surface;
  const Ring& part = surface == Surface::outside ? assembly.rings.back() : assembly.rings.front();
  made.nominal = surface == Surface::outside ? part.outer_diameter
                 : surface == Surface::bore  ? part.inner_diameter
                                             : seat_diameter;
  made.face = part.middle + part.length / 2;
  std::vector<Growth> changes = growths(pressed[at], surface);
  if (surface == Surface::seat) {
    LEKALO_TRY(changes, seat_changes(assembly, interferences[at], pressed[at]));
  } else {
    for (Growth& g : changes) g.diameter = -g.diameter;
  }
  std::vector<std::size_t> nodes;  // of each point
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const TurnedPoint point{rounded(changes[i].z), rounded(made.nominal + changes[i].diameter)};
    if (!made.profile.empty() && !(point.z > made.profile.back().z)) continue;
    made.profile.push_back(point);
    nodes.push_back(i);
  }
  const auto growths_of = [&](const Pressed& one) {
    const std::vector<Growth> surface_of = growths(one, surface);
    std::vector<double> of;
    for (const std::size_t i : nodes) of.push_back(surface_of[i].diameter);
    return of;
  };
  const int ring = surface == Surface::outside ? static_cast<int>(assembly.rings.size()) - 1 : 0;
  const auto turned = [&](double z) { return diameter_at(made.profile, z); };
  Pressing again(
      assembly, {},
      {{ring, surface != Surface::bore, [&](double z) { return (turned(z) - made.nominal) / 2; }}});
  for (std::size_t i = 0; i < interferences.size(); ++i) {
    Result<Pressed> one = again.press(interferences[i]);
    if (!one) return with_profile(one.error());
    const std::vector<double> after = growths_of(*one);
    made.variations.push_back({variation(growths(pressed[i], surface)), variation(made.profile, after)});
    if (i == at) made.growths = after;
    made.pressed.push_back(*std::move(one));
  }
  const Variation& left = made.variations[at];
  if (!(left.after <= std::max(kMostLeft, kPartLeft * left.before)))
    return failure(
        ErrorCode::bad_input,
        fmt::format("pressed again with the turned profile the surface still varies by {:.3g} um of {:.3g}, "
                    "so that no profile is written; choose a smaller interference, a thicker wall, or "
                    "another surface",
                    1000 * left.after, 1000 * left.before));
  return made;
}

}  // namespace lekalo::fit
