#pragma once

#include <vector>

#include "shape.hpp"

namespace lekalo::verify {

/// Returns the number of the written edge that each side of a shape is of. An arc that is joined to its ends
/// stands between the two lines that join it, which are of its edge.
[[nodiscard]] inline std::vector<std::size_t> edge_of_side(const Shape& shape) {
  std::vector<std::size_t> edges;
  for (std::size_t edge = 0; edges.size() < shape.sides.size(); ++edge)
    edges.insert(edges.end(), shape.sides[edges.size()].written ? 1 : 3, edge);
  return edges;
}

}  // namespace lekalo::verify
