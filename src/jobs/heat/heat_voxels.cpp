#include "heat_voxels.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "heat_border.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/shape/region_json.hpp"

namespace lekalo::jobs {
namespace {

/// With so many voxels across it a plate bends within 7 % of what it should, and with half as many it is four
/// times as much (docs/design/heat.md).
constexpr double kAcross = 4;
/// A size is a whole number of voxels in spite of rounding.
constexpr double kRounding = 1e-9;

struct Thickness {
  const char* what;
  double mm;
};

tl::unexpected<Error> refused(const HeatJob& job, const Thickness& of) {
  return failure(
      ErrorCode::bad_input,
      fmt::format("voxels of {:g} mm are larger than {} of {:.3g} mm; --voxel {:.2g} has {:g} across it",
                  job.pitch, of.what, of.mm, of.mm / kAcross, kAcross));
}

/// The way from a wall out through the material, up to a limit.
double behind_wall(const StockBorder& border, const WallPoint& wall, double most) {
  // Steps to the border, which none of them passes.
  constexpr int kSteps = 64;
  constexpr double kAtBorder = 1e-6;
  double way = 0;
  for (int n = 0; n < kSteps && way < most; ++n) {
    const double free = border.inside(wall.x + way * wall.outward[0], wall.y + way * wall.outward[1]);
    if (!(free > kAtBorder)) break;
    way += free;
  }
  return way;
}

}  // namespace

Result<void> check_voxels(const HeatJob& job, const HeatSource& source) {
  const heat::StockBox& box = source.stock.box;
  for (const Thickness& side :
       {Thickness{"the thickness of the stock", box.thickness},
        {"a side of the stock", std::min(box.high_x - box.low_x, box.high_y - box.low_y)}})
    if (job.pitch > side.mm * (1 + kRounding)) return refused(job, side);
  std::vector<geom::Edge> open;
  LEKALO_TRY(const io::RegionFile pocket,
             io::parse_regions(job.source.pocket.bytes, job.source.pocket.name, {}, &open));
  for (const geom::Region& region : pocket.regions) {
    const geom::Box extent = geom::bounds(region.outer);
    const double side = std::min(extent.high.x - extent.low.x, extent.high.y - extent.low.y);
    if (job.pitch > side * (1 + kRounding)) return refused(job, {"a side of the pocket", side});
  }
  return {};
}

std::optional<std::string> thin_voxels(const HeatJob& job, const HeatFound& found) {
  const heat::StockBox& box = found.source.stock.box;
  const double most = kAcross * job.pitch * (1 - kRounding);
  std::vector<Thickness> all{{"the stock", box.thickness}};
  double deepest = job.source.machining.top;
  for (const heat::ToolPiece& piece : found.source.pieces)
    if (piece.line > 0) deepest = std::min({deepest, piece.from[2], piece.to[2]});
  // A program that cuts through leaves no floor.
  if (const double floor = box.thickness - (job.source.machining.top - deepest); floor > kRounding)
    all.push_back({"the floor under the deepest cut", floor});
  const StockBorder border(found.source.stock);
  double behind = std::numeric_limits<double>::infinity();
  for (const WallPoint& wall : found.walls) {
    ask();
    behind = std::min(behind, behind_wall(border, wall, most));
  }
  all.push_back({"what stands behind a wall", behind});
  const Thickness thinnest = *std::ranges::min_element(all, {}, &Thickness::mm);
  if (!(thinnest.mm < most)) return std::nullopt;
  const double wanted = thinnest.mm / kAcross;
  const double voxels =
      (box.high_x - box.low_x) * (box.high_y - box.low_y) * box.thickness / std::pow(wanted, 3);
  return fmt::format(
      "{} is {:.3g} mm thick, {:.2g} voxels of {:g} mm: with fewer than {:g} across it what it bends by, and "
      "the stress in it, may be a quarter off; {}",
      thinnest.what, thinnest.mm, thinnest.mm / job.pitch, job.pitch, kAcross,
      voxels <= static_cast<double>(heat::kMostVoxels)
          ? fmt::format("--voxel {:.2g} has them", wanted)
          : fmt::format("so small ones would be more than {} in this stock", heat::kMostVoxels));
}

}  // namespace lekalo::jobs
