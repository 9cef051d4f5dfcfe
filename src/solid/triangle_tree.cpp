#include "lekalo/solid/triangle_tree.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/solid/predicates.hpp"
#include "triangle.hpp"

namespace lekalo::solid {
namespace {

/// Positions, differences, and products of two with a unit vector are rounded some twenty times on the way to
/// a distance, each time by 2^-53 of the largest coordinate at most.
constexpr double kRounding = 0x1p-48;

/// The square of the distance from p to a box, within a few roundings of itself.
double squared_gap(const Box& box, Vector p) {
  const double x = std::max({0.0, box.low.x - p.x, p.x - box.high.x});
  const double y = std::max({0.0, box.low.y - p.y, p.y - box.high.y});
  const double z = std::max({0.0, box.low.z - p.z, p.z - box.high.z});
  return x * x + y * y + z * z;
}

/// No point of the triangle is nearer to p than this, whatever point q of it is: all lie behind the plane
/// across the way from p to q through the foremost corner.
double least_distance(const Corners& t, Vector p, Vector q) {
  const Vector way = p - q;
  const double length = norm(way);
  if (!(length > 0)) return 0;
  return std::min({dot(way, p - t[0]), dot(way, p - t[1]), dot(way, p - t[2])}) / length;
}

/// A point of a triangle, and a bound below which no point of it is near to p.
struct Found {
  Vector place;
  double squared, low;
};
Found find(const Corners& t, Vector p, double rounding) {
  const auto found = [&](Vector q) { return Found{q, dot(p - q, p - q), least_distance(t, p, q)}; };
  const Found first = found(nearest_point(t, p));
  if (first.low >= std::sqrt(first.squared) - rounding) return first;
  // The triangle is so thin that its nearest point was not found.
  Found better = found(nearest_on_edges(t, p));
  better.low = std::max(better.low, first.low);
  return better.squared < first.squared ? better : Found{first.place, first.squared, better.low};
}

geom::Point from_above(Vector p) { return {p.x, p.y}; }

/// Says if the triangle, seen from above, covers p moved a little along y and by far less along x.
bool covers(const Corners& t, Vector p) {
  bool inside = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector &from = t[k], &to = t[(k + 1) % 3];
    const bool upwards = to.y > p.y;
    if ((from.y > p.y) == upwards) continue;
    int side = geom::orientation(from_above(from), from_above(to), from_above(p));
    if (side == 0) side = to.x != from.x ? (to.x > from.x ? 1 : -1) : (upwards ? -1 : 1);
    if ((side > 0) == upwards) inside = !inside;
  }
  return inside;
}

/// Says if a way straight up from p, moved so, crosses the triangle.
bool is_above(const std::array<Vector, 3>& t, Vector p) {
  if (!covers(t, p)) return false;
  const int turn = geom::orientation(from_above(t[0]), from_above(t[1]), from_above(t[2]));
  return turn * side_of_plane(t[0], t[1], t[2], p) < 0;
}

}  // namespace

double distance(const Corners& t, Vector p) noexcept {
  const Vector to_inside = p - nearest_point(t, p), to_edges = p - nearest_on_edges(t, p);
  return std::sqrt(std::min(dot(to_inside, to_inside), dot(to_edges, to_edges)));
}

TriangleTree::TriangleTree(const Mesh& mesh, std::uint32_t leaf) {
  std::vector<Corners> all;
  all.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    all.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  order_.resize(all.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  if (all.empty()) return;
  nodes_.reserve(all.size());
  build(0, static_cast<std::uint32_t>(all.size()), leaf, all);
  box_ = nodes_[0].box;
  largest_ = std::max(largest_coordinate(box_.low), largest_coordinate(box_.high));
  corners_.reserve(all.size());
  place_in_order_.resize(all.size());
  for (std::uint32_t k = 0; k < order_.size(); ++k) {
    corners_.push_back(all[order_[k]]);
    place_in_order_[order_[k]] = k;
  }
}

std::uint32_t TriangleTree::build(std::uint32_t begin, std::uint32_t end, std::uint32_t leaf,
                                  const std::vector<Corners>& all) {
  ask(end - begin);
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  Box box, middles;
  const auto middle = [&](std::uint32_t i) { return all[i][0] + all[i][1] + all[i][2]; };
  for (std::uint32_t k = begin; k < end; ++k) {
    for (const Vector p : all[order_[k]]) box.hold(p);
    middles.hold(middle(order_[k]));
  }
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= leaf) return at;
  const Vector spread = middles.high - middles.low;
  const double Vector::*const axis = spread.x >= spread.y && spread.x >= spread.z ? &Vector::x
                                     : spread.y >= spread.z                       ? &Vector::y
                                                                                  : &Vector::z;
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(middle(a).*axis, a) < std::pair(middle(b).*axis, b);
                   });
  build(begin, half, leaf, all);
  const std::uint32_t right = build(half, end, leaf, all);
  nodes_[at].right = right;
  return at;
}

