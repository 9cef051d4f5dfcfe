#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tree.hpp"

namespace lekalo::verify {

/// Our knowledge of the material at a place.
enum class In { no, yes, open };

/// The material of a tree at a place, from that of its primitives. Most primitives do not hold a place, so
/// that only what the others make of the nodes above them is worked out: each node counts its children by
/// what they are.
class TreeValue {
 public:
  explicit TreeValue(const Tree& tree);

  /// Says what a primitive is at the place; at first it is `no`, and a half-plane, which is far from no
  /// place, `open`.
  void set(std::size_t primitive, In value);
  /// Takes back all that was set since `said()` was so large.
  [[nodiscard]] std::size_t said() const { return said_.size(); }
  void take_back(std::size_t said);
  [[nodiscard]] In value() const { return nodes_.back().value; }

 private:
  static constexpr std::size_t kNoNode = static_cast<std::size_t>(-1);
  struct Node {
    Tree::Kind kind = Tree::Kind::primitive;
    std::size_t parent = kNoNode;
    /// The first child of a difference stands apart from those that are taken away.
    bool is_first_of_difference = false;
    In first = In::no;
    /// How many of the other children are `no`, `yes` and `open`.
    std::array<std::size_t, 3> count{};
    In value = In::no;
  };
  [[nodiscard]] static In value_of(const Node& node);
  [[nodiscard]] static std::size_t index(In value) { return static_cast<std::size_t>(value); }
  void put(std::size_t node, In value);

  std::vector<Node> nodes_;
  /// A primitive, and its value before another was set.
  struct Said {
    std::size_t primitive;
    In before;
  };
  std::vector<std::size_t> node_of_;  ///< by primitive
  std::vector<Said> said_;            ///< in order
};

}  // namespace lekalo::verify
