#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "decimal.hpp"
#include "lekalo/base/error.hpp"

namespace lekalo::io {

/// A line of a text file of points (docs/formats.md): two or three numbers, or in space a point and a
/// direction, whose numbers have no unit.
struct TextRow {
  Millimetres numbers[6];
  std::size_t count = 0;     ///< 2 or 3, or 3 or 6 in space
  std::size_t line = 0;      ///< 1-based
  bool after_a_gap = false;  ///< an empty line (not a comment) stands between this row and the one before
};

/// Calls take(row) for every point of the text, until it fails; in space a point has three numbers, or six
/// with a direction. Adds a notice for a header that holds digits. Fails with ErrorCode::bad_input and a
/// sentence that names file and line.
[[nodiscard]] Result<void> read_text_rows(std::string_view bytes, const std::string& name, DecimalFactor unit,
                                          const std::function<Result<void>(const TextRow&)>& take,
                                          std::vector<std::string>& notices, bool in_space = false);

}  // namespace lekalo::io
