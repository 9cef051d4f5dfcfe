#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::cli {

/// A file as regions of lines and arcs, ready for the solver.
struct Shape {
  std::vector<geom::Region> regions;  ///< mm
  double tolerance = 0;               ///< the true outline is within this of the regions', mm
  std::vector<std::string> notices;
};

/// Whether the bytes are JSON in the region form (docs/formats.md) of a shape that is not a convex polygon:
/// arcs, holes, several pieces, or a corner inwards.
[[nodiscard]] bool needs_regions(std::string_view bytes, const std::string& path);

/// Reads a region file, or the points of any contour file as one outline without holes. bad_input where
/// outlines cross or touch, with the place.
[[nodiscard]] Result<Shape> read_shape(std::string_view bytes, const std::string& path,
                                       std::optional<LengthUnit> unit);

}  // namespace lekalo::cli
