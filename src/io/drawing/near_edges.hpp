#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/edge_distance.hpp"

namespace lekalo::io {

/// Returns the distance of a point from the line or circle that carries a curve, with a sign for its two
/// sides.
[[nodiscard]] double off_carrier(const geom::Curve& curve, geom::Point p);
/// Returns the least and the largest of these distances over all points of a part.
[[nodiscard]] std::pair<double, double> range_off_carrier(const geom::Edge& part, const geom::Curve& curve);
/// Returns how far the points of a part are from a curve at most, where a few of them tell: so a long arc
/// beside another is not cut into short ones. Nothing where they do not.
[[nodiscard]] std::optional<double> farthest_along(const geom::Edge& part, const geom::Curve& curve);

/// Edges with a tree over their boxes, to ask how far others are from them.
class NearEdges {
 public:
  explicit NearEdges(const std::vector<geom::Edge>& edges);

  /// Returns a bound, within `limit` / 1024 of the least, on how far the points of an edge are from these
  /// edges; nothing if some point is farther than `limit`, or may be. Cost: O(log n) for an edge that runs
  /// along one of these, O((length / limit) log n) at worst; each step takes a unit of `work`.
  [[nodiscard]] std::optional<double> farthest(const geom::Edge& edge, double limit, std::size_t& work) const;
  /// Returns the distance of a point from these edges; nothing if that is more than `limit`.
  [[nodiscard]] std::optional<double> distance(geom::Point p, double limit) const;

 private:
  std::vector<geom::Curve> curves_;
  geom::BoxTree tree_;
};

/// The work for all questions about one shape, a second or two.
inline constexpr std::size_t kMostWork = 2'000'000;

/// The two halves of an edge; a full circle is cut at its first point and opposite to it.
struct Bisected {
  geom::Edge first, second;
  geom::Point middle;
  double half_length = 0;  ///< no less than that of each half
};
[[nodiscard]] Bisected bisected(const geom::Edge& edge);

}  // namespace lekalo::io
