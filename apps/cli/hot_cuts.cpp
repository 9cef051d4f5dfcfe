#include "hot_cuts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lekalo/mill/straight_pass.hpp"

namespace lekalo::cli {
namespace {

constexpr double kLeast = 0.2;  // mm
constexpr double kGap = 1;      // mm of less between two parts of one stretch
constexpr double kFull = 120;   // degrees: nearly all of the leading half
constexpr std::size_t kMostTold = 6;

double rounded(double mm) { return std::round(mm * 1000) / 1000; }

}  // namespace

nlohmann::ordered_json hot_cuts(const verify::SimulateReport& report, double step_over) {
  const double held = mill::most_held_degrees(step_over);
  using Json = nlohmann::ordered_json;
  struct Stretch {
    const verify::EngagementSample *first, *last;
    double length, largest;
  };
  std::vector<Stretch> stretches;
  double gap = kGap;
  for (const verify::EngagementSample& sample : report.samples) {
    if (sample.entry || !(sample.engagement > held)) {
      gap += sample.length;
      continue;
    }
    if (gap >= kGap) stretches.push_back({&sample, &sample, 0, 0});
    Stretch& stretch = stretches.back();
    stretch.last = &sample;
    stretch.length += sample.length;
    stretch.largest = std::max(stretch.largest, sample.engagement);
    gap = 0;
  }
  Json cuts = Json::array();
  for (const Stretch& stretch : stretches)
    if (stretch.length >= kLeast)
      cuts.push_back({{"from", {rounded(stretch.first->x), rounded(stretch.first->y)}},
                      {"to", {rounded(stretch.last->x), rounded(stretch.last->y)}},
                      {"z", rounded(stretch.last->z)},
                      {"length_mm", rounded(stretch.length)},
                      {"engagement_deg", rounded(stretch.largest)}});
  return cuts;
}

std::string hot_cut_notices(const nlohmann::ordered_json& cuts) {
  std::vector<const nlohmann::ordered_json*> hottest;
  for (const auto& cut : cuts) hottest.push_back(&cut);
  std::stable_sort(hottest.begin(), hottest.end(), [](const auto* a, const auto* b) {
    return (*a)["engagement_deg"].template get<double>() > (*b)["engagement_deg"].template get<double>();
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(hottest.size(), kMostTold); ++i) {
    const auto& cut = *hottest[i];
    const double degrees = cut["engagement_deg"].get<double>();
    text += fmt::format(
        "{}: {:.1f} mm of path from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) at Z {:g} are cut with up to {:.0f} "
        "degrees of the rim\n",
        degrees > kFull ? "Cut nearly full" : "Cut hot", cut["length_mm"].get<double>(),
        cut["from"][0].get<double>(), cut["from"][1].get<double>(), cut["to"][0].get<double>(),
        cut["to"][1].get<double>(), cut["z"].get<double>(), degrees);
  }
  if (hottest.size() > kMostTold)
    text += fmt::format("and {} more (--json has all)\n", hottest.size() - kMostTold);
  return text;
}

}  // namespace lekalo::cli
