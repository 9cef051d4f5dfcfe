#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/drawing/similarity.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/shape/shape_tree.hpp"
#include "region_reader.hpp"

namespace lekalo::io::detail {

/// Two points of the edge of a half-plane, which lies to the left of the way from one to the other.
struct HalfPlane {
  geom::Point from, to;
};

/// Each of kDeepestShapeTree shapes takes two levels of JSON, and a region in the innermost one a few more;
/// twice as many leave the refusal to the reader of trees, which can say where it is.
inline constexpr std::size_t kDeepestShapeJson = 4 * kDeepestShapeTree;

enum class ShapeKind { primitive, half_plane, unite, intersect, subtract, map };

/// A box around all points that a shape can have, or the word that it has no end.
struct Extent {
  bool bounded = true;  ///< else the box says nothing
  bool empty = false;
  geom::Box box;
};

/// A node of the tree, its numbers read and its primitives made.
struct ShapeNode {
  ShapeKind kind = ShapeKind::primitive;
  std::string where;  ///< file and place in the tree, for messages
  std::uint32_t name = kNoName;
  std::vector<geom::Region> regions;  ///< of a primitive
  HalfPlane half_plane;
  double error = 0;  ///< mm: of a primitive's outline, or of a half-plane's points
  Similarity map;
  std::vector<ShapeNode> children;  ///< one for a map
  Extent extent;
};

/// The primitive named by `word`, whose value is `json`: `regions` or `half_plane` of the node, and its
/// error. Lengths times `scale`. \pre is_primitive(word)
[[nodiscard]] bool is_primitive(std::string_view word);
[[nodiscard]] Result<ShapeNode> read_primitive(const std::string& word, JsonValue json,
                                               const std::string& where, double scale);

/// The number under `key`, times `scale`; refused beyond kLargestMillimetres.
[[nodiscard]] Result<double> read_number(JsonValue json, const std::string& where, const char* key,
                                         double scale);
/// The point [x, y], times `scale`; refused beyond kLargestMillimetres.
[[nodiscard]] Result<geom::Point> place_of(JsonValue json, const std::string& where, double scale);
/// The point under `key`; `otherwise` where there is no such key.
[[nodiscard]] Result<geom::Point> read_place(JsonValue json, const std::string& where, const char* key,
                                             double scale,
                                             std::optional<geom::Point> otherwise = std::nullopt);

struct ShapeTree {
  ShapeNode root;
  std::vector<std::string> names;
};
[[nodiscard]] Result<ShapeTree> read_shape_tree(JsonValue json, const std::string& where, double scale);

/// The extent of the node's shape, from its own numbers and its children's extents.
[[nodiscard]] Extent extent_of(const ShapeNode& node);

/// An edge of a primitive in the coordinates of the result, run through with the material of the result on
/// its left.
struct NamedEdge {
  geom::Edge edge;
  std::uint32_t name = kNoName;
};

struct Evaluated {
  std::vector<geom::Region> regions;
  /// Every edge is within this, mm, of that of an exact primitive; 0 when there are no edges.
  double edge_error = 0;
  /// At least 1: corners are within this many times edge_error of the exact ones; greater where edges meet at
  /// a small angle.
  double sharpness = 1;
  std::vector<NamedEdge> sources;  ///< in the order of the file
};
[[nodiscard]] Result<Evaluated> evaluate(const ShapeTree& tree);

/// The names that ShapeFile::name_of_edge states.
[[nodiscard]] std::vector<std::uint32_t> names_of_edges(const Evaluated& shape);

}  // namespace lekalo::io::detail
