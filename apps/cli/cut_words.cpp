#include "cut_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace lekalo::cli {
namespace {

constexpr double kNearlyFull = 120;  // degrees: most of the leading half of the rim
constexpr std::size_t kMostTold = 4;

template <class Line>
std::string notices(std::vector<jobs::ReportedStretch> stretches, const Line& line) {
  std::stable_sort(stretches.begin(), stretches.end(),
                   [](const auto& a, const auto& b) { return a.engagement_deg > b.engagement_deg; });
  std::string text;
  for (std::size_t i = 0; i < std::min(stretches.size(), kMostTold); ++i) {
    const jobs::ReportedStretch& s = stretches[i];
    text += line(fmt::format("{:.1f} mm of path from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) at Z {:g}",
                             s.length_mm, s.from.x, s.from.y, s.to.x, s.to.y, s.z),
                 s.engagement_deg);
  }
  if (stretches.size() > kMostTold)
    text += fmt::format("and {} more (--json has all)\n", stretches.size() - kMostTold);
  return text;
}

}  // namespace

std::string report_rows(const verify::SimulateReport& r) {
  std::string text;
  const auto row = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<21}{}\n", name, value);
  };
  row("coverage", fmt::format("{:.4f} % of what the tool can reach (surely {:.4f} %)", r.coverage_percent,
                              r.coverage_low_percent));
  if (r.left_before_mm2 != r.reachable_mm2)
    row("left before", fmt::format("{:.2f} mm2, {:.1f} % of what the tool can reach", r.left_before_mm2,
                                   100 * r.left_before_mm2 / r.reachable_mm2));
  row("largest uncut spot", fmt::format("at most {:.3f} mm wide", r.uncut_width_mm));
  for (std::size_t i = 0; i < std::min<std::size_t>(r.uncut.size(), 5); ++i)
    row("not cut",
        fmt::format("{:.3f} mm wide at ({:.2f}, {:.2f})", r.uncut[i].width_mm, r.uncut[i].x, r.uncut[i].y));
  row("gouge", fmt::format("{:.4f} mm", r.gouge_mm));
  row("engagement",
      fmt::format("at most {:.1f} degrees, 95 % of what cuts below {:.1f}, outside {:.1f} mm of entry in "
                  "layers of at most {:.2f} mm",
                  r.engagement_max_deg, r.engagement_p95_deg, r.entry_mm, r.entry_layer_mm));
  row("air", fmt::format("{:.1f} % of {:.1f} mm of path", r.air_percent, r.length_mm));
  row("retracts", fmt::format("{}", r.retracts));
  row("turning", fmt::format("{:.1f} rad", r.turning_rad));
  row("time", fmt::format("{:.1f} s; no path of this step-over takes less than {:.1f} s", r.seconds,
                          r.lower_bound_seconds));
  if (r.rapid_cut_mm > 0) row("rapids in material", fmt::format("{:.2f} mm", r.rapid_cut_mm));
  constexpr double kTold = 0.02;  // mm: uncut spots are told from this width on, too
  std::size_t others = 0;
  double farthest = 0;
  for (const verify::UnreachableSpot& spot : r.unreachable) {
    if (spot.distance_mm > kTold) {
      row("out of reach",
          fmt::format("{:.2f} mm2 about ({:.2f}, {:.2f}), up to {:.2f} mm from what can be cut",
                      spot.area_mm2, spot.x, spot.y, spot.distance_mm));
    } else {
      ++others;
      farthest = std::max(farthest, spot.distance_mm);
    }
  }
  if (others > 0)
    row("out of reach",
        fmt::format("smaller spots: {}, up to {:.3f} mm from what can be cut", others, farthest));
  return text;
}

std::string hot_cut_notices(std::vector<jobs::ReportedStretch> cuts) {
  return notices(std::move(cuts), [](const std::string& where, double degrees) {
    return fmt::format("{}: {} are cut with up to {:.0f} degrees of the rim\n",
                       degrees > kNearlyFull ? "Cut nearly full" : "Cut hot", where, degrees);
  });
}

std::string ramp_notices(std::vector<jobs::ReportedStretch> ramps) {
  return notices(std::move(ramps), [](const std::string& where, double degrees) {
    return fmt::format("Cut in ramps: {}, where {:.0f} degrees of the rim would be met at once\n", where,
                       degrees);
  });
}

}  // namespace lekalo::cli
