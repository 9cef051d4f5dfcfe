#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// A file as regions of lines and arcs, ready for the solver.
struct Shape {
  std::vector<geom::Region> regions;  ///< mm
  double tolerance = 0;               ///< the true outline is within this of the regions', mm
  std::vector<std::string> labels;    ///< of every edge: its layer, or the name of its primitive; "" for none
  std::vector<geom::Edge> open;       ///< edges that a region file says are no walls, as they are written
  std::vector<std::string> notices;
  std::optional<io::ScanRecord> scan;  ///< of a blank that was measured
};

enum class Need {
  convex_contour,  ///< one convex polygon, or a file that its reader has the better words for
  outline,         ///< points along an outline that is not convex
  regions          ///< arcs, holes, pieces, primitives, layers of a drawing, a scan
};
/// How a file has to be placed.
[[nodiscard]] Need need_of(std::string_view bytes, const std::string& path, const ShapeOptions& options);

/// Reads regions, trees of primitives, drawings, points along one outline, or a scan. bad_input where
/// outlines cross or touch, with the place.
[[nodiscard]] Result<Shape> read_shape(std::string_view bytes, const std::string& path,
                                       const ShapeOptions& options);

}  // namespace lekalo::cli
