#pragma once

#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"

namespace lekalo::io {

/// The bytes with which a binary DXF begins.
inline constexpr std::string_view kBinaryDxf{"AutoCAD Binary DXF\r\n\x1a\0", 22};

/// The groups of a binary DXF as the text that the same program would have written: numbers are the shortest
/// decimals that read back to the same doubles, and lines are counted as in that text. Codes of one byte
/// (R13 and before) and of two are told apart by the first group. Fails with ErrorCode::bad_input where the
/// file ends within a group. \pre bytes begin with kBinaryDxf
[[nodiscard]] Result<std::string> text_of_binary_dxf(std::string_view bytes, const std::string& name);

}  // namespace lekalo::io
