#pragma once

#include <string>
#include <string_view>

namespace lekalo::io {

/// Lower-case hexadecimal SHA-256 of the bytes.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace lekalo::io
