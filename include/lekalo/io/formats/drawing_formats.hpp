#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lekalo/io/drawing/drawing_format.hpp"

namespace lekalo::io {

/// The list of all formats of drawings, in the order in which help shows them. What is recognised as a
/// drawing, read as one, or named in help and refusals follows from it.
[[nodiscard]] std::span<const DrawingFormat> drawing_formats() noexcept;

/// The format whose files have names that end so; none: nullptr.
[[nodiscard]] const DrawingFormat* drawing_format_by_ending(const std::string& name);

/// The format whose files begin so; none: nullptr.
[[nodiscard]] const DrawingFormat* drawing_format_by_content(std::string_view bytes);

/// The names of all formats in one text, the last of them after `last_separator`.
[[nodiscard]] std::string drawing_names(std::string_view separator, std::string_view last_separator);

/// The endings of all formats in one text.
[[nodiscard]] std::string drawing_endings(std::string_view separator);

}  // namespace lekalo::io
