#include "cut_cell.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::heat {
namespace {

using Point = std::array<double, 3>;
struct Node {
  Point at;
  double value;
};

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double norm(const Point& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

/// The place between a node inside and one that is not, at which the value is 0.
Point crossing(const Node& in, const Node& out) {
  const double part = in.value / (in.value - out.value);
  Point p{};
  for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = in.at[axis] + part * (out.at[axis] - in.at[axis]);
  return p;
}

/// Share of a triangle on which a linear function is positive.
double positive_share(double a, double b, double c) {
  const int inside = (a > 0 ? 1 : 0) + (b > 0 ? 1 : 0) + (c > 0 ? 1 : 0);
  if (inside == 0 || inside == 3) return inside == 0 ? 0 : 1;
  // The one that differs from both others comes first.
  const bool lonely = inside == 1;
  if ((b > 0) == lonely)
    std::swap(a, b);
  else if ((c > 0) == lonely)
    std::swap(a, c);
  const double corner = a / (a - b) * (a / (a - c));
  return lonely ? corner : 1 - corner;
}

struct Part {
  double share, area;
};

/// One tetrahedron of the 24; the nodes inside come first.
Part part_of(std::array<Node, 4> n) {
  std::stable_partition(n.begin(), n.end(), [](const Node& node) { return node.value > 0; });
  const auto inside = std::count_if(n.begin(), n.end(), [](const Node& node) { return node.value > 0; });
  const auto lonely = [](const Node& one, const Node& a, const Node& b, const Node& c) {
    const double v = one.value;
    return v / (v - a.value) * (v / (v - b.value)) * (v / (v - c.value));
  };
  const auto triangle = [](const Point& a, const Point& b, const Point& c) {
    return norm(cross(minus(b, a), minus(c, a))) / 2;
  };
  switch (inside) {
    case 0:
      return {0, 0};
    case 1:
      return {lonely(n[0], n[1], n[2], n[3]),
              triangle(crossing(n[0], n[1]), crossing(n[0], n[2]), crossing(n[0], n[3]))};
    case 3:
      return {1 - lonely(n[3], n[0], n[1], n[2]),
              triangle(crossing(n[0], n[3]), crossing(n[1], n[3]), crossing(n[2], n[3]))};
    case 4:
      return {1, 0};
    default:
      break;
  }
  const double p = n[0].value, q = n[1].value, r = n[2].value, s = n[3].value;
  const double share = (p * p * q * q - p * q * (p + q) * (r + s) + r * s * (p * p + p * q + q * q)) /
                       ((p - r) * (p - s) * (q - r) * (q - s));
  const Point diagonal = minus(crossing(n[1], n[3]), crossing(n[0], n[2]));
  const Point other = minus(crossing(n[1], n[2]), crossing(n[0], n[3]));
  return {share, norm(cross(diagonal, other)) / 2};
}

}  // namespace

double open_share(double a, double b, double c, double d) {
  const double middle = (a + b + c + d) / 4;
  return (positive_share(middle, a, b) + positive_share(middle, b, c) + positive_share(middle, c, d) +
          positive_share(middle, d, a)) /
         4;
}

CutCell cut_cell(const Corners& value, const std::array<double, 3>& pitch) {
  const auto inside = std::count_if(value.begin(), value.end(), [](double v) { return v > 0; });
  if (inside == 0) return {};
  if (*std::min_element(value.begin(), value.end()) > 0) return {1, 0};
  const auto corner = [&](std::size_t n) {
    return Node{{(n & 1U) != 0 ? pitch[0] : 0, (n & 2U) != 0 ? pitch[1] : 0, (n & 4U) != 0 ? pitch[2] : 0},
                value[n]};
  };
  Node middle{{pitch[0] / 2, pitch[1] / 2, pitch[2] / 2}, 0};
  for (const double v : value) middle.value += v / 8;
  CutCell cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = std::size_t{1} << (axis + 1) % 3, v = std::size_t{1} << (axis + 2) % 3;
    for (const std::size_t low : {std::size_t{0}, std::size_t{1} << axis}) {
      const std::array<std::size_t, 4> around{low, low + u, low + u + v, low + v};
      Node face{middle.at, 0};
      face.at[axis] = low == 0 ? 0 : pitch[axis];
      for (const std::size_t n : around) face.value += value[n] / 4;
      for (std::size_t n = 0; n < 4; ++n) {
        const Part part = part_of({middle, face, corner(around[n]), corner(around[(n + 1) % 4])});
        cell.share += part.share / 24;
        cell.wall += part.area;
      }
    }
  }
  return cell;
}

}  // namespace lekalo::heat
