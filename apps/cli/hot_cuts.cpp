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

nlohmann::ordered_json stretch(double from_x, double from_y, double to_x, double to_y, double z,
                               double length, double degrees) {
  return {{"from", {rounded(from_x), rounded(from_y)}},
          {"to", {rounded(to_x), rounded(to_y)}},
          {"z", rounded(z)},
          {"length_mm", rounded(length)},
          {"engagement_deg", rounded(degrees)}};
}

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
    Stretch& last = stretches.back();
    last.last = &sample;
    last.length += sample.length;
    last.largest = std::max(last.largest, sample.engagement);
  }
  Json cuts = Json::array();
  for (const Stretch& s : stretches)
    if (s.length >= kLasting - 1e-9)
      cuts.push_back(stretch(s.first->x, s.first->y, s.last->x, s.last->y, s.last->z, s.length, s.largest));
  return cuts;
}

nlohmann::ordered_json ramps(const std::vector<mill::Ramp>& ramps) {
  nlohmann::ordered_json cuts = nlohmann::ordered_json::array();
  for (const mill::Ramp& r : ramps)
    cuts.push_back(stretch(r.from.x, r.from.y, r.to.x, r.to.y, r.z, r.length, r.engagement_deg));
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
