#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/nc_words.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/verify/verify.hpp"

namespace lekalo::verify {

/// The simulator judges what an NC program cuts from the program's bytes alone. It reads program and pocket
/// itself and shares no code with any path maker. docs/design/simulate.md says how, and what each figure
/// means.

struct SimulateOptions {
  double tool_diameter = 0;   ///< mm, above 0
  double stock_to_leave = 0;  ///< mm on every wall, from 0 on
  /// The step-over as a part of the diameter, in (0, 1]; the lower bound of the time alone uses it.
  double step_over = 0.4;
  /// The Z of the stock's upper face; the tool is down when it is below.
  double top = 0;
  double acceleration = 500;  ///< mm/s2, of every axis
  double rapid_feed = 5000;   ///< mm/min, of G0
  /// The largest distance between places where engagement is measured, mm.
  double spacing = 0.05;
  /// The control in whose language the program, and those before it, are written.
  words::Control control = words::Control::linuxcnc;
  /// Two threads are used; the report is the same with one.
  unsigned threads = 2;
};

/// A program that ran before, with a tool of its own. What it cut is gone, down to the depth where it cut.
struct EarlierProgram {
  Document program;
  double tool_diameter = 0;  ///< mm, above 0
};

/// A place of the path where engagement was measured.
struct EngagementSample {
  double x = 0, y = 0, z = 0;
  /// The path that the sample stands for, which ends here, mm.
  double length = 0;
  /// The engaged part of the rim's leading half, degrees.
  double engagement = 0;
  /// The part of the engagement that is to the left of where the tool goes, degrees.
  double left = 0;
  double feed = 0;  ///< mm/min; 0 for a rapid
  /// The line of the program, from 1.
  std::size_t line = 0;
  /// True for an entry; see SimulateReport::entry_mm.
  bool entry = false;
};

/// A part of the pocket that no tool of this size can get to.
struct UnreachableSpot {
  /// The point of the spot that is farthest from what can be cut.
  double x = 0, y = 0;
  /// The distance of that point from what can be cut.
  double distance_mm = 0;
  double area_mm2 = 0;  ///< about
};

/// A place that could be cut and is not, wider than 0.02 mm.
struct UncutSpot {
  double x = 0, y = 0;
  double width_mm = 0;  ///< about
};

struct SimulateReport {
  /// The share that is swept at the deepest level of the program, of what is reachable there. Reachable is
  /// the pocket less the stock to leave, opened by the tool's disc.
  double coverage_percent = 0;
  /// A certain lower bound of the same, for which all that is undecided counts as uncut.
  double coverage_low_percent = 0;
  /// An upper bound on the diameter of a disc in what is left.
  double uncut_width_mm = 0;
  /// The distance by which the tool leaves the pocket less the stock to leave.
  double gouge_mm = 0;
  /// The largest engagement that lasts over 0.2 mm, outside entries.
  double engagement_max_deg = 0;
  /// The largest engagement of all samples, outside entries.
  double engagement_peak_deg = 0;
  /// The 95 % quantile by length of the engagement of what cuts, outside entries.
  double engagement_p95_deg = 0;
  /// The share of the path with the tool down on which engagement is below 3 degrees.
  double air_percent = 0;
  /// The length of path that goes down into material, or cuts nothing but the floor of such a ramp.
  double entry_mm = 0;
  /// The thickest layer that the rim meets at once on such path, except straight down. It is above the truth
  /// by at most 1e-3 mm and what a stroke of at most half a radius sinks.
  double entry_layer_mm = 0;
  /// The length of path of G0 with an engagement of 3 degrees or more, or down into material.
  double rapid_cut_mm = 0;
  /// The length of path with the tool down.
  double length_mm = 0;
  /// The turns of the path's direction, all added.
  double turning_rad = 0;
  /// The number of lifts out of the stock that another entry follows.
  std::size_t retracts = 0;
  double seconds = 0;
  /// A lower bound of the time for all levels; docs/design/simulate.md says how it is made.
  double lower_bound_seconds = 0;
  double reachable_mm2 = 0, uncut_mm2 = 0;
  /// The area that earlier programs left of the reachable area, at the deepest level.
  double left_before_mm2 = 0;
  std::vector<UnreachableSpot> unreachable;
  /// The widest spots come first, no two are nearer than the tool's radius, and there are at most 1000.
  std::vector<UncutSpot> uncut;
  std::vector<EngagementSample> samples;  ///< in the order of cutting
};

/// Judges a program. bad_input, with file and line, for every word that the control does not know
/// (base/nc_words.hpp), words of a block that do not fit together, a change of tool or offsets on the way, an
/// arc whose ends are not on one circle within 0.005 mm, a pocket that is open or meets itself, a tool that
/// fits nowhere in the pocket, and options out of range. Cost: about a microsecond for a sample and each
/// stroke of the path near it; a pocket of 100 x 60 mm with 3 m of path takes about a second. \param earlier
/// programs that ran before on the same stock, with the same top \param progress  hears, in the calling
/// thread, how far along the path it is; may be empty
[[nodiscard]] Result<SimulateReport> simulate(const Document& program, const Document& pocket,
                                              const SimulateOptions& options,
                                              const std::vector<EarlierProgram>& earlier = {},
                                              const ProgressListener& progress = {});

/// Returns a sentence for each mode of a control (unit, plane, from where it counts...) that the program, or
/// one before it, does not say before motions that depend on it. The control decides these, as it is set up
/// or as another program left it, and simulate() takes what is usual: mm, from the origin, XY. The sentences
/// call the program itself "program", and the others by their names. Errors as there.
[[nodiscard]] Result<std::vector<std::string>> unsaid_modes(const Document& program,
                                                            const SimulateOptions& options,
                                                            const std::vector<EarlierProgram>& earlier = {});

/// A range of lines of a program, from 1, both ends among them.
struct LineRange {
  std::size_t first = 1, last = 0;
};

/// Returns the samples of simulate() on these lines alone, at their share of its cost.
/// \param lines  ascending, not overlapping
[[nodiscard]] Result<std::vector<EngagementSample>> engagement_on(const Document& program,
                                                                  const Document& pocket,
                                                                  const SimulateOptions& options,
                                                                  const std::vector<EarlierProgram>& earlier,
                                                                  const std::vector<LineRange>& lines);

/// A stretch of a program's path below the stock's upper face: a line, or an arc of at most a quarter turn.
struct CutStretch {
  bool arc = false, ccw = true;
  double from_x = 0, from_y = 0, to_x = 0, to_y = 0, centre_x = 0, centre_y = 0;
  /// All of the stretch is at least this deep.
  double high_z = 0;
};

/// Returns the cuts of a program that ran before, as simulate() reads them. A path maker may know no more of
/// that program. Errors as there.
[[nodiscard]] Result<std::vector<CutStretch>> cut_stretches(
    const Document& program, double top, words::Control control = words::Control::linuxcnc);

}  // namespace lekalo::verify
