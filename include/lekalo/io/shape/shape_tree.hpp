#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::io {

/// How deep a tree of shapes may be, and how many primitives it may have, half-planes among them. Each of
/// those meets nearly every other.
inline constexpr std::size_t kDeepestShapeTree = 64;
inline constexpr std::size_t kMostPrimitives = 10'000;
inline constexpr std::size_t kMostHalfPlanes = 1'000;
/// ShapeFile::name_of_edge where neither the primitive of an edge nor a node above it has a name.
inline constexpr std::uint32_t kNoName = 0xffffffff;

/// The regions that a tree of primitives and Booleans describes, millimetres.
struct ShapeFile {
  std::string name;                          ///< as given, for messages
  LengthUnit unit = LengthUnit::millimetre;  ///< of the file
  std::vector<geom::Region> regions;         ///< as combine() gives them; never empty
  /// mm: the outlines of `regions` and those that the decimals of the file mean lie within this of each
  /// other, but for pieces and gaps thinner than twice this, which may be missing or filled. Reading,
  /// transforms and Booleans counted.
  double tolerance = 0;
  std::vector<std::string> names;  ///< given in the file, each once, in the order of their first use
  /// For every edge the name of the primitive that it comes from, or of the nearest node above it that has
  /// one; into `names`, or kNoName. Booleans keep no record of this: an edge
  /// counts to the first primitive of the file with an edge on the same line or circle at its middle, in the
  /// same direction.
  std::vector<std::uint32_t> name_of_edge;
};

/// Reads a part given as a Boolean tree of primitives (docs/formats.md): `{"units", "shape": node}`. `unit`
/// is what the user said, and applies where the file does not say (millimetres if neither does); a file that
/// says otherwise is refused.
///
/// Half-planes have no end; they count where something else bounds the result, and are cut off beyond it.
///
/// Fails with ErrorCode::bad_input and one sentence that names the file and the place in the tree
/// ("shape.difference[1].circle"): words it does not know, numbers out of range, outlines that cross
/// themselves, a result that is empty or has no end, a tree beyond the limits above.
/// Laws (tests/property/io_shape_tree_test.cpp): a point further than `tolerance` from the edges of all
/// primitives is in the regions exactly when the Boolean of its being in the primitives is true.
/// Cost: that of one combine() for each node (boolean.hpp).
[[nodiscard]] Result<ShapeFile> parse_shape_tree(std::string_view bytes, const std::string& name,
                                                 std::optional<LengthUnit> unit = std::nullopt);

}  // namespace lekalo::io
