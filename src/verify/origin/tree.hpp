#pragma once

#include <string>
#include <vector>

#include "lekalo/base/units.hpp"
#include "verify/read/fields.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// A primitive of a tree, after all the maps above it, mm. A half-plane is one line, with the material on
/// its left.
struct Primitive {
  Shape shape;
  bool half_plane = false;
  /// Its name, or that of the nearest shape around it that has one.
  std::string name;
};

/// A part as a tree of primitives (docs/formats.md).
struct Tree {
  enum class Kind { primitive, unite, intersect, subtract };
  struct Node {
    Kind kind = Kind::primitive;
    std::size_t primitive = 0;
    std::vector<std::size_t> children;
  };
  std::vector<Primitive> primitives;
  /// The children of a node stand before it; the last is the whole.
  std::vector<Node> nodes;
};

/// Reads the member `shape` of a file. The complaint names the place.
[[nodiscard]] Tree read_tree(Json shape, LengthUnit unit, std::string& complaint);

}  // namespace lekalo::verify
