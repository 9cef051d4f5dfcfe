#include "lekalo/solid/oriented_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lekalo/base/stop.hpp"
#include "lekalo/solid/principal_axes.hpp"

namespace lekalo::solid {
namespace {

/// The way in which more triangles lie is that of some of them.
constexpr std::uint32_t kLookedAt = 16;
/// The areas of triangles, as vectors, say how a patch lies if they add up to this part of the sum of their
/// lengths.
constexpr double kFlat = 0.7;
/// A triangle that is less wide than this part of its length does not say in which plane it lies.
constexpr double kSlender = 0x1p-20;

/// The direction of length 1 that the axis least along n has across n, of length 1.
Vector across(Vector n) {
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  const Vector axis = x <= y && x <= z ? Vector{1, 0, 0} : y <= z ? Vector{0, 1, 0} : Vector{0, 0, 1};
  const Vector made = cross(n, axis);
  return 1 / norm(made) * made;
}

/// The direction across n along which triangles are spread most: an eigenvector of two rows.
Vector longest_across(Vector n, const Matrix& products) {
  const Vector u = across(n), v = cross(n, u);
  const auto along = [&](Vector a, Vector b) {
    const auto row = [&](std::size_t i) { return dot(b, {products[i][0], products[i][1], products[i][2]}); };
    return a.x * row(0) + a.y * row(1) + a.z * row(2);
  };
  const double half = 0.5 * (along(u, u) - along(v, v)), both = along(u, v);
  const double whole = std::sqrt(half * half + both * both);
  if (!(whole > 0)) return u;
  // The larger one of sine and cosine of half the angle comes first.
  const double larger = std::sqrt(0.5 * (1 + std::abs(half) / whole)), smaller = both / (2 * whole * larger);
  const Vector longest = half >= 0 ? larger * u + smaller * v : smaller * u + larger * v;
  return 1 / norm(longest) * longest;
}

/// Axes along the longest side of a triangle, and across it; none if it has no area.
std::optional<std::array<Vector, 3>> axes_of(const Corners& t) {
  Vector longest = t[1] - t[0];
  for (const Vector side : {t[2] - t[1], t[0] - t[2]})
    if (dot(side, side) > dot(longest, longest)) longest = side;
  const Vector looks = cross(t[1] - t[0], t[2] - t[0]);
  const double size = norm(looks), length = norm(longest);
  if (!(size > kSlender * length * length)) return std::nullopt;
  const Vector x = 1 / length * longest, across = cross(1 / size * looks, x), y = 1 / norm(across) * across;
  return std::array<Vector, 3>{x, y, cross(x, y)};
}

std::array<Vector, 3> axes_of(const TriangleTree& tree, const TriangleTree::Node& node) {
  if (node.end - node.begin == 1) {
    if (const auto axes = axes_of(tree.corners(node.begin))) return *axes;
  }
  const std::uint32_t step = 1 + (node.end - node.begin) / kLookedAt;
  double area = 0;
  Vector sum, first;
  for (std::uint32_t k = node.begin; k < node.end; k += step) {
    const Corners& t = tree.corners(k);
    const Vector looks = cross(t[1] - t[0], t[2] - t[0]);
    const double size = norm(looks);
    area += size;
    sum = sum + looks;
    first = first + size * ((t[0] - node.box.low) + (t[1] - node.box.low) + (t[2] - node.box.low));
  }
  const Vector middle = node.box.low + (area > 0 ? 1 / (3 * area) : 0) * first;
  // The integral over the triangles of the products of the ways from their middle.
  Matrix products{};
  const auto add = [&](Vector way, double weight) {
    const std::array<double, 3> v{way.x, way.y, way.z};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) products[i][j] += weight * v[i] * v[j];
  };
  for (std::uint32_t k = node.begin; k < node.end; k += step) {
    const Corners& t = tree.corners(k);
    const Vector a = t[0] - middle, b = t[1] - middle, c = t[2] - middle;
    const double weight = norm(cross(t[1] - t[0], t[2] - t[0])) / 24;
    add(a, weight), add(b, weight), add(c, weight), add(a + b + c, weight);
  }
  const double looks = norm(sum);
  if (!(looks > kFlat * area)) return eigenvectors(products);
  const Vector n = 1 / looks * sum, longest = longest_across(n, products);
  return {longest, cross(n, longest), n};
}

OrientedBox box_of(const TriangleTree& tree, const TriangleTree::Node& node) {
  OrientedBox box;
  const Vector middle = 0.5 * (node.box.low + node.box.high);
  if (node.end - node.begin > OrientedBoxes::kMostTriangles) {
    box.middle = middle;
    box.half = 0.5 * (node.box.high - node.box.low);
    return box;
  }
  box.axes = axes_of(tree, node);
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::uint32_t k = node.begin; k < node.end; ++k)
    for (const Vector p : tree.corners(k))
      for (std::size_t i = 0; i < 3; ++i) {
        const double along = dot(box.axes[i], p - middle);
        low[i] = std::min(low[i], along);
        high[i] = std::max(high[i], along);
      }
  const auto set = [&](std::size_t i, double& half) {
    box.middle = box.middle + 0.5 * (low[i] + high[i]) * box.axes[i];
    half = 0.5 * (high[i] - low[i]);
  };
  box.middle = middle;
  set(0, box.half.x), set(1, box.half.y), set(2, box.half.z);
  return box;
}

}  // namespace