std::vector<std::uint32_t> TriangleTree::patches(std::size_t count) const {
  const auto width = [&](std::uint32_t at) {
    const Vector size = nodes_[at].box.high - nodes_[at].box.low;
    return size.x + size.y + size.z;
  };
  std::vector<std::uint32_t> made;
  if (!nodes_.empty()) made.push_back(0);
  while (made.size() < count) {
    std::size_t largest = made.size();
    for (std::size_t k = 0; k < made.size(); ++k)
      if (nodes_[made[k]].right != 0 && (largest == made.size() || width(made[k]) > width(made[largest])))
        largest = k;
    if (largest == made.size()) break;
    const std::uint32_t at = made[largest];
    made[largest] = at + 1;
    made.push_back(nodes_[at].right);
  }
  std::sort(made.begin(), made.end());
  return made;
}

std::optional<Nearest> TriangleTree::nearest(Vector p, double most, std::optional<std::uint32_t> near) const {
  const double rounding = kRounding * std::max(largest_, largest_coordinate(p));
  Nearest best;
  best.low = std::numeric_limits<double>::infinity();
  bool found = false;
  double squared =
      most < 0x1p500 ? (most + rounding) * (most + rounding) : std::numeric_limits<double>::infinity();
  const auto look = [&](std::uint32_t k) {
    const Found here = find(corners_[k], p, rounding);
    best.low = std::min(best.low, here.low);
    if (here.squared >= squared) return;
    squared = here.squared;
    found = true;
    best.triangle = order_[k];
    best.place = here.place;
  };
  if (near) look(place_in_order_[*near]);
  std::array<std::pair<double, std::uint32_t>, 64> stack;  // a balanced tree of 2^32 triangles is 31 high
  std::size_t size = 0;
  if (!nodes_.empty()) stack[size++] = {squared_gap(nodes_[0].box, p), 0};
  while (size > 0) {
    const auto [gap, at] = stack[--size];
    if (gap >= squared) continue;
    const Node& node = nodes_[at];
    ask();
    if (node.right == 0) {
      for (std::uint32_t k = node.begin; k < node.end; ++k) look(k);
      continue;
    }
    std::pair<double, std::uint32_t> left{squared_gap(nodes_[at + 1].box, p), at + 1},
        right{squared_gap(nodes_[node.right].box, p), node.right};
    if (right.first < left.first) std::swap(left, right);
    if (right.first < squared) stack[size++] = right;
    if (left.first < squared) stack[size++] = left;
  }
  if (!found) return std::nullopt;
  const double distance = std::sqrt(squared);
  best.high = distance + rounding;
  // The triangles that were passed over are farther away than the distance, but for the rounding of its box.
  best.low = std::max(0.0, std::min(best.low, distance) - rounding);
  return best;
}

double TriangleTree::least_sum(Vector p, const std::vector<double>& widths, double times,
                               double least) const {
  const double rounding = kRounding * std::max(largest_, largest_coordinate(p));
  double best = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, std::uint32_t>> open{{squared_gap(nodes_[0].box, p), 0}};
  while (!open.empty()) {
    const auto [gap, at] = open.back();
    open.pop_back();
    if (std::sqrt(gap) + least >= best) continue;
    const Node& node = nodes_[at];
    ask();
    if (node.right == 0) {
      for (std::uint32_t k = node.begin; k < node.end; ++k) {
        const Found here = find(corners_[k], p, rounding);
        best = std::min(best, std::min(here.low, std::sqrt(here.squared)) + times * widths[order_[k]]);
      }
      continue;
    }
    std::pair<double, std::uint32_t> left{squared_gap(nodes_[at + 1].box, p), at + 1},
        right{squared_gap(nodes_[node.right].box, p), node.right};
    if (right.first < left.first) std::swap(left, right);
    open.push_back(right);
    open.push_back(left);
  }
  return best - 2 * rounding;
}

bool TriangleTree::holds(Vector p) const {
  bool inside = false;
  const auto visit = [&](std::uint32_t k) {
    if (is_above(corners_[k], p)) inside = !inside;
  };
  if (!nodes_.empty()) descend(0, visit, p);
  return inside;
}

std::size_t TriangleTree::crossed_above(Vector p, std::vector<std::uint32_t>& triangles) const {
  std::size_t looked = 0;
  const auto visit = [&](std::uint32_t k) {
    ++looked;
    if (is_above(corners_[k], p)) triangles.push_back(order_[k]);
  };
  if (!nodes_.empty()) descend(0, visit, p);
  return looked;
}

template <class Visit>
void TriangleTree::descend(std::uint32_t at, const Visit& visit, Vector p) const {
  const Node& node = nodes_[at];
  if (p.x < node.box.low.x || p.x > node.box.high.x || p.y < node.box.low.y || p.y > node.box.high.y ||
      p.z > node.box.high.z)
    return;
  ask();
  if (node.right == 0) {
    for (std::uint32_t k = node.begin; k < node.end; ++k) visit(k);
    return;
  }
  descend(at + 1, visit, p);
  descend(node.right, visit, p);
}

}  // namespace lekalo::solid
