#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/nc_words.hpp"

namespace lekalo::nc {

/// Puts sentences as comments at the top of a program, behind a first `%` and a program number, in the form
/// that the control reads: capitals, digits, points and dashes, short lines, and the program's own line end.
[[nodiscard]] std::string with_header(std::string_view program, const std::vector<std::string>& sentences,
                                      words::Control control);

}  // namespace lekalo::nc
