#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/io/drawing/drawing.hpp"
#include "lekalo/io/text/format.hpp"

namespace lekalo::io {

/// A format of drawings as a value: how its files are told from others, and what reads them.
/// docs/design/extending.md shows how one is added.
struct DrawingFormat {
  FileFormat file;
  /// Reads the curves in file order. `unit` is what the user said, and applies where the file does not say; a
  /// file that says otherwise is refused. Fails with ErrorCode::bad_input and one sentence that names file,
  /// place, what stands there and the way out. What is not read is counted in Drawing::unread.
  Result<Drawing> (*parse)(std::string_view bytes, const std::string& name, std::optional<LengthUnit> unit);
  /// Handles are words that people gave (the id of an SVG element) and name parts; otherwise layers do.
  bool handles_are_names = false;
};

}  // namespace lekalo::io
