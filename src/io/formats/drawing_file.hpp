#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lekalo/io/drawing/drawing.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "lekalo/io/svg/svg.hpp"
#include "lekalo/io/text/format.hpp"

namespace lekalo::io {

/// A drawing of that form; what is no SVG is read as DXF, whose reader has the words to refuse it.
[[nodiscard]] inline Result<Drawing> parse_drawing(Format format, std::string_view bytes,
                                                   const std::string& name, std::optional<LengthUnit> unit) {
  return format == Format::svg ? parse_svg(bytes, name, unit) : parse_dxf(bytes, name, unit);
}

}  // namespace lekalo::io
