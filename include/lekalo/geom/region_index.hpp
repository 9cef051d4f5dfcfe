#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

/// The edges of regions in order, with a tree of boxes over them: neighbours along a contour are neighbours
/// in the plane, so the order of their numbers (Region) is itself the tree. Building: O(n); memory: about 200
/// bytes an edge.
class RegionIndex {
 public:
  /// \pre regions made by make_region, of disjoint insides; fewer than 2^31 edges
  explicit RegionIndex(const std::vector<Region>& regions);

  [[nodiscard]] const std::vector<Curve>& curves() const noexcept { return curves_; }
  /// The first edge of each contour, and the number of edges last.
  [[nodiscard]] const std::vector<std::uint32_t>& contour_starts() const noexcept { return contour_starts_; }
  [[nodiscard]] Box bounds() const noexcept { return nodes_.empty() ? Box{} : nodes_.front().box; }

  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    Point point;
    std::uint32_t edge = 0;
  };
  /// Returns the boundary point nearest to p. O(log n) for most points, O(n) for a centre of symmetry.
  [[nodiscard]] Nearest nearest(Point p) const;
  /// Does the same, beginning at an edge that is likely near.
  [[nodiscard]] Nearest nearest(Point p, std::uint32_t likely) const;

  /// Says whether the material holds p. Within kEdgeDistanceError of the boundary, and half the difference of
  /// an arc's radii where it is one, either answer may come. O(log n + edges that a ray to the right meets).
  [[nodiscard]] bool contains(Point p) const;

  /// Calls visit(edge) for every edge whose box comes within limit of the disc about centre, nearest boxes
  /// first at every branching; `limit` may shrink on the way.
  template <class Visit>
  void visit_within(Point centre, double radius, const double& limit, Visit&& visit) const {
    if (!nodes_.empty()) descend(0, centre, radius, limit, visit);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t begin = 0, end = 0;  ///< edges
    /// The node of the right child, or 0 in a leaf; the left child is the next node.
    std::uint32_t right = 0;
  };
  static constexpr std::uint32_t kLeaf = 2;

  std::uint32_t build(std::uint32_t begin, std::uint32_t end);
  /// Returns the nearest boundary point that is nearer than `best`, or `best`.
  [[nodiscard]] Nearest nearer(Point p, Nearest best) const;

  [[nodiscard]] static double squared_distance(const Box& box, Point p) noexcept {
    const double left = box.low.x - p.x, right = p.x - box.high.x, below = box.low.y - p.y,
                 above = p.y - box.high.y;
    const double dx = left > 0 ? left : (right > 0 ? right : 0),
                 dy = below > 0 ? below : (above > 0 ? above : 0);
    return dx * dx + dy * dy;
  }

  template <class Visit>
  void descend(std::uint32_t at, Point centre, double radius, const double& limit, Visit&& visit) const {
    const Node& node = nodes_[at];
    if (node.right == 0) {
      for (std::uint32_t edge = node.begin; edge < node.end; ++edge) visit(edge);
      return;
    }
    const std::uint32_t left = at + 1, right = node.right;
    const double to_left = squared_distance(nodes_[left].box, centre),
                 to_right = squared_distance(nodes_[right].box, centre);
    const auto reached = [&](double squared) {
      const double reach = limit + radius;
      return squared <= reach * reach;
    };
    if (to_left <= to_right) {
      if (reached(to_left)) descend(left, centre, radius, limit, visit);
      if (reached(to_right)) descend(right, centre, radius, limit, visit);
    } else {
      if (reached(to_right)) descend(right, centre, radius, limit, visit);
      if (reached(to_left)) descend(left, centre, radius, limit, visit);
    }
  }

  [[nodiscard]] int crossings_right_of(std::uint32_t at, Point p) const;

  std::vector<Curve> curves_;
  std::vector<std::uint32_t> contour_starts_ = {0};
  std::vector<Node> nodes_;  ///< preorder
};

}  // namespace lekalo::geom
