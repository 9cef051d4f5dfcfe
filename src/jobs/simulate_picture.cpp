#include "simulate_picture.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::jobs {
namespace {

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

/// The samples as stretches, each from the place before, unless the tool was lifted between them.
std::vector<draw::PocketStretch> stretches_of(const std::vector<verify::EngagementSample>& samples) {
  std::vector<draw::PocketStretch> path;
  geom::Point before;
  for (const verify::EngagementSample& s : samples) {
    const geom::Point to{s.x, s.y};
    const bool on = !path.empty() && geom::norm(to - before) <= 1.001 * s.length + 1e-6;
    path.push_back({on ? before : to, to, s.engagement, s.entry});
    before = to;
  }
  return path;
}

std::vector<std::pair<std::string, std::string>> figures_of(const verify::SimulateReport& r) {
  return {{"cut of the reachable", fmt::format("{:.4f} %", r.coverage_percent)},
          {"widest uncut spot", fmt::format("{:.3f} mm", r.uncut_width_mm)},
          {"gouge", fmt::format("{:.4f} mm", r.gouge_mm)},
          {"engagement, largest", fmt::format("{:.1f}°", r.engagement_max_deg)},
          {"engagement, 95 %", fmt::format("{:.1f}°", r.engagement_p95_deg)},
          {"through air", fmt::format("{:.1f} %", r.air_percent)},
          {"path", fmt::format("{:.0f} mm", r.length_mm)},
          {"retracts", fmt::format("{}", r.retracts)},
          {"time", fmt::format("{:.0f} s", r.seconds)}};
}

}  // namespace

draw::PocketPicture cut_picture_of(const std::string& pocket_path, const std::vector<geom::Region>& pockets,
                                   double tool_diameter, double stock_to_leave,
                                   const verify::SimulateReport& report) {
  draw::PocketPicture picture;
  picture.name = io::as_utf8(pocket_path.substr(pocket_path.find_last_of('/') + 1));
  picture.pockets = pockets;
  picture.unreachable = out_of_reach(pockets, tool_diameter / 2, stock_to_leave);
  // The drawing alone does not say that a corner lies at an open edge; the checker does.
  std::erase_if(picture.unreachable, [&](const geom::Region& piece) {
    const geom::RegionIndex index({piece});
    return std::none_of(report.unreachable.begin(), report.unreachable.end(),
                        [&](const verify::UnreachableSpot& spot) {
                          return index.contains({spot.x, spot.y});
                        });
  });
  picture.tool_diameter = tool_diameter;
  picture.path = stretches_of(report.samples);
  for (const verify::UncutSpot& spot : report.uncut) picture.uncut.push_back({spot.x, spot.y});
  picture.figures = figures_of(report);
  return picture;
}

Result<std::string> drawn(const draw::PocketPicture& picture, std::optional<PictureForm> form) {
  if (form == PictureForm::pdf)
    return failure(ErrorCode::usage, "what a program cuts is drawn as SVG or PNG");
  if (form == PictureForm::png) return draw::pocket_png(picture);
  return form ? draw::pocket_svg(picture) : "";
}

}  // namespace lekalo::jobs
