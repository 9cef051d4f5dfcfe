#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "contour_number.hpp"
#include "lekalo/io/contour_file.hpp"

namespace lekalo::io {

[[nodiscard]] inline tl::unexpected<Error> refuse(const std::string& name, const std::string& sentence) {
  return failure(ErrorCode::bad_input, fmt::format("{}: {}", name, sentence));
}

[[nodiscard]] inline tl::unexpected<Error> refuse_line(const std::string& name, std::size_t line,
                                                       const std::string& sentence) {
  return failure(ErrorCode::bad_input, fmt::format("{}: line {}: {}", name, line, sentence));
}

/// The ending of a file's name in lower case, with its dot; empty without.
[[nodiscard]] std::string ending_of(const std::string& name);

/// Adds a point to the file; false when it holds kMostContourPoints already.
[[nodiscard]] inline bool append_point(ContourFile& file, Millimetres x, Millimetres y, std::size_t place) {
  if (file.points.size() == kMostContourPoints) return false;
  file.points.push_back({x.value, y.value});
  file.places.push_back(place);
  file.coordinate_error = std::max({file.coordinate_error, x.error, y.error});
  return true;
}

[[nodiscard]] inline std::string too_many_points() {
  return fmt::format("more than {} points; thin the contour out first", kMostContourPoints);
}

/// Why bytes are not text that can be read, whatever the file's name says: a binary DXF, a DWG, UTF-16, zero
/// bytes; empty for anything else.
[[nodiscard]] std::string wrong_encoding(std::string_view bytes);

/// The unit that holds when the file says one (or nothing) and the user says one (or nothing).
[[nodiscard]] Result<LengthUnit> agree_on_unit(const std::string& name, std::optional<LengthUnit> file_says,
                                               const std::string& where, std::optional<LengthUnit> user_says);

/// The readers, one a format. `bytes` is without byte order mark; whether there are points at all is checked
/// by the caller.
[[nodiscard]] Result<ContourFile> read_text_contour(std::string_view bytes, const std::string& name,
                                                    LengthUnit unit);
[[nodiscard]] Result<ContourFile> read_json_contour(std::string_view bytes, const std::string& name,
                                                    std::optional<LengthUnit> user_says);
[[nodiscard]] Result<ContourFile> read_dxf_contour(std::string_view bytes, const std::string& name,
                                                   std::optional<LengthUnit> user_says);

}  // namespace lekalo::io