OrientedBoxes::OrientedBoxes(const TriangleTree& tree)
    : state_(std::make_unique<std::atomic<std::uint8_t>[]>(tree.nodes().size())),
      boxes_(std::make_unique_for_overwrite<Room[]>(tree.nodes().size())) {}

void OrientedBoxes::make(const TriangleTree& tree, std::uint32_t node) const {
  const TriangleTree::Node& of_node = tree.nodes()[node];
  ask(of_node.end - of_node.begin);
  std::atomic<std::uint8_t>& state = state_[node];
  std::uint8_t before = kOpen;
  if (state.compare_exchange_strong(before, kInTheMaking, std::memory_order_relaxed)) {
    new (boxes_[node].bytes) OrientedBox(box_of(tree, of_node));
    state.store(kMade, std::memory_order_release);
    return;
  }
  // Another thread makes it, which takes microseconds.
  while (state.load(std::memory_order_acquire) != kMade) {
  }
}

OrientedBox moved(const Motion& motion, const OrientedBox& box) noexcept {
  return {motion(box.middle),
          {motion.turned(box.axes[0]), motion.turned(box.axes[1]), motion.turned(box.axes[2])},
          box.half};
}

double squared_gap(const OrientedBox& a, const OrientedBox& b) noexcept {
  // The products of all axes of the one with all of the other are the shadows of both.
  const auto [ax, ay, az] = a.axes;
  const auto [bx, by, bz] = b.axes;
  const auto absolute = [](double x, double y, double z) {
    return Vector{std::abs(x), std::abs(y), std::abs(z)};
  };
  const Vector way = b.middle - a.middle, x = absolute(dot(ax, bx), dot(ax, by), dot(ax, bz)),
               y = absolute(dot(ay, bx), dot(ay, by), dot(ay, bz)),
               z = absolute(dot(az, bx), dot(az, by), dot(az, bz));
  const Vector of_a = absolute(dot(ax, way), dot(ay, way), dot(az, way)) - a.half -
                      Vector{dot(x, b.half), dot(y, b.half), dot(z, b.half)},
               of_b = absolute(dot(bx, way), dot(by, way), dot(bz, way)) - b.half -
                      (a.half.x * x + (a.half.y * y + a.half.z * z));
  const auto square = [](Vector beyond) {
    const Vector v{std::max(0.0, beyond.x), std::max(0.0, beyond.y), std::max(0.0, beyond.z)};
    return dot(v, v);
  };
  return std::max(square(of_a), square(of_b));
}

}  // namespace lekalo::solid
