#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lekalo::nc {

/// Editors put it before a text in UTF-8.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// A program in the language of a control that is not read here, recognised by words that no other has.
struct ForeignProgram {
  std::string control, word;
  std::size_t line = 0;
};

/// Recognises programs of Heidenhain and Siemens controls.
[[nodiscard]] std::optional<ForeignProgram> foreign_program(std::string_view text);

}  // namespace lekalo::nc
