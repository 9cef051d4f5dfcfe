#pragma once

#include <optional>
#include <string_view>

namespace lekalo::jobs {

/// The forms of pictures and reports.
enum class PictureForm { svg, png, pdf };

/// The form that the ending of a file's name says: .svg, .png or .pdf; none for others.
[[nodiscard]] std::optional<PictureForm> picture_form(std::string_view name) noexcept;

}  // namespace lekalo::jobs
