#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/contour/contour_file.hpp"
#include "lekalo/io/locate/result_json.hpp"

namespace lekalo::cli {

/// A contour ready for the solver, with the way back to the file.
struct Contour {
  io::ContourFile file;
  geom::ConvexPolygon polygon;
  double coordinate_error = 0;                  ///< mm
  std::vector<std::uint32_t> vertex_in_result;  ///< index in the result document, per polygon vertex
  std::vector<std::uint32_t> edge_in_result;    ///< per polygon edge
  std::vector<std::size_t> dropped;
  std::optional<io::TrimRecord> trim;
  std::vector<std::string> notices;
};

/// The contour in `bytes`; with `trim`, cut inwards to a convex one (its own points then count in the
/// result).
[[nodiscard]] Result<Contour> read_contour(std::string_view bytes, const std::string& path,
                                           std::optional<LengthUnit> unit, std::optional<double> trim);

}  // namespace lekalo::cli
