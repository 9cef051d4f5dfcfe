#pragma once

#include <vector>

#include "lekalo/jobs/simulate.hpp"
#include "lekalo/verify/simulate.hpp"

namespace lekalo::jobs {

/// Programs that ran before, as the checker takes them. They refer to the bytes of `earlier`.
[[nodiscard]] inline std::vector<verify::EarlierProgram> earlier_documents(
    const std::vector<EarlierProgram>& earlier) {
  std::vector<verify::EarlierProgram> documents;
  for (const EarlierProgram& before : earlier)
    documents.push_back({{before.program.name, before.program.bytes}, before.tool_diameter});
  return documents;
}

}  // namespace lekalo::jobs
