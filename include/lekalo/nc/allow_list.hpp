#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::nc {

/// Reads a shop's list of M words that move no axis: one word a line, such as `M130`, and what follows `#`,
/// `;` or `(` is a remark. Returns their numbers.
///
/// bad_input with name and line for anything else, and for words that change what the program means: M2, M6,
/// M30, M60, M70 to M73 and M96 to M99.
[[nodiscard]] Result<std::vector<int>> parse_allow_list(std::string_view text, const std::string& name);

}  // namespace lekalo::nc
