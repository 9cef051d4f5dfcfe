#include "simulate_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "lekalo/draw/pocket_picture.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The pocket less all that discs of this radius in it cover.
std::vector<geom::Region> out_of_reach(const std::vector<geom::Region>& pockets, double radius,
                                       double stock) {
  const auto allowed = geom::offset(pockets, -(radius + stock));
  if (!allowed) return {};
  const auto reached = geom::offset(allowed->regions, radius + stock);
  if (!reached) return {};
  const auto left = geom::combine(pockets, reached->regions, geom::BooleanOperation::subtract,
                                  reached->edge_error + allowed->edge_error + 1e-6);
  return left ? left->regions : std::vector<geom::Region>{};
}

draw::PocketPicture picture_of(const std::string& title, const std::vector<geom::Region>& pockets,
                               double diameter, double stock, const verify::SimulateReport& r) {
  draw::PocketPicture picture;
  picture.name = io::as_utf8(std::filesystem::path(title).filename().string());
  picture.pockets = pockets;
  picture.unreachable = out_of_reach(pockets, diameter / 2, stock);
  // The drawing alone does not say that a corner lies at an open edge; the checker does.
  std::erase_if(picture.unreachable, [&](const geom::Region& piece) {
    const geom::RegionIndex index({piece});
    return std::none_of(r.unreachable.begin(), r.unreachable.end(), [&](const verify::UnreachableSpot& spot) {
      return index.contains({spot.x, spot.y});
    });
  });
  picture.tool_diameter = diameter;
  geom::Point before;
  for (const verify::EngagementSample& s : r.samples) {
    const geom::Point to{s.x, s.y};
    const bool on = !picture.path.empty() && geom::norm(to - before) <= 1.001 * s.length + 1e-6;
    picture.path.push_back({on ? before : to, to, s.engagement, s.entry});
    before = to;
  }
  for (const verify::UncutSpot& spot : r.uncut) picture.uncut.push_back({spot.x, spot.y});
  const auto figure = [&](const char* name, const std::string& value) {
    picture.figures.emplace_back(name, value);
  };
  figure("cut of the reachable", fmt::format("{:.4f} %", r.coverage_percent));
  figure("widest uncut spot", fmt::format("{:.3f} mm", r.uncut_width_mm));
  figure("gouge", fmt::format("{:.4f} mm", r.gouge_mm));
  figure("engagement, largest", fmt::format("{:.1f}°", r.engagement_max_deg));
  figure("engagement, 95 %", fmt::format("{:.1f}°", r.engagement_p95_deg));
  figure("through air", fmt::format("{:.1f} %", r.air_percent));
  figure("path", fmt::format("{:.0f} mm", r.length_mm));
  figure("retracts", fmt::format("{}", r.retracts));
  figure("time", fmt::format("{:.0f} s", r.seconds));
  return picture;
}

}  // namespace

Json report_fields(const verify::SimulateReport& r) {
  Json unreachable = Json::array(), uncut = Json::array();
  for (const verify::UnreachableSpot& spot : r.unreachable)
    unreachable.push_back(
        {{"x", spot.x}, {"y", spot.y}, {"distance_mm", spot.distance_mm}, {"area_mm2", spot.area_mm2}});
  for (const verify::UncutSpot& spot : r.uncut)
    uncut.push_back({{"x", spot.x}, {"y", spot.y}, {"width_mm", spot.width_mm}});
  return {{"coverage_percent", r.coverage_percent},
          {"coverage_low_percent", r.coverage_low_percent},
          {"uncut_width_mm", r.uncut_width_mm},
          {"gouge_mm", r.gouge_mm},
          {"engagement_max_deg", r.engagement_max_deg},
          {"engagement_peak_deg", r.engagement_peak_deg},
          {"engagement_p95_deg", r.engagement_p95_deg},
          {"air_percent", r.air_percent},
          {"entry_mm", r.entry_mm},
          {"entry_layer_mm", r.entry_layer_mm},
          {"rapid_cut_mm", r.rapid_cut_mm},
          {"length_mm", r.length_mm},
          {"turning_rad", r.turning_rad},
          {"retracts", r.retracts},
          {"seconds", r.seconds},
          {"lower_bound_seconds", r.lower_bound_seconds},
          {"reachable_mm2", r.reachable_mm2},
          {"uncut_mm2", r.uncut_mm2},
          {"left_before_mm2", r.left_before_mm2},
          {"uncut", std::move(uncut)},
          {"unreachable", std::move(unreachable)}};
}

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
  constexpr double kTold = 0.02;  // mm, as of uncut spots
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

Result<void> add_cut_pictures(const CutPictures& names, const std::string& title,
                              const std::vector<geom::Region>& pockets, double tool_diameter,
                              double stock_to_leave, const verify::SimulateReport& report,
                              disk::AtomicFiles& files) {
  if (names.picture.empty() && names.animation.empty()) return {};
  draw::PocketPicture picture = picture_of(title, pockets, tool_diameter, stock_to_leave, report);
  picture.fragments = names.fragments;
  if (!names.picture.empty()) {
    const Result<std::string> bytes = names.picture.ends_with(".png")
                                          ? draw::pocket_png(picture)
                                          : Result<std::string>(draw::pocket_svg(picture));
    if (!bytes) return tl::unexpected(bytes.error());
    if (Result<void> added = files.add(names.picture, *bytes); !added) return added;
  }
  if (!names.animation.empty()) return files.add(names.animation, draw::pocket_animation(picture));
  return {};
}

}  // namespace lekalo::cli
