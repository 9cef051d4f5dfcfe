#include "tree_value.hpp"

namespace lekalo::verify {

TreeValue::TreeValue(const Tree& tree) : nodes_(tree.nodes.size()), node_of_(tree.primitives.size()) {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Tree::Node& node = tree.nodes[n];
    Node& made = nodes_[n];
    made.kind = node.kind;
    if (node.kind == Tree::Kind::primitive) {
      node_of_[node.primitive] = n;
      if (tree.primitives[node.primitive].half_plane) made.value = In::open;
    }
    // Children stand before their node, so that their values are known.
    for (std::size_t k = 0; k < node.children.size(); ++k) {
      Node& child = nodes_[node.children[k]];
      child.parent = n;
      child.is_first_of_difference = node.kind == Tree::Kind::subtract && k == 0;
      if (child.is_first_of_difference)
        made.first = child.value;
      else
        ++made.count[index(child.value)];
    }
    made.value = value_of(made);
  }
}

In TreeValue::value_of(const Node& node) {
  const std::size_t no = node.count[index(In::no)], yes = node.count[index(In::yes)],
                    open = node.count[index(In::open)];
  switch (node.kind) {
    case Tree::Kind::unite:
      return yes > 0 ? In::yes : (open > 0 ? In::open : In::no);
    case Tree::Kind::intersect:
      return no > 0 ? In::no : (open > 0 ? In::open : In::yes);
    case Tree::Kind::subtract:
      if (yes > 0 || node.first == In::no) return In::no;
      return open > 0 ? In::open : node.first;
    case Tree::Kind::primitive:
      break;
  }
  return node.value;
}

void TreeValue::put(std::size_t n, In value) {
  while (nodes_[n].value != value) {
    const In before = nodes_[n].value;
    nodes_[n].value = value;
    const std::size_t parent = nodes_[n].parent;
    if (parent == kNoNode) return;
    Node& above = nodes_[parent];
    if (nodes_[n].is_first_of_difference)
      above.first = value;
    else
      --above.count[index(before)], ++above.count[index(value)];
    n = parent;
    value = value_of(above);
  }
}

void TreeValue::set(std::size_t primitive, In value) {
  const std::size_t node = node_of_[primitive];
  if (nodes_[node].value == value) return;
  said_.push_back({primitive, nodes_[node].value});
  put(node, value);
}

void TreeValue::take_back(std::size_t said) {
  while (said_.size() > said) {
    put(node_of_[said_.back().primitive], said_.back().before);
    said_.pop_back();
  }
}

}  // namespace lekalo::verify
