#include "lekalo/solid/flat_patches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lekalo::solid {
namespace {

/// A disc ends where so many triangles are looked at.
constexpr std::size_t kMostTriangles = 200;

double to_segment(Vector p, Vector a, Vector b) {
  const Vector along = b - a;
  const double square = dot(along, along);
  const double share = square > 0 ? std::clamp(dot(along, p - a) / square, 0.0, 1.0) : 0;
  return norm(p - (a + share * along));
}

}  // namespace

FlatPatches::FlatPatches(const Mesh& mesh)
    : mesh_(&mesh), neighbours_(mesh.triangles.size(), {kNone, kNone, kNone}) {
  struct Edge {
    std::uint32_t low, high, triangle, corner;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      edges.push_back({low, high, t, k});
    }
  const auto same = [](const Edge& a, const Edge& b) { return a.low == b.low && a.high == b.high; };
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::pair(std::pair(a.low, a.high), a.triangle) < std::pair(std::pair(b.low, b.high), b.triangle);
  });
  for (std::size_t k = 0; k < edges.size();) {
    std::size_t end = k + 1;
    while (end < edges.size() && same(edges[k], edges[end])) ++end;
    if (end - k == 2) {
      neighbours_[edges[k].triangle][edges[k].corner] = edges[k + 1].triangle;
      neighbours_[edges[k + 1].triangle][edges[k + 1].corner] = edges[k].triangle;
    }
    k = end;
  }
}

double FlatPatches::disc(std::uint32_t triangle, Vector place, double flatness) const {
  const auto corner = [&](std::uint32_t t, std::size_t k) {
    return mesh_->vertices[mesh_->triangles[t][k % 3]];
  };
  const Vector from = corner(triangle, 0);
  const Vector across = cross(corner(triangle, 1) - from, corner(triangle, 2) - from);
  const double length = norm(across);
  if (!(length > 0)) return 0;
  const Vector n = 1 / length * across;
  const auto flat = [&](std::uint32_t t) {
    return std::abs(dot(n, corner(t, 0) - from)) <= flatness &&
           std::abs(dot(n, corner(t, 1) - from)) <= flatness &&
           std::abs(dot(n, corner(t, 2) - from)) <= flatness;
  };
  double radius = 1e300;
  std::vector<std::uint32_t> seen{triangle};
  for (std::size_t at = 0; at < seen.size(); ++at)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t next = neighbours_[seen[at]][k];
      const double way = to_segment(place, corner(seen[at], k), corner(seen[at], k + 1));
      if (!(way < radius)) continue;
      if (next == kNone || !flat(next) || seen.size() == kMostTriangles) {
        radius = way;
      } else if (std::find(seen.begin(), seen.end(), next) == seen.end()) {
        seen.push_back(next);
      }
    }
  return radius;
}

}  // namespace lekalo::solid
