#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "heat_beside.hpp"

namespace lekalo::jobs {

/// The tool passes a place of the wall, as seen from above: one visit of all the heights that it reaches.
struct WallPass {
  BesideWall at;           ///< beside the lowest of them
  double seconds = 0;      ///< when
  double nearest = 0;      ///< how near any pass comes to that place, mm
  double stock = 0;        ///< what it takes off the wall, mm
  bool across = false;     ///< the wall is across the tool's way there: no corner of the way
  bool on_wall = false;    ///< it comes as near as any pass does, and is none that leaves stock
  bool finishing = false;  ///< and takes little
  struct Height {
    std::size_t place = 0, visit = 0;  ///< in HeatFound::walls and ::visits
  };
  std::vector<Height> heights;
  /// How far the workpiece is displaced there at the middles, in the mean of its heights, um.
  std::array<double, 2> displaced{};
  double moved = 0;  ///< how far the pass is to be moved towards the wall, um
};

/// All passes of one place of the outline, in the order of time.
using WallPasses = std::vector<WallPass>;

/// Steps 1 and 2 of docs/design/heat-correction.md. \param finish  the most that a finishing pass takes, mm
[[nodiscard]] std::vector<WallPasses> wall_passes(const HeatFound& found, double tool_radius, double finish);

/// A run of the program, or of a corrected one, as the passes of the program see it.
class PassView {
 public:
  /// \param first  whose passes are looked at
  PassView(const HeatFound& first, const HeatFound& now);

  /// The displacement of a wall at a height of a pass, in a case, um.
  [[nodiscard]] std::array<double, 2> displaced(
      const WallPass& pass, const WallPass::Height& height,
      const std::vector<std::vector<std::array<double, 2>>>& moved) const;
  /// How far a pass lies nearer to the wall now than the nearest of the program did, um.
  [[nodiscard]] double reached(const WallPass& pass) const;

 private:
  struct Seen {
    std::size_t place = 0, visit = 0;
  };
  [[nodiscard]] Seen seen(const WallPass::Height& height) const;

  const HeatFound &first_, &now_;
  SamePlaces places_;
};

/// Step 3: says how far each finishing pass of a place ought to be moved, um, and takes their displacements.
/// \param overcut  the most that it may go into the cold workpiece at any corner, um
[[nodiscard]] std::vector<double> wanted_moves(WallPasses& passes, const PassView& view, const HeatFound& now,
                                               double overcut);

}  // namespace lekalo::jobs
