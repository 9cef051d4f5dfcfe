#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/heat.hpp"
#include "lekalo/jobs/heat_correction.hpp"
#include "lekalo/jobs/phases.hpp"
#include "lekalo/jobs/picture_form.hpp"

namespace lekalo::jobs {

/// A job whose result is written and drawn.
struct HeatResultJob {
  HeatJob heat;
  std::optional<PictureForm> picture;  ///< SVG or PNG, of the errors of walls
  std::optional<PictureForm> maps;     ///< SVG or PNG, of temperature, stress and displacement
  std::optional<PictureForm> report;
  bool animation = false;
  std::optional<CorrectionWish> correction;
  std::string corrected_as;  ///< the name of the corrected program, as the result says it
};

struct HeatResult {
  HeatFound found;
  /// Sentences about temperatures beyond the material's limit, and about what the programs leave to the
  /// control.
  std::vector<std::string> warnings;
  std::string json;  ///< format lekalo-heat (docs/formats.md); the checker refutes nothing of it
  /// SVG or PNG, a report in its form, a page of HTML; empty where not asked for.
  std::string picture, maps, report, animation;
  /// A correction, if one is asked for. If it has no program the warnings say why, and the result has none.
  std::optional<HeatCorrection> correction;
};

/// Computes heat() and heat_correction(), and puts the document before the checker. Errors, phases and cost
/// are theirs; besides, refuted where the checker finds a figure that is not true, and the phase "following
/// the program again".
[[nodiscard]] Result<HeatResult> heat_result(const HeatResultJob& job, const PhaseListener& phases = {});

/// The shortest and the longest wait of all cases, s; none where it takes more than kLongestWait.
[[nodiscard]] std::array<std::optional<double>, 2> waits_over(const std::vector<HeatCase>& cases,
                                                              std::optional<double> HeatCase::*seconds);

/// The name of a holding in results: free, plate, vice-x, vice-y; "held" for other sides.
[[nodiscard]] const char* name_of(const heat::Holding& holding) noexcept;

}  // namespace lekalo::jobs
