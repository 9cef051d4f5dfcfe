#include "hot_cuts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lekalo/mill/straight_pass.hpp"

namespace lekalo::cli {
namespace {

constexpr double kLasting = 0.2;  // mm, as the checker has it for its largest engagement
constexpr double kFull = 120;     // degrees: nearly all of the leading half
constexpr std::size_t kMostTold = 4;

double rounded(double mm) { return std::round(mm * 1000) / 1000; }

/// A line for each of the hottest.
template <class Line>
std::string notices(const nlohmann::ordered_json& cuts, const Line& line) {
  std::vector<const nlohmann::ordered_json*> hottest;
  for (const auto& cut : cuts) hottest.push_back(&cut);
  std::stable_sort(hottest.begin(), hottest.end(), [](const auto* a, const auto* b) {
    return (*a)["engagement_deg"].template get<double>() > (*b)["engagement_deg"].template get<double>();
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(hottest.size(), kMostTold); ++i) {
    const auto& cut = *hottest[i];
    const auto number = [](const nlohmann::ordered_json& value) { return value.get<double>(); };
    text += line(fmt::format("{:.1f} mm of path from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) at Z {:g}",
                             number(cut["length_mm"]), number(cut["from"][0]), number(cut["from"][1]),
                             number(cut["to"][0]), number(cut["to"][1]), number(cut["z"])),
                 number(cut["engagement_deg"]));
  }
  if (hottest.size() > kMostTold)
    text += fmt::format("and {} more (--json has all)\n", hottest.size() - kMostTold);
  return text;
}

}  // namespace

nlohmann::ordered_json hot_cuts(const verify::SimulateReport& report, double step_over) {
  const double held = mill::most_held_degrees(step_over);
  using Json = nlohmann::ordered_json;
  struct Stretch {
    const verify::EngagementSample *first, *last;
    double length, largest;
  };
  std::vector<Stretch> stretches;
  bool goes_on = false;
  for (const verify::EngagementSample& sample : report.samples) {
    const bool hot = !sample.entry && sample.engagement > held;
    if (hot && !goes_on) stretches.push_back({&sample, &sample, 0, 0});
    goes_on = hot;
    if (!hot) continue;
    Stretch& stretch = stretches.back();
    stretch.last = &sample;
    stretch.length += sample.length;
    stretch.largest = std::max(stretch.largest, sample.engagement);
  }
  Json cuts = Json::array();
  for (const Stretch& stretch : stretches)
    if (stretch.length >= kLasting - 1e-9)
      cuts.push_back({{"from", {rounded(stretch.first->x), rounded(stretch.first->y)}},
                      {"to", {rounded(stretch.last->x), rounded(stretch.last->y)}},
                      {"z", rounded(stretch.last->z)},
                      {"length_mm", rounded(stretch.length)},
                      {"engagement_deg", rounded(stretch.largest)}});
  return cuts;
}

nlohmann::ordered_json ramps(const std::vector<mill::Ramp>& ramps) {
  nlohmann::ordered_json cuts = nlohmann::ordered_json::array();
  for (const mill::Ramp& ramp : ramps)
    cuts.push_back({{"from", {rounded(ramp.from.x), rounded(ramp.from.y)}},
                    {"to", {rounded(ramp.to.x), rounded(ramp.to.y)}},
                    {"z", rounded(ramp.z)},
                    {"length_mm", rounded(ramp.length)},
                    {"engagement_deg", rounded(ramp.engagement_deg)}});
  return cuts;
}

std::string hot_cut_notices(const nlohmann::ordered_json& cuts) {
  return notices(cuts, [](const std::string& where, double degrees) {
    return fmt::format("{}: {} are cut with up to {:.0f} degrees of the rim\n",
                       degrees > kFull ? "Cut nearly full" : "Cut hot", where, degrees);
  });
}

std::string ramp_notices(const nlohmann::ordered_json& ramps) {
  return notices(ramps, [](const std::string& where, double degrees) {
    return fmt::format("Cut in ramps: {}, where {:.0f} degrees of the rim would be met at once\n", where,
                       degrees);
  });
}

}  // namespace lekalo::cli
