#pragma once

#include <fmt/core.h>

#include <optional>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"

namespace lekalo::io {

/// The form in which every reader refuses: the file or the place in it, then the sentence.
[[nodiscard]] inline tl::unexpected<Error> refuse(const std::string& name, const std::string& sentence) {
  return failure(ErrorCode::bad_input, fmt::format("{}: {}", name, sentence));
}

[[nodiscard]] inline tl::unexpected<Error> refuse_line(const std::string& name, std::size_t line,
                                                       const std::string& sentence) {
  return failure(ErrorCode::bad_input, fmt::format("{}: line {}: {}", name, line, sentence));
}

/// Says why bytes are not text that can be read, whatever the file's name says: a binary DXF, a DWG, a PDF,
/// an archive, a STEP model, an image, UTF-16, zero bytes; empty for anything else.
[[nodiscard]] std::string wrong_encoding(std::string_view bytes);
/// Says why bytes are not text whatever they are about: UTF-16, zero bytes; empty for anything else.
[[nodiscard]] std::string wrong_characters(std::string_view bytes);

/// The unit that holds when the file says one (or nothing) and the user says one (or nothing).
[[nodiscard]] Result<LengthUnit> agree_on_unit(const std::string& name, std::optional<LengthUnit> file_says,
                                               const std::string& where, std::optional<LengthUnit> user_says);

}  // namespace lekalo::io
