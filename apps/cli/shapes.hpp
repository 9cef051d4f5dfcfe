#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/result_json.hpp"
#include "options.hpp"

namespace lekalo::cli {

/// A file as regions of lines and arcs, ready for the solver.
struct Shape {
  std::vector<geom::Region> regions;  ///< mm
  double tolerance = 0;               ///< the true outline is within this of the regions', mm
  std::vector<std::string> labels;    ///< of every edge: its layer, or the name of its primitive; "" for none
  std::vector<std::string> notices;
  std::optional<io::ScanRecord> scan;  ///< of a blank that was measured
};

/// Whether a file has to be placed as regions: what it holds is not one convex polygon, or is read by what
/// the options say of drawings and scans. A file that cannot be read at all says no: the reader of convex
/// contours has the better words for it.
[[nodiscard]] bool needs_regions(std::string_view bytes, const std::string& path,
                                 const ShapeOptions& options);

/// Reads regions, trees of primitives, drawings, points along one outline, or a scan. bad_input where
/// outlines cross or touch, with the place.
[[nodiscard]] Result<Shape> read_shape(std::string_view bytes, const std::string& path,
                                       const ShapeOptions& options);

}  // namespace lekalo::cli
