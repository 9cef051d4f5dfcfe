#include "heat_path.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "heat_beside.hpp"
#include "heat_walls.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::jobs {
namespace {

/// The tool is beside a place, and not at a corner of its way, where it stands across the wall within this.
constexpr double kSlope = 0.01;
/// Decimals of programs and chords of arcs are no other path, um.
constexpr double kOther = 1.5;

}  // namespace

std::optional<std::string> path_off_walls(const HeatJob& job, const HeatFound& found) {
  const double reach = job.source.machining.tool_diameter / 2 + job.source.machining.stock_to_leave;
  const auto& moved_um = found.middle().moved_um;
  std::vector<double> path, drawn;
  for (std::size_t i = 0; i < found.walls.size(); ++i) {
    const WallPoint& wall = found.walls[i];
    double farthest = -std::numeric_limits<double>::infinity(), error = farthest;
    for (std::size_t v = 0; v < found.visits[i].size(); ++v) {
      ask();
      const BesideWall at = beside(found.source, wall, found.visits[i][v]);
      const double slope = at.towards[0] * wall.outward[1] - at.towards[1] * wall.outward[0];
      if (!(std::abs(slope) < kSlope)) continue;
      const double off = 1000 * (reach - at.distance);
      farthest = std::max(farthest, off);
      error = std::max(error, off - moved_um[i][v][0] * at.towards[0] - moved_um[i][v][1] * at.towards[1]);
    }
    if (std::isfinite(farthest)) path.push_back(farthest), drawn.push_back(error);
  }
  const WallErrors own = summary_of(path), all = summary_of(drawn);
  if (!(own.largest() > kOther)) return std::nullopt;
  return fmt::format(
      "the program's path leaves walls {:+.2f} to {:+.2f} um off their places in {} in a cold workpiece, as "
      "one does that was corrected or has coarse chords; the errors said here are those of heat and count "
      "from there: from the walls as they are drawn they are {:+.2f} to {:+.2f} um at the middles",
      own.least, own.most, job.source.pocket.name, all.least, all.most);
}

}  // namespace lekalo::jobs
