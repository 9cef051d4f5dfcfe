#include "lekalo/solid/mesh.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "lekalo/base/counted.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::solid {
namespace {

/// An edge of a triangle, from its lesser vertex to its greater one.
struct Edge {
  std::uint32_t low, high;
  std::uint32_t triangle;
  bool forward;  ///< the triangle passes it from low to high
  [[nodiscard]] auto ends() const noexcept { return std::pair(low, high); }
};

std::vector<Edge> sorted_edges(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), t, from < to});
    }
  }
  ask(edges.size() / 4);
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tuple(a.low, a.high, a.triangle) < std::tuple(b.low, b.high, b.triangle);
  });
  return edges;
}

/// Returns which vertex each becomes: the first at the same place.
std::vector<std::uint32_t> weld(const std::vector<Vector>& vertices) {
  const auto place = [&](std::uint32_t v) { return std::tuple(vertices[v].x, vertices[v].y, vertices[v].z); };
  std::vector<std::uint32_t> order(vertices.size()), becomes(vertices.size());
  for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
  ask(order.size() / 4);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(place(a), a) < std::pair(place(b), b);
  });
  for (std::size_t k = 0; k < order.size(); ++k)
    becomes[order[k]] = k > 0 && place(order[k]) == place(order[k - 1]) ? becomes[order[k - 1]] : order[k];
  return becomes;
}

/// Leaves out vertices that no triangle has; the others keep their order.
void drop_unused(Mesh& mesh) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> becomes(mesh.vertices.size(), kUnused);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) becomes[v] = 0;
  std::uint32_t kept = 0;
  for (std::uint32_t v = 0; v < becomes.size(); ++v) {
    if (becomes[v] == kUnused) continue;
    mesh.vertices[kept] = mesh.vertices[v];
    becomes[v] = kept++;
  }
  mesh.vertices.resize(kept);
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = becomes[v];
}

std::string place(Vector p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

/// The edges in sum: how many have an odd number of triangles, and the first of these in the order of
/// triangles.
struct Rim {
  std::size_t open = 0, against = 0;
  Edge first{};
};
Rim rim_of(const std::vector<Edge>& edges) {
  Rim rim;
  for (std::size_t begin = 0, end; begin < edges.size(); begin = end) {
    std::size_t forward = 0;
    for (end = begin; end < edges.size() && edges[end].ends() == edges[begin].ends(); ++end)
      forward += edges[end].forward ? 1 : 0;
    if ((end - begin) % 2 != 0) {
      if (rim.open++ == 0 || edges[begin].triangle < rim.first.triangle) rim.first = edges[begin];
    } else if (2 * forward != end - begin) {
      ++rim.against;
    }
  }
  return rim;
}

}  // namespace

void Box::hold(Vector p) noexcept {
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

Box box_of(const std::vector<Vector>& points) noexcept {
  Box box;
  for (const Vector p : points) box.hold(p);
  return box;
}

Result<ClosedMesh> closed_mesh(Mesh mesh) {
  const auto refuse = [](std::string sentence) { return failure(ErrorCode::bad_input, std::move(sentence)); };
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vector p = mesh.vertices[v];
    for (const double c : {p.x, p.y, p.z})
      if (!(std::abs(c) <= limits::kLargestCoordinate))
        return refuse(fmt::format("vertex {} at {} lies beyond {:g} mm; look at its units", v + 1, place(p),
                                  limits::kLargestCoordinate));
  }
  ClosedMesh closed;
  const std::vector<std::uint32_t> becomes = weld(mesh.vertices);
  std::vector<std::uint32_t> number;  // of the triangles that are kept, in the mesh that was given
  std::vector<Triangle> kept;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Triangle welded{becomes[a], becomes[b], becomes[c]};
    if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0]) continue;
    kept.push_back(welded);
    number.push_back(t);
  }
  if (kept.empty()) return refuse("there are no triangles in it, or none with three corners");
  if (kept.size() < mesh.triangles.size())
    closed.notices.push_back(fmt::format("{} had two corners at one place and left out",
                                         counted(mesh.triangles.size() - kept.size(), "triangle")));
  mesh.triangles = std::move(kept);

  const Rim rim = rim_of(sorted_edges(mesh.triangles));
  if (rim.open > 0) {
    return refuse(
        fmt::format("the surface is open: {} to one triangle or an odd number of them, the first from {} to "
                    "{} on triangle {}; "
                    "close it in the program that the mesh comes from",
                    rim.open == 1 ? std::string("1 edge belongs") : fmt::format("{} edges belong", rim.open),
                    place(mesh.vertices[rim.first.low]), place(mesh.vertices[rim.first.high]),
                    number[rim.first.triangle] + 1));
  }
  if (rim.against > 0)
    closed.notices.push_back(
        fmt::format("at {} the triangles are turned against each other; inside is where a way from outside "
                    "crosses the surface "
                    "an odd number of times, however they are turned",
                    counted(rim.against, "edge")));
  drop_unused(mesh);
  closed.mesh = std::move(mesh);
  return closed;
}

}  // namespace lekalo::solid
