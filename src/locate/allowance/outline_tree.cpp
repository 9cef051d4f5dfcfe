#include "outline_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lekalo/geom/distance.hpp"
#include "lekalo/geom/predicates.hpp"

namespace lekalo::locate::detail {
namespace {

using geom::Box;
using geom::Point;

double distance_to_box(Point p, const Box& box) {
  return geom::norm({std::max({box.low.x - p.x, p.x - box.high.x, 0.0}),
                     std::max({box.low.y - p.y, p.y - box.high.y, 0.0})});
}

/// Returns the largest coordinate difference between p and a point of the box.
double reach(Point p, const Box& box) {
  return std::max({std::abs(p.x - box.low.x), std::abs(p.x - box.high.x), std::abs(p.y - box.low.y),
                   std::abs(p.y - box.high.y), box.high.x - box.low.x, box.high.y - box.low.y});
}

}  // namespace

OutlineTree::OutlineTree(geom::Ring ring) : ring_(std::move(ring)) {
  nodes_.reserve(2 * ring_.size());
  build(0, ring_.size());
}

std::size_t OutlineTree::build(std::size_t first, std::size_t last) {
  const std::size_t self = nodes_.size();
  nodes_.push_back({box_of(ring_[first], end_of(first)), first, last, 0});
  if (last - first == 1) return self;
  const std::size_t middle = first + (last - first) / 2;
  build(first, middle);
  const std::size_t right = build(middle, last);
  nodes_[self].right = right;
  nodes_[self].box = joined(nodes_[self + 1].box, nodes_[right].box);
  return self;
}

double OutlineTree::signed_distance(Point p) const {
  // Distances carry a rounding error that box distances do not share. So a box is left out only when it is
  // farther by more than that error, and the answer is the least of all edges, bit for bit.
  const double margin = 2 * geom::kDistanceError * reach(p, nodes_[0].box);
  double least = std::numeric_limits<double>::infinity();
  nearest(0, distance_to_box(p, nodes_[0].box), p, margin, least);
  bool on_outline = false;
  const bool inside = crossed_odd(0, p, on_outline);
  if (on_outline) return 0;
  return inside ? least : -least;
}

void OutlineTree::nearest(std::size_t node, double box_distance, Point p, double margin,
                          double& least) const {
  const Node& n = nodes_[node];
  if (box_distance > least + margin) return;
  if (n.right == 0) {
    least = std::min(least, geom::distance_to_segment(p, ring_[n.first], end_of(n.first)));
    return;
  }
  const double left = distance_to_box(p, nodes_[node + 1].box);
  const double right = distance_to_box(p, nodes_[n.right].box);
  if (left <= right) {
    nearest(node + 1, left, p, margin, least);
    nearest(n.right, right, p, margin, least);
  } else {
    nearest(n.right, right, p, margin, least);
    nearest(node + 1, left, p, margin, least);
  }
}

bool OutlineTree::crossed_odd(std::size_t node, Point p, bool& on_outline) const {
  const Node& n = nodes_[node];
  if (p.y < n.box.low.y || p.y > n.box.high.y || p.x > n.box.high.x) return false;
  // By the half-open rule an edge crosses the height of p when just one of its ends lies above. A run that is
  // wholly to the right crosses the ray an odd number of times when its two ends lie on different sides.
  const Point from = ring_[n.first], to = end_of(n.last - 1);
  if (p.x < n.box.low.x) return (from.y > p.y) != (to.y > p.y);
  if (n.right != 0) return crossed_odd(node + 1, p, on_outline) != crossed_odd(n.right, p, on_outline);
  const int side = geom::orientation(from, to, p);
  if (side == 0) {
    // The point is within the box of the edge and on its line.
    on_outline = true;
    return false;
  }
  const bool upwards = to.y > p.y;
  return (from.y > p.y) != upwards && (side > 0) == upwards;
}

}  // namespace lekalo::locate::detail
