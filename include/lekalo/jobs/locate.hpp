#pragma once

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
/// As it stands in results.
[[nodiscard]] const char* name_of(LocateMethod method) noexcept;

/// How a part is to be placed. \pre numbers are in the ranges said here
struct LocateOptions {
  io::OutlineOptions part, blank;  ///< how the two files are read
  std::optional<double> trim;      ///< mm, > 0: dents of the blank up to this deep are cut inwards
  double window_from_deg = 0, window_to_deg = 360;  ///< angles looked at, from -720 to 720, ascending
  std::optional<double> gap;                        ///< mm, > 0: locate::Options
  double min_allowance = 0;                         ///< mm, >= 0
  locate::Mirror mirror = locate::Mirror::no;
  locate::LockedShift locked;
  locate::Criterion criterion = locate::criteria().front();
  double give_up = 0;                  ///< mm, >= 0: what later criteria may take off the margin
  std::size_t trade_off = 0;           ///< points of the trade-off curve, 0 or at least 2
  std::optional<double> alternatives;  ///< mm, >= 0: also list placements that lose at most this
  LocateMethod method = LocateMethod::certified;
  int starts = 10;  ///< of ipopt, >= 1
  locate::StartRule start_rule = locate::StartRule::random;
  std::uint64_t seed = 0;
  nc::RewriteOptions rewrite;
};

enum class DrawingFormat { none, dxf, svg };

/// Says what is made beside the result. Names are those by which the result calls these documents.
struct LocateOutputs {
  std::string certificate;             ///< empty: the proof stands in the result, if it is not too long
  std::string deviations;              ///< the distance of every probed point as CSV; empty: not made
  std::string program;                 ///< of the rewritten program; \pre not empty where the job has one
  std::optional<PictureForm> picture;  ///< SVG or PNG
  std::optional<PictureForm> report;
  bool allowances = false;  ///< the allowance along the outline as CSV
  DrawingFormat drawing =
      DrawingFormat::none;  ///< the blank and the part as it lies, on layers BLANK and PART
};

struct LocateJob {
  File part, blank;
  std::optional<File> features = {};  ///< demands by feature (io/locate/feature_file.hpp)
  std::optional<File> program = {};   ///< NC program in the part's frame
  std::optional<File> earlier = {};   ///< result of an earlier probing, to compare with
  LocateOptions options = {};
  LocateOutputs outputs = {};
  std::vector<std::string> warnings = {};  ///< what the caller has to say; the result repeats it first
};

/// A placement that the independent checker has confirmed, all but the choice of a criterion that it does not
/// know (verify::knows_criterion), which a warning in the document says. Documents that were not asked for
/// are empty.
struct Located {
  io::LocateDocument document;
  std::string result;  ///< `document` as bytes: what was checked
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
/// search. `run` is for the search: its unit of work is that of the method.
///
/// Errors: bad_input and usage as of the readers and searches, and for what only convex outlines can have;
/// usage for a picture as PDF;
/// program_refused as of nc::rewrite_program; environment where a drawing library fails; refuted where the
/// checker does not confirm the result, which is a mistake of ours. Cost: that of the search and about as
/// much for the check.
[[nodiscard]] Result<Located> locate(const LocateJob& job, const RunControl& run = {},
                                     const Stopwatch& stopwatch = {});

}  // namespace lekalo::jobs
