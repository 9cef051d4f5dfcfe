#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "document.hpp"

namespace lekalo::verify {

/// Points of a file, mm, in the doubles nearest to them.
using RoundedPoints = std::vector<std::pair<double, double>>;

/// Holds the comparison of a result against the earlier one, and returns the placement of that; the clearance
/// of that placement in the new blank is left to the caller. Nothing if it cannot be read. \pre the result
/// has a comparison
[[nodiscard]] std::optional<WrittenPlacement> check_comparison(const ResultDocument& result,
                                                               const Document& earlier,
                                                               const RoundedPoints& part,
                                                               std::vector<std::string>& findings);

/// Holds the distances of the points of the blank's file from the placed part, each in the table that was
/// written and the range in the result, against those of the files, within 1e-12 of the coordinates. Returns
/// false where a note says what was not looked at: there are too many points, or the table is not there.
[[nodiscard]] bool check_deviations(const ResultDocument& result, const std::optional<Document>& table,
                                    const RoundedPoints& part, const RoundedPoints& blank,
                                    std::vector<std::string>& findings, std::vector<std::string>& notes);

}  // namespace lekalo::verify
