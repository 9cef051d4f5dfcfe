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
  /// The control points are one for a quadratic curve, two for a cubic one.
  BoundedPoint from, first, second, to;
  /// The numbers of an arc; radii are not below 0.
  Bounded rx, ry, rotation_deg;
  /// `sweep` means counter-clockwise where y is up.
  bool large = false, sweep = false;
};

/// Step 4 of docs/design/svg.md: reads path data as absolute pieces, without those of no length. Closed
/// subpaths end exactly where they began. A closing line shorter than the errors of its ends is left out, and
/// the end before it is moved.
[[nodiscard]] Read<std::vector<PathSegment>> read_svg_path(std::string_view data);

/// Returns the shape of a segment, or nullopt where it has no length.
[[nodiscard]] std::optional<BoundedShape> shape_of(const PathSegment& segment);

}  // namespace lekalo::io::detail
