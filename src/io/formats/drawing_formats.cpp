#include "lekalo/io/formats/drawing_formats.hpp"

#include <array>

/// Each name stands for a format, the value of `drawing_NAME()`, which the file of its reader defines.
#define LEKALO_DRAWINGS(each) each(dxf) each(svg)

#define LEKALO_DECLARED(name) DrawingFormat drawing_##name();
#define LEKALO_MADE(name) drawing_##name(),

namespace lekalo::io {

LEKALO_DRAWINGS(LEKALO_DECLARED)

std::span<const DrawingFormat> drawing_formats() noexcept {
  static const std::array all{LEKALO_DRAWINGS(LEKALO_MADE)};
  return all;
}

const DrawingFormat* drawing_format_by_ending(const std::string& name) {
  for (const DrawingFormat& format : drawing_formats())
    if (format.file.is_named_so(name)) return &format;
  return nullptr;
}

const DrawingFormat* drawing_format_by_content(std::string_view bytes) {
  for (const DrawingFormat& format : drawing_formats())
    if (format.file.begins_so(bytes)) return &format;
  return nullptr;
}

std::string drawing_names(std::string_view separator, std::string_view last_separator) {
  std::string list;
  for (const DrawingFormat& format : drawing_formats()) {
    if (!list.empty()) list += &format == &drawing_formats().back() ? last_separator : separator;
    list += format.file.name;
  }
  return list;
}

std::string drawing_endings(std::string_view separator) {
  std::string list;
  for (const DrawingFormat& format : drawing_formats())
    for (const std::string_view ending : format.file.endings) {
      if (ending.empty()) continue;
      if (!list.empty()) list += separator;
      list += ending;
    }
  return list;
}

}  // namespace lekalo::io
