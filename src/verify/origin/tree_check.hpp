#pragma once

#include <compare>
#include <set>
#include <string>
#include <vector>

#include "tree.hpp"

namespace lekalo::verify {

/// A side of a primitive.
struct SideOfTree {
  std::size_t primitive, side;
  friend auto operator<=>(const SideOfTree&, const SideOfTree&) = default;
};

struct TreeVerdict {
  /// A place where the region used is not what the tree means; empty where there is none.
  std::string fault;
  /// A place where that is not shown; empty where all is.
  std::string open;
  /// The sides of primitives along which each written edge of the region runs.
  std::vector<std::set<SideOfTree>> along;
};

/// Says whether `used` is what the tree means: every stretch of its outline runs along one of a primitive
/// with material of the tree on the inner side and none on the outer, and every stretch of a primitive that
/// does not run along this outline has the same on both sides. `reach` is how far apart the two may lie, mm.
[[nodiscard]] TreeVerdict check_tree(const Tree& tree, const Shape& used, double reach);

}  // namespace lekalo::verify
