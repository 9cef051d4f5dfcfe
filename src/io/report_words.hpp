#pragma once

#include <string>
#include <vector>

#include "lekalo/io/result_json.hpp"

namespace lekalo::io::detail {

/// What is proved and where the proof is, one sentence each; clearances rounded down, bounds up.
[[nodiscard]] std::vector<std::string> proof_sentences(const LocateDocument& document, int decimals);

/// What the result takes for granted and where it was told to look.
[[nodiscard]] std::vector<std::string> assumption_sentences(const LocateDocument& document, int decimals);

}  // namespace lekalo::io::detail
