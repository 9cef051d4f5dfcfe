#include "lekalo/solid/crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/solid/predicates.hpp"
#include "lekalo/solid/triangle_tree.hpp"
#include "shells.hpp"
#include "triangle.hpp"
#include "turned_sets.hpp"

namespace lekalo::solid {
namespace {

/// A layer that is nowhere as thick as this, mm, or as this part of the body, is too thin to hold anything.
constexpr double kThick = 0.01, kThickPart = 0x1p-10;
/// Places that are nearer than this part of the coordinates cannot be told apart.
constexpr double kNear = 0x1p-40;
/// So many crossings are looked at closely, and so many triangles of a mesh where none was found.
constexpr std::size_t kMostLooks = 2000, kMostSamples = 20'000;

bool boxes_meet(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// The place where the way from p to q goes through the triangle, its rim included. Whether it does is exact.
/// \pre p and q lie on either side of its plane
std::optional<Vector> place_through(const Corners& t, Vector p, Vector q) {
  int least = 1, most = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = side_of_plane(p, q, t[k], t[(k + 1) % 3]);
    least = std::min(least, side), most = std::max(most, side);
  }
  if (least < 0 && most > 0) return std::nullopt;
  const Vector n = cross(t[1] - t[0], t[2] - t[0]);
  const double from = std::abs(dot(n, p - t[0])), to = std::abs(dot(n, q - t[0]));
  return from + to > 0 ? p + from / (from + to) * (q - p) : p;
}

class CrossingFinder {
 public:
  explicit CrossingFinder(const Mesh& mesh) : mesh_(mesh), tree_(mesh) {
    const Box& box = tree_.box();
    found_.depth = std::min(kThick, kThickPart * norm(box.high - box.low));
  }

  Crossings find() && {
    pairs_left_ = limits::most_meeting_pieces(mesh_.triangles.size());
    look_at_pairs();
    for (const Crossing& crossing : to_look_at_)
      if (changes(crossing)) {
        found_.changing = crossing;
        return found_;
      }
    look_at_sheets();
    return found_;
  }

 private:
  [[nodiscard]] Corners corners(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
  }
  [[nodiscard]] static Vector middle(const Corners& t) { return (1.0 / 3) * (t[0] + t[1] + t[2]); }

