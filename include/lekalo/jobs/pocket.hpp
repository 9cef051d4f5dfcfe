#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/point.hpp"
#include "lekalo/io/formats/outline_file.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/phases.hpp"
#include "lekalo/jobs/simulate.hpp"
#include "lekalo/mill/pocket.hpp"
#include "lekalo/mill/program.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::jobs {

/// How a pocket is to be cleared.
struct PocketOptions {
  /// How the file is read. Where `layers` names some, those of islands and open edges are read too.
  io::OutlineOptions outline;
  mill::PocketOptions path;
  /// Its comments are replaced.
  /// \pre in range
  mill::ProgramOptions program;
  /// Whatever edges on these layers enclose stays.
  std::vector<std::string> island_layers;
  /// Edges on these layers are no walls, and beyond them is air.
  std::vector<std::string> open_layers;
  /// mm: a larger tool of this diameter is taken to have cut all that this job would cut with it; 0: none.
  double rest_of = 0;
  /// mm/min: feeds follow the engagement, up to this. \pre from the feed of `program` to four times it
  std::optional<double> most_feed;
};

struct PocketJob {
  File pocket;  ///< the outlines of the pockets, in any form that io::OutlineFile reads
  PocketOptions options;
  std::vector<EarlierProgram> after;  ///< \pre empty with options.rest_of
  std::string written_as;             ///< the name of the program's file, for the report
  // Documents beside program and report, made only where they are asked for:
  std::optional<PictureForm> picture;  ///< SVG or PNG
  bool animation = false;
  bool images = false;  ///< \pre options.path.method is one of the source's
};

/// A stretch of a program's path, as it stands in the report: rounded to thousandths.
struct ReportedStretch {
  geom::Point from, to;
  double z = 0;          ///< mm
  double length_mm = 0;  ///< of path in plan
  /// The largest engagement on the stretch; for a ramp the one that would have been met without it.
  double engagement_deg = 0;
};

/// A program that the checker has judged, and what it found. What was not asked for is empty.
struct Pocketed {
  std::string program;
  verify::SimulateReport report;  ///< of these very bytes
  /// Stretches outside entries of 0.2 mm and more, all along which the checker finds more of the rim in
  /// material than 1.25 times what a straight pass of this step-over meets. The source's spirals have them.
  std::vector<ReportedStretch> hot_cuts;
  /// Stretches that would have been hot and are cut on the way down instead, down to z.
  std::vector<ReportedStretch> ramps;
  /// Sentences about what the reader of the outline noticed.
  std::vector<std::string> notices;
  std::string json;       ///< the report as a document, format lekalo-pocket (docs/formats.md)
  std::string picture;    ///< SVG or PNG
  std::string animation;  ///< a page that plays the cut
  /// The source's model of the pocket as PNG pictures, each with the ending of its file's name: the four
  /// M-images "-A.png" to "-D.png", and "-value.png".
  std::vector<std::pair<std::string, std::string>> images;
};

/// Plans a path, writes it as a program, and has the independent checker judge the program as it is written.
/// What the checker finds comes back into the path (docs/design/pocket.md, steps 9 and 10), and the last
/// judgement is the one reported. A program that leaves the pocket by more than 0.005 mm or meets material in
/// rapid motion is never handed out.
///
/// The phases are "planning the tool before" (with rest_of), "planning the path", and "checking the program"
/// once for each whole judgement.
///
/// Errors: bad_input for what io::read_outline and mill::pocket_path refuse, an island (a contour with edges
/// on an island layer) that lies in no pocket, a layer with no edge on it, a tool before that is not larger,
/// and earlier programs that the checker cannot read. ErrorCode::usage for a picture as PDF, and refuted
/// where the checker does not let the program pass.
///
/// Cost: planning, and two to six judgements; a pocket of 100 x 60 mm takes about a second.
[[nodiscard]] Result<Pocketed> pocket(PocketJob job, const PhaseListener& phases = {});

}  // namespace lekalo::jobs
