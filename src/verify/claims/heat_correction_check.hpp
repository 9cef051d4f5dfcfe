#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "heat_fields.hpp"
#include "lekalo/verify/cut_history.hpp"
#include "machining_fields.hpp"
#include "verify/heat/cut_work.hpp"

namespace lekalo::verify {

/// A corrected program, and the parts of a result of `lekalo heat` by which it is judged.
struct HeatCorrectionJob {
  const Document& report;
  const FollowedFiles& followed;
  const Document& corrected;
  const SimulateOptions& options;
  const CheckedCutting& cutting;
  const CheckedStock& stock;
  double spacing = 0;        ///< of places, mm
  CheckedRange parts{1, 1};  ///< of the heat at the middles
  std::size_t cases = 0;
  /// The largest errors of the program as it is: at the middles, anywhere in the intervals, and what the best
  /// scaling leaves at the middles, um.
  double before = 0, greatest_before = 0, scaled = 0;
};

/// Follows the corrected program, and rebuilds from its lines and arcs how far it comes beyond the places to
/// which the program comes; with the displacements that are said, what it leaves at each corner of the
/// intervals. Returns a sentence for each figure that is another, and for what a corrected program may not
/// do: leave more than a fifth, or what a scaling leaves; be worse anywhere in the intervals; go more than 1
/// um into the cold workpiece; leave the pocket elsewhere. \param history  of the program. \param fields  of
/// the report, of which correction and after_correction_um are read
[[nodiscard]] Result<std::vector<std::string>> correction_faults(const HeatCorrectionJob& job,
                                                                 const CutHistory& history,
                                                                 ReportFields& fields,
                                                                 std::string& complaint);

}  // namespace lekalo::verify
