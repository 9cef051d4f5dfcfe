#include "lekalo/solid/oriented_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lekalo/base/stop.hpp"
#include "lekalo/solid/principal_axes.hpp"

namespace lekalo::solid {
namespace {

/// An area, its middle and how it is spread about it: the integral of the products of the ways there. It is
/// put together from those of parts without a difference of large numbers.
struct Spread {
  double area = 0;
  Vector middle;
  Matrix products{};

  void add(Vector way, double weight) {
    const std::array<double, 3> v{way.x, way.y, way.z};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) products[i][j] += weight * v[i] * v[j];
  }
};

Spread spread_of(const Corners& t) {
  Spread made{0.5 * norm(cross(t[1] - t[0], t[2] - t[0])), 1.0 / 3 * (t[0] + t[1] + t[2]), {}};
  for (const Vector p : t) made.add(p - made.middle, made.area / 12);
  return made;
}

Spread joined(const Spread& a, const Spread& b) {
  const double area = a.area + b.area, share = area > 0 ? b.area / area : 0.5;
  const Vector way = b.middle - a.middle;
  Spread made{area, a.middle + share * way, a.products};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) made.products[i][j] += b.products[i][j];
  made.add(way, a.area * share);
  return made;
}

}  // namespace

std::vector<OrientedBox> oriented_boxes(const TriangleTree& tree) {
  const auto& nodes = tree.nodes();
  std::vector<Spread> spread(nodes.size());
  std::vector<OrientedBox> boxes(nodes.size());
  // Children come behind their parents.
  for (std::size_t at = nodes.size(); at-- > 0;) {
    const TriangleTree::Node& node = nodes[at];
    ask(node.end - node.begin);
    if (node.right != 0) {
      spread[at] = joined(spread[at + 1], spread[node.right]);
    } else {
      spread[at] = spread_of(tree.corners(node.begin));
      for (std::uint32_t k = node.begin + 1; k < node.end; ++k)
        spread[at] = joined(spread[at], spread_of(tree.corners(k)));
    }
    const Vector middle = spread[at].middle;
    OrientedBox& box = boxes[at];
    box.axes = eigenvectors(spread[at].products);
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
  }
  return boxes;
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
