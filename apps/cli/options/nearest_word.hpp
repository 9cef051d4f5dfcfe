#pragma once

#include <string>
#include <vector>

namespace lekalo::cli {

/// For unknown words: the nearest of `known` when it is near enough to be meant, else empty.
[[nodiscard]] std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace lekalo::cli
