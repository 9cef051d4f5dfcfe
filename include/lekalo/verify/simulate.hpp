#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/verify/verify.hpp"

namespace lekalo::verify {

/// The simulator judges what an NC program cuts from the program's bytes alone: it reads program and pocket
/// itself and shares no code with any path maker. How, and what each figure means: docs/design/simulate.md.

struct SimulateOptions {
  double tool_diameter = 0;   ///< mm, above 0
  double stock_to_leave = 0;  ///< mm on every wall, from 0 on
  double step_over = 0.4;     ///< part of the diameter, of the lower bound for the time alone; in (0, 1]
  double top = 0;             ///< Z of the stock's upper face; the tool is down below it
  double acceleration = 500;  ///< mm/s2, of every axis
  double rapid_feed = 5000;   ///< mm/min, of G0
  double spacing = 0.05;      ///< mm between the places where engagement is measured, at most
  unsigned threads = 2;       ///< two are used; the report is the same with one
};

/// A program that ran before with a tool of its own: what it cut is gone, down to where it cut.
struct EarlierProgram {
  Document program;
  double tool_diameter = 0;  ///< mm, above 0
};

/// A place of the path where engagement was measured.
struct EngagementSample {
  double x = 0, y = 0, z = 0;
  double length = 0;      ///< mm of path it stands for, up to here
  double engagement = 0;  ///< degrees of the rim's leading half
  double left = 0;        ///< of them to the left of where the tool goes
  std::size_t line = 0;   ///< of the program, from 1
  bool entry = false;     ///< see SimulateReport::entry_mm
};

/// A part of the pocket no tool of this size gets to.
struct UnreachableSpot {
  double x = 0, y = 0;     ///< its point farthest from what can be cut
  double distance_mm = 0;  ///< how far that is
  double area_mm2 = 0;     ///< about
};

/// A place that could be cut and is not, wider than 0.02 mm.
struct UncutSpot {
  double x = 0, y = 0;
  double width_mm = 0;  ///< about
};

struct SimulateReport {
  /// Swept at the deepest level of the program, of what is reachable there. Reachable: the pocket less the
  /// stock to leave, opened by the tool's disc.
  double coverage_percent = 0;
  double coverage_low_percent = 0;  ///< the same from below, certainly: all that is undecided counts as uncut
  double uncut_width_mm = 0;        ///< upper bound on the diameter of a disc in what is left
  double gouge_mm = 0;              ///< how far the tool leaves the pocket less the stock to leave
  double engagement_max_deg = 0;    ///< the largest that lasts over 0.2 mm, outside entries
  double engagement_peak_deg = 0;   ///< the largest of all samples, outside entries
  double engagement_p95_deg = 0;    ///< by length, of what cuts, outside entries
  double air_percent = 0;           ///< of the path with the tool down: engagement below 3 degrees
  double entry_mm = 0;  ///< path that goes down into material, or cuts nothing but the floor of such a ramp
  /// Thickest layer the rim meets at once on such path, but for straight down; at most 1e-3 mm above the
  /// truth, and what a stroke of at most half a radius sinks.
  double entry_layer_mm = 0;
  double rapid_cut_mm = 0;   ///< path of G0 with engagement of 3 degrees or more, or down into material
  double length_mm = 0;      ///< of path with the tool down
  double turning_rad = 0;    ///< of its direction, all added
  std::size_t retracts = 0;  ///< lifts out of the stock that another entry follows
  double seconds = 0;
  double lower_bound_seconds = 0;  ///< of all levels: docs/design/simulate.md
  double reachable_mm2 = 0, uncut_mm2 = 0;
  double left_before_mm2 = 0;  ///< of the reachable, at the deepest level, what earlier programs left
  std::vector<UnreachableSpot> unreachable;
  std::vector<UncutSpot> uncut;  ///< widest first, no two nearer than the tool's radius, at most 1000
  std::vector<EngagementSample> samples;  ///< in the order of cutting
};

/// bad_input, with file and line: a program with words whose motion is not understood (subprograms,
/// variables, cutter compensation, cycles, machine coordinates, rotations), an arc whose ends are not on one
/// circle within 0.005 mm, a pocket that is open or meets itself, a tool that fits nowhere in the pocket;
/// options out of range. Cost: about a microsecond for a sample and each stroke of the path near it; a pocket
/// of 100 x 60 mm with 3 m of path takes about a second.
/// \param earlier  programs that ran before on the same stock, with the same top
/// \param progress  hears, in the calling thread, how far along the path it is; may be empty
[[nodiscard]] Result<SimulateReport> simulate(const Document& program, const Document& pocket,
                                              const SimulateOptions& options,
                                              const std::vector<EarlierProgram>& earlier = {},
                                              const ProgressListener& progress = {});

/// Lines of a program, from 1, both ends among them.
struct LineRange {
  std::size_t first = 1, last = 0;
};

/// The samples of simulate() on these lines alone, at their share of its cost.
/// \param lines  ascending, not overlapping
[[nodiscard]] Result<std::vector<EngagementSample>> engagement_on(const Document& program,
                                                                  const Document& pocket,
                                                                  const SimulateOptions& options,
                                                                  const std::vector<EarlierProgram>& earlier,
                                                                  const std::vector<LineRange>& lines);

/// A stretch of a program's path below the stock's upper face: a line, or at most a quarter turn.
struct CutStretch {
  bool arc = false, ccw = true;
  double from_x = 0, from_y = 0, to_x = 0, to_y = 0, centre_x = 0, centre_y = 0;
  double high_z = 0;  ///< all of it is at least this deep
};

/// The cuts of a program that ran before, as simulate reads them: a path maker may know no more of it. Errors
/// as there.
[[nodiscard]] Result<std::vector<CutStretch>> cut_stretches(const Document& program, double top);

}  // namespace lekalo::verify