  /// Brings all triangles together whose boxes meet, by walking the tree beside itself.
  void look_at_pairs() {
    const std::vector<TriangleTree::Node>& nodes = tree_.nodes();
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0, 0}};
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      if (!boxes_meet(nodes[a].box, nodes[b].box)) continue;
      if (nodes[a].right == 0 && nodes[b].right == 0) {
        if (!look_at_leaves(nodes[a], nodes[b])) return;
      } else if (a == b) {
        open.insert(open.end(), {{a + 1, a + 1}, {nodes[a].right, nodes[a].right}, {a + 1, nodes[a].right}});
      } else if (nodes[b].right == 0 ||
                 (nodes[a].right != 0 && nodes[a].end - nodes[a].begin >= nodes[b].end - nodes[b].begin)) {
        open.insert(open.end(), {{a + 1, b}, {nodes[a].right, b}});
      } else {
        open.insert(open.end(), {{a, b + 1}, {a, nodes[b].right}});
      }
    }
  }

  /// Returns false where too many pairs were looked at.
  bool look_at_leaves(const TriangleTree::Node& a, const TriangleTree::Node& b) {
    for (std::uint32_t i = a.begin; i < a.end; ++i)
      for (std::uint32_t k = &a == &b ? i + 1 : b.begin; k < b.end; ++k) {
        ask();
        if (pairs_left_-- == 0) {
          found_.complete = false;
          return false;
        }
        look_at_pair(tree_.triangle(i), tree_.triangle(k));
      }
    return true;
  }

  void look_at_pair(std::uint32_t s, std::uint32_t t) {
    const Triangle &of_s = mesh_.triangles[s], &of_t = mesh_.triangles[t];
    const auto shared =
        std::count_if(of_s.begin(), of_s.end(), [&](std::uint32_t v) { return has(of_t, v); });
    if (shared >= 2) return;  // they meet in their edge, or lie on each other
    const std::array<int, 3> sides_of_s = sides(s, t);
    if (!goes_across(sides_of_s)) return;
    const std::array<int, 3> sides_of_t = sides(t, s);
    if (!goes_across(sides_of_t)) return;
    note_edges_through(s, sides_of_s, t);
    note_edges_through(t, sides_of_t, s);
  }

  static bool has(const Triangle& t, std::uint32_t vertex) {
    return t[0] == vertex || t[1] == vertex || t[2] == vertex;
  }
  static bool goes_across(const std::array<int, 3>& sides) {
    const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
    return *least <= 0 && *most >= 0;
  }

  /// On which sides of the plane of t the corners of s lie.
  [[nodiscard]] std::array<int, 3> sides(std::uint32_t s, std::uint32_t t) const {
    const auto [a, b, c] = corners(t);
    std::array<int, 3> found{};
    for (std::size_t k = 0; k < 3; ++k)
      if (const std::uint32_t v = mesh_.triangles[s][k]; !has(mesh_.triangles[t], v))
        found[k] = side_of_plane(a, b, c, mesh_.vertices[v]);
    return found;
  }

  /// Notes the edges of s that go through t, whose plane its corners lie on either side of.
  void note_edges_through(std::uint32_t s, const std::array<int, 3>& sides_of_s, std::uint32_t t) {
    const Corners of_s = corners(s), of_t = corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (sides_of_s[k] * sides_of_s[next] >= 0) continue;
      const std::optional<Vector> place = place_through(of_t, of_s[k], of_s[next]);
      if (!place) continue;
      ++found_.edges;
      const Crossing crossing{*place, s, t};
      if (!found_.first) found_.first = crossing;
      if (to_look_at_.size() < kMostLooks) to_look_at_.push_back(crossing);
    }
  }

  /// Says whether a triangle has inside on the side to which it turns counter-clockwise, at a place of it
  /// that balls touch from both sides; nothing where they have no room, or where another triangle lies there,
  /// too.
  std::optional<bool> inside_before(const Corners& t, Vector p) {
    ask(20);
    const Vector n = cross(t[1] - t[0], t[2] - t[0]);
    const double length = norm(n), near = kNear * tree_.largest();
    if (!(length > 0)) return std::nullopt;
    std::array<bool, 2> holds{};
    for (const int side : {0, 1}) {
      const Vector q = p + (side == 0 ? found_.depth : -found_.depth) / length * n;
      const std::optional<Nearest> nearest = tree_.nearest(q, found_.depth);
      if (nearest && nearest->low < found_.depth - near) return std::nullopt;
      holds[static_cast<std::size_t>(side)] = tree_.holds(q);
    }
    if (holds[0] == holds[1] || triangles_near(p, 2 * near) != 1) return std::nullopt;
    return holds[0];
  }

  [[nodiscard]] std::size_t triangles_near(Vector p, double most) const {
    const Vector around{most, most, most};
    const Box place{p - around, p + around};
    std::size_t count = 0;
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      const TriangleTree::Node& node = tree_.nodes()[at];
      open.pop_back();
      if (!boxes_meet(place, node.box)) continue;
      if (node.right != 0)
        open.insert(open.end(), {at + 1, node.right});
      else
        for (std::uint32_t i = node.begin; i < node.end; ++i)
          count += distance(tree_.corners(i), p) <= most ? 1 : 0;
    }
    return count;
  }

  /// Says whether inside and outside change sides where one of two triangles goes through the other.
  bool changes(const Crossing& crossing) {
    const Corners s = corners(crossing.triangle), t = corners(*crossing.other);
    const Vector of_s = cross(s[1] - s[0], s[2] - s[0]), of_t = cross(t[1] - t[0], t[2] - t[0]);
    const Vector along = cross(of_s, of_t);
    return changes_across(s, crossing.place, cross(of_s, along)) ||
           changes_across(t, crossing.place, cross(of_t, along));
  }

  /// The same of one triangle, across the line through a place of it, in steps that double.
  bool changes_across(const Corners& t, Vector place, Vector across) {
    const double length = norm(across), reach = norm(t[1] - t[0]) + norm(t[2] - t[0]);
    if (!(length > 0)) return false;
    std::array<std::optional<bool>, 2> inside;
    for (const int side : {0, 1})
      for (double way = found_.depth; way < reach && !inside[static_cast<std::size_t>(side)]; way *= 2) {
        const Vector p = place + (side == 0 ? way : -way) / length * across;
        if (distance(t, p) > 0x1p-10 * found_.depth) break;
        inside[static_cast<std::size_t>(side)] = inside_before(t, p);
      }
    return inside[0] && inside[1] && *inside[0] != *inside[1];
  }

  /// Sheets hang together by edges with two triangles. Each has inside on one side of it, as far as the
  /// middles of its triangles know.
  void look_at_sheets() {
    const std::size_t count = mesh_.triangles.size();
    TurnedSets sheets(count);
    const std::vector<Edge> edges = sorted_edges(mesh_.triangles);
    for_each_edge(edges, [&](std::size_t begin, std::size_t end) {
      const Edge &a = edges[begin], &b = edges[end - 1];
      if (end - begin == 2) static_cast<void>(sheets.unite(a.triangle, b.triangle, a.forward == b.forward));
    });
    // The triangles of each sheet that have no inside before them, and those that have, as a quick look at one
    // place says; before is a side of the sheet.
    const std::size_t step = found_.first ? 1 : (count + kMostSamples - 1) / kMostSamples;
    std::vector<std::array<std::vector<std::uint32_t>, 2>> of_sheet(count);
    for (std::uint32_t t = 0; t < count; t += static_cast<std::uint32_t>(step)) {
      ask(5);
      const Corners at = corners(t);
      const Vector n = cross(at[1] - at[0], at[2] - at[0]);
      const double length = norm(n);
      if (!(length > 0)) continue;
      const auto [sheet, against] = sheets.find(t);
      const bool inside = tree_.holds(middle(at) + found_.depth / length * n);
      of_sheet[sheet][inside != against ? 1 : 0].push_back(t);
    }
    for (const auto& [outside, inside] : of_sheet) {
      if (outside.empty() || inside.empty()) continue;
      const bool fewer_inside = inside.size() < outside.size();
      const auto odd = seen(fewer_inside ? inside : outside, fewer_inside, sheets);
      if (!odd || !seen(fewer_inside ? outside : inside, !fewer_inside, sheets)) continue;
      found_.changing = Crossing{middle(corners(*odd)), *odd, std::nullopt};
      return;
    }
  }

  /// The first of some triangles at whose middle balls show the same.
  std::optional<std::uint32_t> seen(const std::vector<std::uint32_t>& triangles, bool inside,
                                    TurnedSets& sheets) {
    for (const std::uint32_t t : triangles) {
      const Corners at = corners(t);
      const std::optional<bool> before = inside_before(at, middle(at));
      if (before && (*before != sheets.find(t).second) == inside) return t;
    }
    return std::nullopt;
  }

  const Mesh& mesh_;
  TriangleTree tree_;
  Crossings found_;
  std::size_t pairs_left_ = 0;
  std::vector<Crossing> to_look_at_;
};

}  // namespace

Crossings crossings(const Mesh& mesh) { return CrossingFinder(mesh).find(); }

}  // namespace lekalo::solid
