#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/draw/solid_picture.hpp"
#include "lekalo/io/locate/result_json.hpp"

namespace lekalo::draw {

/// A file of a placement, and a few words about it: "99,904 triangles, mm".
struct SolidReportFile {
  std::string role;
  io::FileRecord file;
  std::string about;
};

/// A placement as a technologist decides by it and files it away. docs/design/picture.md.
struct SolidReport {
  SolidScene scene;
  /// The poses that were looked at, as in locate::SolidProblem: mm, degrees.
  locate::SolidFreedom freedom = locate::SolidFreedom::six;
  double shift = 0, turn_deg = 0;
  /// Some of them are turned by more than turn_deg, up to this.
  double farthest_turn_deg = 0;
  std::vector<SolidReportFile> inputs;
  /// The proof, in boxes of poses; none where there is none, or it was not kept.
  std::size_t certificate_boxes = 0;
  /// The file that holds it, if not the result.
  std::optional<io::FileRecord> certificate_file;
  std::vector<std::string> warnings, assumptions;  ///< sentences, or as a result has them
  std::uint64_t work = 0;
};

/// The page (A4, portrait): the placed part in the colours of its allowance from the front, from the right
/// and from above, in first-angle order and one scale, and isometric; figures, what is proved, contacts,
/// files with their digests, assumptions and warnings. Minima are rounded down, bounds and what is missing
/// up.
///
/// \pre as of solid_png
/// Same input, same bytes; PNG, PDF and the views of the SVG on a machine with the same libraries and fonts.
/// ErrorCode::usage for a width that report_png refuses, ErrorCode::environment when the drawing library
/// fails.
[[nodiscard]] std::string solid_report_svg(const SolidReport& report, unsigned threads = kUsualThreads);
[[nodiscard]] Result<std::string> solid_report_png(const SolidReport& report, int width_px = 1654,
                                                   unsigned threads = kUsualThreads);
[[nodiscard]] Result<std::string> solid_report_pdf(const SolidReport& report,
                                                   unsigned threads = kUsualThreads);

}  // namespace lekalo::draw
