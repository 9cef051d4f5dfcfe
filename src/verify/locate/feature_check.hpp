#pragma once

#include <optional>
#include <string>
#include <vector>

#include "demand_check.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/origin/origin.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// The demands of a result and what they were made from, beside the file of features.
struct DemandClaims {
  const WrittenDemands* demands = nullptr;  ///< nullptr: the result has none
  Decimal min_allowance;
  const Shape& part;
  /// True when the part is without what the file says to ignore.
  bool part_cut = false;
  /// The checker's own reading of the part's file.
  const Origin& origin;
};

/// Reads the regions that a file of features says to ignore, and their unit. There are none where the file
/// cannot be read, which check_features reports.
struct IgnoredRegions {
  std::vector<Json> regions;
  std::optional<LengthUnit> unit;
};
[[nodiscard]] IgnoredRegions read_ignored(const std::optional<Document>& file);

/// Rebuilds the demands from the file of features and the part, and reports every one that the result states
/// otherwise, lacks or adds. Without a file a result may have no feature, and only its own minimum.
///
/// Returns false where a note says which edges were not rebuilt: those of a label in a file that was not read
/// or has none, and edges by number of a part that is cut, unless it is a region file or points.
[[nodiscard]] bool check_features(const std::optional<Document>& file, const DemandClaims& claims,
                                  LocateReport& report);

}  // namespace lekalo::verify
