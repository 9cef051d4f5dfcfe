#pragma once

#include <cstddef>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/mill/path.hpp"

namespace lekalo::mill {

/// The side on which a cut has the material. With a spindle that turns clockwise, climb has it on the right.
enum class Direction { any, climb, conventional };

/// `fronts` is the product's method; the others are the source's spirals on FLOZ models, for comparison.
enum class Method { fronts, floz_linear, floz_quadratic };

/// A stretch that an earlier tool went along. Everything that its disc swept there is gone.
struct EarlierCut {
  /// An arc of at most half a turn, or a line; a line of no length where the tool went straight down.
  geom::Edge edge;
  /// All of the stretch is at least this deep, mm below the stock's face.
  double depth = 0;
  double tool_diameter = 0;  ///< mm
};

struct PocketOptions {
  double tool_diameter = 6;   ///< mm
  double step_over = 0.4;     ///< part of the diameter, in (0, 0.5]
  double stock_to_leave = 0;  ///< mm, on walls
  double floor_stock = 0;     ///< mm, on the floor; less than the depth
  double depth = 1;           ///< mm, above 0
  /// The most that one level takes, mm; 0 for a single level.
  double step_down = 0;
  Direction direction = Direction::any;
  double safe_height = 5;    ///< mm above the stock
  double ramp_angle = 0.05;  ///< rad
  /// Lines and arcs may be this far from the points of the path that they replace, mm.
  double fit_tolerance = 2e-3;
  Method method = Method::fronts;
  // The source's methods alone use what follows.
  bool whole = false;
  /// The longest segment of the model, mm.
  double sampling = 3;
  /// The step along a spiral, mm; 0 for the one that leaves the step-over between turns.
  double trace_step = 0;
  /// The starts of spirals, mm. A spiral begins at the start that lies in its place, or at its peak where
  /// there is none.
  std::vector<geom::Point> starts;
};

/// Returns the mm that one level takes; levels are equally deep.
[[nodiscard]] double level_depth(const PocketOptions& options);

/// Plans a path that clears what the tool can reach of the pockets, by fronts: from an entry the path grows
/// over the places where the tool's middle may be, in steps that hold the engagement, and the boundary of
/// each step is cut. docs/design/pocket.md says how, and what it does not do yet. Levels are equally deep and
/// each pocket is finished before the next. A pocket that the tool does not fit into is left out.
///
/// After other tools (`before`) only what they have left is cut. The tool comes down where they have been,
/// and goes from one place to the next through what is gone.
///
/// bad_input for options out of range, where the tool fits nowhere, where the tools before have left nothing,
/// and for a start outside all spirals' places, a second one in a place, and one whose spiral has no step
/// there.
/// \param progress  hears what share is planned; may be empty
[[nodiscard]] Result<PocketPath> pocket_path(const std::vector<geom::Region>& pockets,
                                             const PocketOptions& options,
                                             const std::vector<EarlierCut>& before = {},
                                             const ProgressListener& progress = {});

/// Returns the stretches that a tool of this diameter cuts along the path.
[[nodiscard]] std::vector<EarlierCut> cuts_of(const PocketPath& path, double tool_diameter);

}  // namespace lekalo::mill
