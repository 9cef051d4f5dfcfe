#pragma once

#include <string>
#include <string_view>

namespace lekalo::io {

/// Quotes text of a file for a message: at most 40 characters, and bytes that cannot be printed as \xNN.
[[nodiscard]] std::string excerpt(std::string_view text);
}  // namespace lekalo::io
