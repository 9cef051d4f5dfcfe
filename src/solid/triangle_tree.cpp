#include "lekalo/solid/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/parallel.hpp"
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

/// Halves triangles along the axis along which their middles are spread most. How many nodes there are below
/// each follows from how many triangles it has, so threads write theirs side by side.
class TriangleTree::Builder {
 public:
  Builder(TriangleTree& tree, const Mesh& mesh, std::uint32_t leaf)
      : tree_(tree), mesh_(mesh), leaf_(leaf), middles_(mesh.triangles.size()) {
    for (std::uint32_t k = 0; k < middles_.size(); ++k) {
      const Corners t = corners(k);
      middles_[k] = {t[0] + t[1] + t[2], k};
    }
  }

  void build(unsigned threads) {
    const auto count = static_cast<std::uint32_t>(middles_.size());
    tree_.nodes_.resize(nodes_of(count).first);
    tree_.order_.resize(count), tree_.place_in_order_.resize(count), tree_.corners_.resize(count);
    // Level by level, as long as there are fewer nodes than threads want; then each thread takes whole nodes.
    std::vector<Below> level{{0, 0, count}}, above;
    const std::size_t least = std::max<std::size_t>(kWorthSharing, leaf_);
    while (threads > 1 && level.size() < kNodesOfThread * threads && count / level.size() > least) {
      std::vector<std::array<Below, 2>> halves(level.size());
      share_out(level.size(), threads, [&](std::size_t k) { halves[k] = halved(level[k]); });
      above.insert(above.end(), level.begin(), level.end());
      level.clear();
      for (const auto& [left, right] : halves) level.insert(level.end(), {left, right});
    }
    share_out(level.size(), threads, [&](std::size_t k) { sort(level[k]); });
    for (std::size_t k = above.size(); k-- > 0;) hold_children(above[k].node);
  }

 private:
  /// Three times the middle of a triangle.
  struct Middle {
    Vector sum;
    std::uint32_t triangle = 0;
  };
  /// A node, and its triangles in leaf order.
  struct Below {
    std::uint32_t node = 0, begin = 0, end = 0;
  };
  /// Threads have so many nodes each, if these have more triangles than that.
  static constexpr std::size_t kNodesOfThread = 4, kWorthSharing = 1'000;

  [[nodiscard]] Corners corners(std::uint32_t triangle) const {
    const Triangle& t = mesh_.triangles[triangle];
    return {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]};
  }

  /// The nodes over so many triangles, and over one more.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> nodes_of(std::uint32_t count) const {
    if (count <= leaf_) return {1, count < leaf_ ? 1 : 3};
    const auto [half, more] = nodes_of(count / 2);
    return count % 2 == 0 ? std::pair{1 + 2 * half, 1 + half + more}
                          : std::pair{1 + half + more, 1 + 2 * more};
  }

  std::array<Below, 2> halved(const Below& of) {
    const std::uint32_t begin = of.begin, end = of.end;
    ask(end - begin);
    Box box;
    for (std::uint32_t k = begin; k < end; ++k) box.hold(middles_[k].sum);
    const Vector spread = box.high - box.low;
    const std::uint32_t half = begin + (end - begin) / 2;
    const auto split = [&](double Vector::*const axis) {
      std::nth_element(middles_.begin() + begin, middles_.begin() + half, middles_.begin() + end,
                       [axis](const Middle& a, const Middle& b) {
                         return a.sum.*axis < b.sum.*axis ||
                                (a.sum.*axis == b.sum.*axis && a.triangle < b.triangle);
                       });
    };
    if (spread.x >= spread.y && spread.x >= spread.z)
      split(&Vector::x);
    else
      split(spread.y >= spread.z ? &Vector::y : &Vector::z);
    const std::uint32_t left = of.node + 1, right = left + nodes_of(half - begin).first;
    tree_.nodes_[of.node] = {{}, begin, end, right};
    return {Below{left, begin, half}, Below{right, half, end}};
  }

  void hold_children(std::uint32_t at) {
    Node& node = tree_.nodes_[at];
    node.box = tree_.nodes_[at + 1].box;
    node.box.hold(tree_.nodes_[node.right].box.low);
    node.box.hold(tree_.nodes_[node.right].box.high);
  }

  void sort(const Below& of) {
    const auto [node, begin, end] = of;
    if (end - begin > leaf_) {
      const auto [left, right] = halved(of);
      sort(left), sort(right);
      return hold_children(node);
    }
    ask(end - begin);
    Box box;
    for (std::uint32_t k = begin; k < end; ++k) {
      const std::uint32_t triangle = middles_[k].triangle;
      tree_.order_[k] = triangle;
      tree_.place_in_order_[triangle] = k;
      for (const Vector p : tree_.corners_[k] = corners(triangle)) box.hold(p);
    }
    tree_.nodes_[node] = {box, begin, end, 0};
  }

  TriangleTree& tree_;
  const Mesh& mesh_;
  std::uint32_t leaf_;
  std::vector<Middle> middles_;
};

TriangleTree::TriangleTree(const Mesh& mesh, std::uint32_t leaf, unsigned threads) {
  if (mesh.triangles.empty()) return;
  Builder(*this, mesh, leaf).build(threads);
  box_ = nodes_[0].box;
  largest_ = std::max(largest_coordinate(box_.low), largest_coordinate(box_.high));
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

Vector TriangleTree::foremost(Vector direction) const {
  const Vector n = direction;
  const auto lowest = [n](const Box& box) {
    return n.x * (n.x > 0 ? box.low.x : box.high.x) + n.y * (n.y > 0 ? box.low.y : box.high.y) +
           n.z * (n.z > 0 ? box.low.z : box.high.z);
  };
  double least = std::numeric_limits<double>::infinity();
  Vector found;
  // Each step leaves one node behind, so there are as many as the tree is high.
  std::array<std::pair<double, std::uint32_t>, 64> stack;
  std::size_t size = 0;
  stack[size++] = {lowest(nodes_[0].box), 0};
  while (size > 0) {
    const auto [low, at] = stack[--size];
    if (low >= least) continue;
    const Node& node = nodes_[at];
    ask();
    if (node.right == 0) {
      for (std::uint32_t k = node.begin; k < node.end; ++k)
        for (const Vector p : corners_[k])
          if (const double along = dot(n, p); along < least) least = along, found = p;
      continue;
    }
    std::pair<double, std::uint32_t> one{lowest(nodes_[at + 1].box), at + 1},
        other{lowest(nodes_[node.right].box), node.right};
    if (other.first < one.first) std::swap(one, other);
    stack[size++] = other;
    stack[size++] = one;
  }
  return found;
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
