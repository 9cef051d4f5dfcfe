#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "io/text/decimal.hpp"
#include "io/text/refusal.hpp"
#include "lekalo/io/contour/contour_file.hpp"

namespace lekalo::io {

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

/// The readers, one for each format. `bytes` has no byte order mark; the caller checks that there are points
/// at all.
[[nodiscard]] Result<ContourFile> read_text_contour(std::string_view bytes, const std::string& name,
                                                    LengthUnit unit);
[[nodiscard]] Result<ContourFile> read_json_contour(std::string_view bytes, const std::string& name,
                                                    std::optional<LengthUnit> user_says);
[[nodiscard]] Result<ContourFile> read_dxf_contour(std::string_view bytes, const std::string& name,
                                                   std::optional<LengthUnit> user_says);

}  // namespace lekalo::io
