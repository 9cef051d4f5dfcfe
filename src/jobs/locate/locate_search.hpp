#pragma once

#include <string>

#include "lekalo/jobs/locate.hpp"
#include "lekalo/locate/locate.hpp"

namespace lekalo::jobs {

/// Holds what a method found.
struct Search {
  std::string status;  ///< as it stands in results
  locate::Found found;
  double seconds = 0;
};

[[nodiscard]] Result<Search> searched(const locate::Problem& problem, const LocateOptions& options,
                                      const RunControl& run, const Stopwatch& stopwatch);

/// The clearance of a placement that some other computation gave, mm: never above the exact one, for any
/// outlines within the reading errors of the two given.
[[nodiscard]] double safe_clearance(const locate::ConvexOutline& part, const locate::ConvexOutline& blank,
                                    const locate::Placement& placement);

}  // namespace lekalo::jobs
