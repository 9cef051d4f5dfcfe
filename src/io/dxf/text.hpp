#pragma once

#include <string>
#include <string_view>

namespace lekalo::io {

/// Names compare without the case of A to Z in DXF.
[[nodiscard]] std::string folded(std::string_view name);

/// A name of a file as UTF-8: bytes that are UTF-8 as they are, others by `code_page` ("ANSI_1251", "dos850";
/// the word of $DWGCODEPAGE; Western European if it is empty or not known), \U+XXXX resolved. What no code
/// page explains stands as \xNN.
[[nodiscard]] std::string text_of_name(std::string_view name, std::string_view code_page);

/// A name from the file for a message or a count: as it is if it is short and plain ASCII, else an excerpt.
[[nodiscard]] std::string shown(std::string_view name);

}  // namespace lekalo::io
