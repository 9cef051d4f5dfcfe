#pragma once

#include <optional>
#include <string>
#include <vector>

#include "demand_check.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// The demands of a result and what they were made from, beside the file of features.
struct DemandClaims {
  const WrittenDemands* demands = nullptr;  ///< nullptr: the result has none
  Decimal min_allowance;
  const Shape& part;
  /// True when the part is without what the file says to ignore.
  bool part_cut = false;
  /// True when the part file is a region file, whose edges have no labels.
  bool part_is_region = false;
};

/// Rebuilds the demands from the file of features and the part, and reports every one that the result states
/// otherwise, lacks or adds. Without a file a result may have no feature, and only its own minimum.
///
/// Returns false where a note says which edges were not rebuilt: those of a label, because they come from
/// drawings and trees that are not read here, and all edges of a part that is cut.
[[nodiscard]] bool check_features(const std::optional<Document>& file, const DemandClaims& claims,
                                  LocateReport& report);

}  // namespace lekalo::verify
