#pragma once

#include <string_view>
#include <vector>

#include "io/drawing/drawn_shapes.hpp"
#include "scanner.hpp"

namespace lekalo::io::detail {

/// A piece of a path in user units, as the file has it.
struct PathSegment {
  enum class Kind { line, quadratic, cubic, arc };
  Kind kind = Kind::line;
  BoundedPoint from, first, second, to;  ///< control points: one for a quadratic, two for a cubic
  Bounded rx, ry, rotation_deg;          ///< of an arc; radii not below 0
  bool large = false, sweep = false;     ///< sweep: counter-clockwise where y is up
};

/// Path data, absolute, without pieces of no length; closed subpaths end exactly where they began. A closing
/// line shorter than its ends' errors is left out, and the end before it moved.
[[nodiscard]] Read<std::vector<PathSegment>> read_svg_path(std::string_view data);

/// The shape of a segment; nullopt where it has no length.
[[nodiscard]] std::optional<BoundedShape> shape_of(const PathSegment& segment);

}  // namespace lekalo::io::detail
