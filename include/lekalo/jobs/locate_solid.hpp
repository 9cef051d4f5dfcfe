#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/io/locate/solid_result_json.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/locate.hpp"
#include "lekalo/jobs/phases.hpp"
#include "lekalo/jobs/picture_form.hpp"
#include "lekalo/nc/rewrite.hpp"
#include "lekalo/nc/work_offset.hpp"

namespace lekalo::jobs {

/// `certified` searches the whole window; `climb` goes from the start to a placement that no small motion
/// makes better, and proves nothing. `icp` and `axes` are there for comparison (locate/solid_reference.hpp).
enum class SolidMethod { certified, climb, icp, axes };
/// Returns the method's name as it stands in results.
[[nodiscard]] const char* name_of(SolidMethod method) noexcept;

/// `smallest`: the largest margin is all that counts. `largest`: of the placements that give up no more of it
/// than is stated, one whose largest allowance is small (locate/solid_criterion.hpp). `even`: then one whose
/// allowances are near their targets, or their mean, and which gives up no more of either.
enum class SolidCriterion { smallest, largest, even };

/// The statements about a blank that is a scanner's mesh, or points.
struct SolidScanOptions {
  double uncertainty = 0;            ///< standard uncertainty of one point, mm, >= 0
  double coverage_factor = 2;        ///< the surface lies within so many of them of each point
  std::optional<double> min_radius;  ///< see locate::SolidScan, mm; one of the two has to be given
  std::optional<double> max_dip;
  std::optional<locate::SolidUnderside> underside;
  /// Points without another one this near are left out, mm, > 0.
  std::optional<double> drop_outliers;
  /// About the length of the edges between points, mm, > 0; without it as solid::PointSurfaceOptions says.
  std::optional<double> step;
};

/// The statements about a blank that was touched, beside the uncertainty of the touches
/// (locate/touched_solid.hpp).
struct SolidTouchOptions {
  double ball = 0;                 ///< diameter of the probe's ball, mm, >= 0
  double form = 0;                 ///< mm, > 0
  double shift = 5, turn_deg = 2;  ///< of the window about the fit: mm, > 0, and degrees, from 0 to 45
};

/// The lines that set work offset and rotation for the placement, whose pose is then one that they can say.
struct SolidOffsetOptions {
  nc::OffsetForm form;
  int axes = 3;  ///< of the machine, 3 or 5: five can follow a tilt
};

/// The way a solid is to be placed.
/// \pre numbers are in the ranges said here
struct SolidLocateOptions {
  /// The unit of both files, millimetres without.
  std::optional<io::SolidUnit> units;
  locate::SolidFreedom freedom = locate::SolidFreedom::six;
  /// The middle of the part's box may move by this along each axis, mm, >= 0. Without it by 5; where there
  /// are all turns, by as much as it takes to be anywhere in the blank.
  std::optional<double> shift = {};
  /// With `six`: the part may be turned by up to this from the start about any axis, degrees, from 0 to 90;
  /// or 180, which is every rotation.
  double tilt_deg = 5;
  /// With `c_xyz`: the turns about the z axis that are looked at, from -720 to 720, ascending, 180 apart or
  /// less; or 360 apart or more, which are all.
  double window_from_deg = -5, window_to_deg = 5;
  double gap = 1e-2;         ///< see locate::SolidOptions, mm, > 0
  double min_allowance = 0;  ///< mm, >= 0
  SolidMethod method = SolidMethod::certified;
  /// Goes on from what `certified` or `climb` found, where that meets what is demanded.
  SolidCriterion criterion = SolidCriterion::smallest;
  /// The criterion may take so much off the margin, and `even` may add it to the smallest largest allowance,
  /// mm, >= 0.
  double give_up = 0;
  /// The start is found by locate::find_start; there is no file of one then.
  bool find_start = false;
  /// Without it the blank is taken as drawn.
  std::optional<SolidScanOptions> scan;
  /// The job has a nominal mesh, and needs both.
  std::optional<SolidTouchOptions> touch = {};
  /// The way a program is rewritten; its `z` is that of the placement.
  nc::RewriteOptions rewrite = {};
  std::optional<SolidOffsetOptions> offset = {};
  /// They change the time and nothing else.
  unsigned threads = kUsualThreads;
};

/// A picture, a page that turns in a browser, or the part's surface in colours for another viewer.
enum class SolidPictureForm { png, html, ply };

/// A table, or points in colours for another viewer.
enum class SolidPointsForm { csv, ply };

/// The documents that are made beside the result.
struct SolidLocateOutputs {
  /// The name of a certificate file. When it is empty, the proof stands in the result, if it is not too long.
  std::string certificate;
  /// The name of the file for the mesh of a blank that is points, or whose mesh does not close.
  std::string mesh;
  /// The name of the rewritten program.
  /// \pre not empty where the job has one
  std::string program;
  /// The name of the lines of the work offset.
  /// \pre not empty where the options have one
  std::string offset;
  /// The allowance at every corner of the part as CSV.
  bool allowances = false;
  /// The distance of every measured point, or corner of the blank, from the placed part.
  std::optional<SolidPointsForm> deviations;
  std::optional<SolidPictureForm> picture;
  std::optional<PictureForm> report;
};

struct SolidLocateJob {
  File part, blank;
  /// An earlier result for solids, whose pose is the start. Without one the part begins where its file has
  /// it.
  std::optional<File> start = {};
  /// Demands by face (io/locate/solid_feature_file.hpp).
  std::optional<File> features = {};
  /// See LocateJob.
  std::optional<File> program = {}, allow = {};
  SolidLocateOptions options = {};
  SolidLocateOutputs outputs = {};
  /// The warnings that the caller has to give; the result repeats them first.
  std::vector<std::string> warnings = {};
  /// The mesh of the blank as it should be. The file of the blank then has touches.
  std::optional<File> nominal = {};
};

/// A placement that the independent checker has confirmed. Documents that were not asked for are empty.
struct LocatedSolid {
  io::SolidDocument document;
  /// The bytes of `document`, which are what was checked.
  std::string result;
  std::string certificate, mesh, allowances, deviations, picture, report, program, offset;
  /// There was a program, or an offset, but the placement does not allow it; a warning in the document says
  /// why.
  bool program_withheld = false, offset_withheld = false;

