#pragma once

#include <string>
#include <vector>

#include "lekalo/jobs/heat_result.hpp"

namespace lekalo::jobs {

/// A corrected program under the name that it is written as.
struct CorrectedFile {
  std::string name;
  const HeatCorrection* correction = nullptr;  ///< none, or one with a program
};

/// Returns the result as a document of the format lekalo-heat.
[[nodiscard]] std::string heat_json(const HeatJob& job, const HeatFound& found,
                                    const std::vector<std::string>& warnings,
                                    const CorrectedFile& corrected = {});

}  // namespace lekalo::jobs
