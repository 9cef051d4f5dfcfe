#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/verify/simulate.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// Programs that ran before, read.
struct EarlierPrograms {
  std::vector<EarlierFile> files;
  std::vector<std::string> texts;
  nlohmann::ordered_json inputs = nlohmann::ordered_json::array();  ///< of a report

  /// For the checker; of the texts here.
  [[nodiscard]] std::vector<verify::EarlierProgram> programs() const;
};

[[nodiscard]] Result<EarlierPrograms> read_earlier(const std::vector<EarlierFile>& files);

}  // namespace lekalo::cli
