#pragma once

#include <string>
#include <string_view>

namespace lekalo::io {

/// Text of a file for a message: at most 40 characters, quoted, what cannot be printed as \xNN.
[[nodiscard]] std::string excerpt(std::string_view text);
}  // namespace lekalo::io
