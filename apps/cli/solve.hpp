#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "contours.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/locate/convex.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// What a method found, in the terms of the result document (indices are those of the file).
struct Solution {
  std::string status;
  locate::Placement best;
  std::optional<double> upper_bound;  ///< only of methods that prove one
  double shortfall = 0;
  std::vector<locate::Contact> contacts;          ///< indices of the result document
  std::vector<locate::Contact> polygon_contacts;  ///< the same, indices of the polygons
  std::vector<locate::CertificateInterval> certificate;
  std::vector<locate::Placement> alternatives;
  bool alternatives_complete = true;
  std::uint64_t work = 0;
  double seconds = 0;
};

/// Angles in radians that hold the window in degrees for certain.
[[nodiscard]] locate::AngleWindow window_of(const LocateOptions& options);
[[nodiscard]] const char* name_of(locate::Status status);

[[nodiscard]] Result<Solution> solve(const Contour& part, const Contour& blank, const LocateOptions& options);

/// The clearance of a placement that some other computation gave, mm: never above the exact one, for any
/// contours within the reading errors of the two given.
[[nodiscard]] double safe_clearance(const Contour& part, const Contour& blank,
                                    const locate::Placement& placement);

}  // namespace lekalo::cli
