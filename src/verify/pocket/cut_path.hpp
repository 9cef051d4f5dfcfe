#pragma once

#include <vector>

#include "lekalo/verify/simulate.hpp"
#include "machine_time.hpp"
#include "nc_moves.hpp"
#include "pocket_reach.hpp"
#include "stroke_index.hpp"

namespace lekalo::verify {

/// Depths that differ by no more are one.
inline constexpr double kSameLevel = 1e-6;  // mm

/// Below this engagement the tool cuts nothing.
inline constexpr double kAirDegrees = 3;

/// A short piece of the path with the tool below the stock's upper face.
struct Cut {
  /// A plunge has a stroke of no length.
  Stroke stroke;
  double from_z = 0, to_z = 0;
  /// The number of the move that it is a part of, and the shares of that move's way at which it begins and
  /// ends.
  std::size_t move = 0;
  double begin = 0, end = 1;
  std::size_t line = 0;
  /// Counts how often the tool has come down into the stock so far, from 1; 0 for an earlier program's cut.
  std::size_t entry = 0;
  bool rapid = false;
  double feed = 0;  ///< mm/min; 0 for a rapid
  /// The radius of the tool, mm.
  double radius = 0;
  [[nodiscard]] bool level() const { return from_z == to_z; }
};

struct CutPath {
  std::vector<Cut> cuts;
  /// The strokes of the cuts, in their order.
  std::vector<Stroke> strokes;
  /// The cuts of earlier programs, in their order.
  std::vector<Cut> before;
  std::size_t retracts = 0;
  double deepest = 0;
};

/// Step 1 of docs/design/simulate.md: cuts the path below `top` into pieces no longer than `longest`.
/// bad_input where there would be more than 200,000 and 10,000 for each move, or than 1,500,000 and 4 for
/// each.
[[nodiscard]] Result<CutPath> cut_path(const std::vector<Move>& moves, double top, double tool_radius,
                                       double longest, const std::string& name);

/// Returns an index over the ground of all cuts, with none of them in it yet.
[[nodiscard]] StrokeIndex index_over(const std::vector<Cut>& cuts, double cell);

/// Says of each cut whether it runs on the level just where one before it has run as deep, with a tool as
/// wide: such a cut changes nothing.
[[nodiscard]] std::vector<bool> repeated(const std::vector<Cut>& cuts);

/// The area of material that the path takes off at one depth while it moves level.
struct Removed {
  double z = 0, mm2 = 0;
};

/// Steps 2 to 7: measures engagement along the path, and fills samples and all figures of `report` that come
/// from them. Returns what is taken off at each depth.
std::vector<Removed> measure_engagement(const CutPath& path, const Air& air, double radius, double spacing,
                                        SimulateReport& report, const ProgressListener& progress);

/// Fills the samples on some lines and nothing else.
void measure_engagement_on(const CutPath& path, const Air& air, const SimulateOptions& options,
                           const std::vector<LineRange>& lines, SimulateReport& report);

/// Fills coverage and uncut spots (step 8). measure_gouge and find_unreachable (step 10) fill gouge and the
/// parts out of reach.
void measure_coverage(const CutPath& path, const PocketReach& pocket, double radius, SimulateReport& report);
void measure_gouge(const CutPath& path, const PocketReach& pocket, SimulateReport& report);
void find_unreachable(const PocketReach& pocket, double radius, SimulateReport& report);

}  // namespace lekalo::verify
