#include "full_cuts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lekalo::cli {
namespace {

constexpr double kDegrees = 120;
constexpr double kLeast = 0.5;  // mm
constexpr double kGap = 1;      // mm of less between two parts of one stretch

double rounded(double mm) { return std::round(mm * 1000) / 1000; }

}  // namespace

nlohmann::ordered_json full_cuts(const verify::SimulateReport& report) {
  using Json = nlohmann::ordered_json;
  struct Stretch {
    const verify::EngagementSample *first, *last;
    double length, largest;
  };
  std::vector<Stretch> stretches;
  double gap = kGap;
  for (const verify::EngagementSample& sample : report.samples) {
    if (sample.entry || !(sample.engagement > kDegrees)) {
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

std::string full_cut_notices(const nlohmann::ordered_json& cuts) {
  std::string text;
  for (const auto& cut : cuts)
    text += fmt::format(
        "Cut nearly full: {:.1f} mm of path from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) "
        "at Z {:g} are cut with up to {:.0f} degrees of the rim\n",
        cut["length_mm"].get<double>(), cut["from"][0].get<double>(), cut["from"][1].get<double>(),
        cut["to"][0].get<double>(), cut["to"][1].get<double>(), cut["z"].get<double>(),
        cut["engagement_deg"].get<double>());
  return text;
}

}  // namespace lekalo::cli
