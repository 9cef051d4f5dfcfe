#include "edge_flips.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "lekalo/base/stop.hpp"

namespace lekalo::solid {
namespace {

/// Passes after which little is left to gain.
constexpr int kPasses = 8;

/// An edge by its ends, the smaller first, and a triangle that has it.
struct Side {
  std::uint32_t low = 0, high = 0, triangle = 0;
  friend bool operator<(const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  }
  [[nodiscard]] bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

class Flips {
 public:
  explicit Flips(Mesh& mesh) : mesh_(mesh) {}

  /// Returns how many edges were turned. Of the triangles that a pass has changed it changes none again.
  std::size_t pass() {
    list_sides();
    changed_.assign(mesh_.triangles.size(), 0);
    std::size_t turned = 0;
    for (std::size_t k = 0; k < sides_.size();) {
      ask();
      std::size_t end = k;
      while (end < sides_.size() && sides_[end].same_edge(sides_[k])) ++end;
      if (end - k == 2 && turn(sides_[k], sides_[k + 1].triangle)) ++turned;
      k = end;
    }
    return turned;
  }

 private:
  void list_sides() {
    sides_.clear();
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3];
        sides_.push_back({std::min(a, b), std::max(a, b), t});
      }
    std::sort(sides_.begin(), sides_.end());
  }

  [[nodiscard]] bool is_edge(std::uint32_t a, std::uint32_t b) const {
    const Side side{std::min(a, b), std::max(a, b), 0};
    const auto at = std::lower_bound(sides_.begin(), sides_.end(), side);
    return (at != sides_.end() && at->same_edge(side)) || made_.contains({side.low, side.high});
  }

  /// The corner of a triangle across an edge, if the triangle goes along it from a to b.
  static std::uint32_t across(const Triangle& t, std::uint32_t a, std::uint32_t b) {
    for (std::size_t k = 0; k < 3; ++k)
      if (t[k] != a && t[k] != b) return t[k];
    return a;
  }
  static bool goes(const Triangle& t, std::uint32_t a, std::uint32_t b) {
    return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
  }

  [[nodiscard]] Vector normal(const Triangle& t) const {
    const Vector p = mesh_.vertices[t[0]];
    return cross(mesh_.vertices[t[1]] - p, mesh_.vertices[t[2]] - p);
  }
  /// The squared radius of the smallest circle around a triangle.
  [[nodiscard]] double circle(const Triangle& t) const {
    const Vector n = normal(t);
    std::array<double, 3> square{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector side = mesh_.vertices[t[(k + 1) % 3]] - mesh_.vertices[t[k]];
      square[k] = dot(side, side);
    }
    std::ranges::sort(square);
    if (square[0] + square[1] <= square[2]) return square[2] / 4;
    return square[0] * square[1] * square[2] / (4 * dot(n, n));
  }

  bool turn(const Side& edge, std::uint32_t other) {
    if (changed_[edge.triangle] != 0 || changed_[other] != 0) return false;
    Triangle &one = mesh_.triangles[edge.triangle], &two = mesh_.triangles[other];
    std::uint32_t a = edge.low, b = edge.high;
    if (!goes(one, a, b)) std::swap(a, b);
    if (!goes(two, b, a)) return false;
    const std::uint32_t c = across(one, a, b), d = across(two, a, b);
    if (c == d) return false;
    const Triangle first{c, d, b}, second{d, c, a};
    if (!(std::max(circle(first), circle(second)) < std::max(circle(one), circle(two)))) return false;
    const Vector up = normal(one) + normal(two);
    if (!(dot(normal(first), up) > 0 && dot(normal(second), up) > 0)) return false;
    if (is_edge(c, d)) return false;
    one = first, two = second;
    changed_[edge.triangle] = changed_[other] = 1;
    made_.emplace(std::min(c, d), std::max(c, d));
    return true;
  }

  Mesh& mesh_;
  std::vector<Side> sides_;
  /// The edges that this pass made.
  std::set<std::pair<std::uint32_t, std::uint32_t>> made_;
  std::vector<std::uint8_t> changed_;
};

}  // namespace

void flip_edges(Mesh& mesh) {
  for (int pass = 0; pass < kPasses; ++pass)
    if (Flips(mesh).pass() == 0) return;
}

}  // namespace lekalo::solid
