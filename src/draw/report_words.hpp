#pragma once

#include <string>
#include <vector>

#include "lekalo/io/locate/result_json.hpp"

namespace lekalo::draw {

/// Says what is proved and where the proof is, one sentence each; clearances are rounded down, bounds up.
[[nodiscard]] std::vector<std::string> proof_sentences(const io::LocateDocument& document, int decimals);

/// Says what the result takes for granted and where it was told to look.
[[nodiscard]] std::vector<std::string> assumption_sentences(const io::LocateDocument& document, int decimals);

/// Begins with a capital letter and ends with a full stop what a result says without them.
[[nodiscard]] std::string as_sentence(std::string text);

}  // namespace lekalo::draw
