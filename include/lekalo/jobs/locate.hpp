#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/io/formats/outline_file.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/picture_form.hpp"
#include "lekalo/locate/demand.hpp"
#include "lekalo/locate/reference.hpp"
#include "lekalo/nc/rewrite.hpp"

namespace lekalo::jobs {

/// `certified` proves its result; the others are there for comparison and prove nothing.
enum class LocateMethod { certified, ipopt, icp };
/// Returns the method's name as it stands in results.
[[nodiscard]] const char* name_of(LocateMethod method) noexcept;

/// The way a part is to be placed.
/// \pre numbers are in the ranges said here
struct LocateOptions {
  io::OutlineOptions part, blank;  ///< how the two files are read
  /// Dents of the blank up to this deep are cut inwards, mm, > 0.
  std::optional<double> trim;
  /// The angles looked at, from -720 to 720, ascending.
  double window_from_deg = 0, window_to_deg = 360;
  /// See locate::Options, mm, > 0.
  std::optional<double> gap;
  double min_allowance = 0;  ///< mm, >= 0
  locate::Mirror mirror = locate::Mirror::no;
  locate::LockedShift locked;
  locate::Criterion criterion = locate::criteria().front();
  double give_up = 0;  ///< mm, >= 0: what later criteria may take off the margin
  /// The points of the trade-off curve, 0 or at least 2.
  std::size_t trade_off = 0;
  /// Other placements are listed too that lose at most this, mm, >= 0.
  std::optional<double> alternatives;
  LocateMethod method = LocateMethod::certified;
  int starts = 10;  ///< of ipopt, >= 1
  locate::StartRule start_rule = locate::StartRule::random;
  std::uint64_t seed = 0;
  nc::RewriteOptions rewrite;
};

enum class DrawingFormat { none, dxf, svg };

/// The documents that are made beside the result. Their names are those that the result gives them.
struct LocateOutputs {
  /// The name of a certificate file. When it is empty, the proof stands in the result, if it is not too long.
  std::string certificate;
  /// A name for the distances of every probed point as CSV; empty when they are not wanted.
  std::string deviations;
  /// The name of the rewritten program.
  /// \pre not empty where the job has one
  std::string program;
  std::optional<PictureForm> picture;  ///< SVG or PNG
  std::optional<PictureForm> report;
  /// The allowance along the outline as CSV.
  bool allowances = false;
  /// The blank and the part as it lies, on layers BLANK and PART.
  DrawingFormat drawing = DrawingFormat::none;
};

struct LocateJob {
  File part, blank;
  /// Demands by feature (io/locate/feature_file.hpp).
  std::optional<File> features = {};
  /// An NC program in the part's frame.
  std::optional<File> program = {};
  /// M words that move no axis, beside those that lekalo knows (nc/allow_list.hpp).
  std::optional<File> allow = {};
  /// The result of an earlier probing, to compare with.
  std::optional<File> earlier = {};
  LocateOptions options = {};
  LocateOutputs outputs = {};
  /// The warnings that the caller has to give; the result repeats them first.
  std::vector<std::string> warnings = {};
};

/// A placement that the independent checker has confirmed, all but the choice of a criterion that it does not
/// know (verify::knows_criterion), which a warning in the document says. Documents that were not asked for
/// are empty.
struct Located {
  io::LocateDocument document;
  /// The bytes of `document`, which are what was checked.
  std::string result;
  std::string certificate, deviations, program, picture, report, allowances, drawing;
  /// There was a program, but the placement does not allow it; a warning in the document says why.
  bool program_withheld = false;

  /// True if the answer is yes: the allowance or the demands are met, the whole blank is known, and the
  /// program, if there was one, is there.
  [[nodiscard]] bool holds() const noexcept {
    return !(document.shortfall > 0) && !program_withheld && (!document.scan || document.scan->proved);
  }
};

/// Seconds since some moment; empty: the result says that it took none.
using Stopwatch = std::function<double()>;

/// Places the part and proves the placement. Before anything is handed out the very bytes of the result, with
/// its proof also where that is too long to be kept, are put before the checker of verify/verify.hpp, which
/// shares no code with what made them. What is claimed is rounded to the safe side; an allowance that the
/// part just has is claimed where the checker confirms it, and only there. A program is handed out only where
/// the placement keeps the allowance with the rounding of the program's decimals.
///
/// Deterministic: only LocateDocument::seconds depends on the stopwatch, which is read before and after the
/// search. `run` is for the search: its unit of work is that of the method. What was found until a stop is
/// checked to the end, or until `interrupt` is set, if that is given: then nothing is handed out
/// (base/stop.hpp). One that is set before the search ends is a stop like others.
///
/// Errors: bad_input and usage as of the readers and searches, and for what only convex outlines can have;
/// usage for a picture as PDF;
/// program_refused as of nc::rewrite_program; environment where a drawing library fails; refuted where the
/// checker does not confirm the result, which is a mistake of ours. Cost: that of the search and about as
/// much for the check.
[[nodiscard]] Result<Located> locate(const LocateJob& job, const RunControl& run = {},
                                     const Stopwatch& stopwatch = {},
                                     const std::atomic<bool>* interrupt = nullptr);

}  // namespace lekalo::jobs
