#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lekalo::solid {

/// Sets of triangles that hang together, each triangle with whether it is turned against the first of its
/// set.
class TurnedSets {
 public:
  explicit TurnedSets(std::size_t count) : parent_(count), against_(count, 0) {
    for (std::uint32_t i = 0; i < count; ++i) parent_[i] = i;
  }

  /// The set of a triangle, named by one of it, and whether it is turned against that one.
  std::pair<std::uint32_t, bool> find(std::uint32_t i) {
    // First up to the root, then the same way again, and all that lies on it points to the root.
    std::uint32_t root = i;
    bool against = false;
    for (; parent_[root] != root; root = parent_[root]) against ^= against_[root] != 0;
    bool left = against;
    while (parent_[i] != root && i != root) {
      const std::uint32_t next = parent_[i];
      const bool step = against_[i] != 0;
      parent_[i] = root;
      against_[i] = left ? 1 : 0;
      left ^= step;
      i = next;
    }
    return {root, against};
  }

  /// Makes one set of two. Returns false where they were one and contradict.
  bool unite(std::uint32_t i, std::uint32_t j, bool against) {
    const auto [a, a_against] = find(i);
    const auto [b, b_against] = find(j);
    const bool turned = against ^ a_against ^ b_against;
    if (a == b) return !turned;
    // The root is the first triangle, so that the answer does not depend on the order of edges.
    parent_[std::max(a, b)] = std::min(a, b);
    against_[std::max(a, b)] = turned ? 1 : 0;
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<char> against_;
};

}  // namespace lekalo::solid
