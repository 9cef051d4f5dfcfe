#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/phases.hpp"
#include "lekalo/jobs/picture_form.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::jobs {

/// A program that ran before on the same stock, with a tool of its own.
struct EarlierProgram {
  File program;
  double tool_diameter = 0;  ///< mm, above 0
};

/// A program to be judged against the pocket that it is to clear.
struct SimulateJob {
  File program;
  File pocket;  ///< region JSON (docs/formats.md)
  std::vector<EarlierProgram> after;
  verify::SimulateOptions machining;
  // Documents beside the report, made only where they are asked for:
  std::optional<PictureForm> picture;  ///< SVG or PNG
  bool animation = false;
  bool samples = false;
};

/// A judged program. What was not asked for is empty.
struct Simulated {
  verify::SimulateReport report;
  /// Sentences about what the programs leave to the control, verify::unsaid_modes().
  std::vector<std::string> unsaid;
  std::string json;  ///< the report as a document, format lekalo-simulate (docs/formats.md)
  /// The engagement at every place of the path where it was measured, as CSV.
  std::string samples;
  std::string picture;    ///< SVG or PNG
  std::string animation;  ///< a page that plays the cut
};

/// Follows the program with the independent checker and says what it cuts. The only phase is
/// "following the program". Errors and cost are those of verify::simulate; a picture adds
/// ErrorCode::environment for a drawing library that fails, and usage for one as PDF.
[[nodiscard]] Result<Simulated> simulate(const SimulateJob& job, const PhaseListener& phases = {});

}  // namespace lekalo::jobs
