#pragma once

#include <vector>

#include "lekalo/verify/simulate.hpp"
#include "nc_moves.hpp"
#include "pocket_reach.hpp"
#include "stroke_index.hpp"

namespace lekalo::verify {

/// A short piece of the path with the tool below the stock's upper face.
struct Cut {
  Stroke stroke;  ///< of no length for a plunge
  double from_z = 0, to_z = 0;
  std::size_t line = 0;
  std::size_t entry = 0;  ///< which time the tool is down in the stock, from 1; 0: an earlier program's
  bool rapid = false;
  double radius = 0;  ///< of the tool, mm
  [[nodiscard]] bool level() const { return from_z == to_z; }
};

struct CutPath {
  std::vector<Cut> cuts;
  std::vector<Stroke> strokes;  ///< of the cuts, in their order
  std::vector<Cut> before;      ///< of earlier programs, in their order
  std::size_t retracts = 0;
  double deepest = 0;
};

/// Pieces no longer than `longest`; bad_input where they would be more than ten million.
[[nodiscard]] Result<CutPath> cut_path(const std::vector<Move>& moves, double top, double tool_radius,
                                       double longest, const std::string& name);

/// The material that the path takes off at one depth, on the level.
struct Removed {
  double z = 0, mm2 = 0;
};

/// Engagement along the path: fills samples and all figures of `report` that come from them. Returns what is
/// taken off at each depth.
std::vector<Removed> measure_engagement(const CutPath& path, const Air& air, double radius, double spacing,
                                        SimulateReport& report, const ProgressListener& progress);

/// Fills the samples on some lines alone, nothing else.
void measure_engagement_on(const CutPath& path, const Air& air, const SimulateOptions& options,
                           const std::vector<LineRange>& lines, SimulateReport& report);

/// Coverage, uncut spots, gouge and unreachable spots.
void measure_coverage(const CutPath& path, const PocketReach& pocket, double radius, SimulateReport& report);
void measure_gouge(const CutPath& path, const PocketReach& pocket, SimulateReport& report);
void find_unreachable(const PocketReach& pocket, double radius, SimulateReport& report);

/// Seconds for all moves: docs/design/simulate.md.
[[nodiscard]] double machine_seconds(const std::vector<Move>& moves, const SimulateOptions& options);

}  // namespace lekalo::verify