  /// True if the answer is yes: the part lies in the blank and has the allowance, all of the blank is known,
  /// and the program and the offset, if they were asked for, are there.
  [[nodiscard]] bool holds() const noexcept {
    return document.inside() && !(*document.shortfall() > 0) && !program_withheld && !offset_withheld &&
           (!document.scan || document.scan->proved());
  }
};

/// Says which job a part and a blank are for: true if both are solids, for locate_solid, and false if neither
/// is, for locate. A PLY or points beside an outline are a scan in the plane. bad_input for one of each, and
/// for a part that is points.
[[nodiscard]] Result<bool> are_solids(const File& part, const File& blank);

/// Places a solid in a blank, both closed meshes; the part is taken as drawn, and so is a blank that is no
/// scan. Points of a scan, or one whose mesh does not close, are meshed first, if the mesh has a name, and a
/// nominal mesh is moved to touches: it is then the blank of the result. Before anything is handed out the
/// very bytes of the result are put before the checker of verify/verify.hpp, as in locate().
///
/// Deterministic: only SolidDocument::seconds and ::threads are not functions of the job. `run` is for the
/// search: its unit of work is a box bounded, a program solved or a pose measured. `phases` hears how points
/// are meshed before that, and when the check begins after it.
///
/// Errors: bad_input as of io::parse_solid, solid::closed_mesh and solid::surface_through, for points that
/// nobody says how to mesh or that contradict what is said of them, for a start that is no result for solids,
/// and as of io::parse_solid_features and io::find_solid_features; program_refused as of nc::rewrite_program;
/// usage as of locate::locate_solid and locate::guaranteed_solid; environment where a drawing library fails;
/// refuted where the checker does not confirm the result, which is a mistake of ours.
[[nodiscard]] Result<LocatedSolid> locate_solid(const SolidLocateJob& job, const RunControl& run = {},
                                                const Stopwatch& stopwatch = {},
                                                const PhaseListener& phases = {});

}  // namespace lekalo::jobs
