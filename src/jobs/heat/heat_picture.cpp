#include "heat_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "lekalo/draw/heat_picture.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::jobs {
namespace {

std::string range(const char* form, const heat::Interval& value) {
  return fmt::format(fmt::runtime(form), value.least, value.greatest);
}

}  // namespace

std::vector<draw::HeatColumn> heat_columns(const std::vector<WallPoint>& walls,
                                           const std::vector<double>& errors_um) {
  std::vector<draw::HeatColumn> columns;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const WallPoint& w = walls[i];
    const geom::Point at{w.x, w.y}, outward{w.outward[0], w.outward[1]};
    if (columns.empty() || columns.back().at != at) columns.push_back({at, outward, {}, {}});
    columns.back().z.push_back(w.z), columns.back().errors_um.push_back(errors_um[i]);
  }
  return columns;
}

double height_of(const std::vector<draw::HeatColumn>& columns, double pitch) {
  for (const draw::HeatColumn& column : columns)
    if (column.z.size() > 1) return column.z[0] - column.z[1];
  return pitch;
}

Result<std::string> drawn_heat(const HeatResultJob& job, const HeatFound& found) {
  if (!job.picture) return std::string();
  if (job.picture == PictureForm::pdf) return failure(ErrorCode::usage, "heat is drawn as SVG or PNG");
  const HeatSourceJob& source = job.heat.source;
  std::vector<geom::Edge> open;
  LEKALO_TRY(const io::RegionFile pocket,
             io::parse_regions(source.pocket.bytes, source.pocket.name, {}, &open));
  draw::HeatPicture picture;
  picture.name = io::as_utf8(source.program.name.substr(source.program.name.find_last_of('/') + 1));
  const heat::StockBox& box = found.source.stock.box;
  picture.stock = {{box.low_x, box.low_y}, {box.high_x, box.high_y}};
  if (const auto& read = found.source.stock.read) picture.outline = read->outline.regions;
  picture.pockets = pocket.regions;
  picture.columns = heat_columns(found.walls, found.middle().errors_um);
  picture.spacing = job.heat.pitch, picture.height = height_of(picture.columns, job.heat.pitch);
  picture.tool_diameter = source.machining.tool_diameter;
  picture.largest_um = std::max(found.errors.largest(), 1e-3);
  picture.title = {fmt::format("Walls lie {:+.1f} to {:+.1f} um off when the workpiece is cold",
                               found.errors.least, found.errors.most),
                   fmt::format("at the middles of all intervals; the largest error is {}",
                               range("{:.1f} to {:.1f} um", found.largest_um))};
  const heat::CuttingWork& work = found.source.work;
  picture.figures = {{"material", job.heat.material.name},
                     {"tool", fmt::format("{:g} mm", source.machining.tool_diameter)},
                     {"time", fmt::format("{:.0f} s", work.seconds)},
                     {"cut", fmt::format("{:.4g} cm3", work.volume_mm3 / 1000)},
                     {"work", range("{:.0f} to {:.0f} J", work.work_j)},
                     {"into the workpiece", range("{:.0f} to {:.0f} J", work.into_workpiece_j)},
                     {"warmest, above ambient", range("{:.3g} to {:.3g} K", found.warmest_k)},
                     {"largest error", range("{:.2f} to {:.2f} um", found.largest_um)},
                     {"best scaling", fmt::format("{:.6f}", found.scaling.factor)},
                     {"which leaves", range("{:.2f} to {:.2f} um", found.scaled_over.largest)}};
  if (job.picture == PictureForm::png) return draw::heat_png(picture);
  return draw::heat_svg(picture);
}

}  // namespace lekalo::jobs
