#include "lekalo/solid/mesh.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

#include "lekalo/base/counted.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/predicates.hpp"
#include "shells.hpp"

namespace lekalo::solid {
namespace {

/// Predicates are exact from here on (side_of_plane).
constexpr double kSmallestCoordinate = 0x1p-320;

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
  std::size_t open = 0;
  Edge first{};
};
Rim rim_of(const std::vector<Edge>& edges) {
  Rim rim;
  for_each_edge(edges, [&](std::size_t begin, std::size_t end) {
    if ((end - begin) % 2 != 0 && (rim.open++ == 0 || edges[begin].triangle < rim.first.triangle))
      rim.first = edges[begin];
  });
  return rim;
}

/// How many edges have triangles that are turned against each other.
std::size_t edges_against(const std::vector<Edge>& edges, const std::vector<Triangle>& triangles) {
  std::size_t against = 0;
  for_each_edge(edges, [&](std::size_t begin, std::size_t end) {
    std::size_t forward = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const auto& [a, b, c] = triangles[edges[k].triangle];
      const auto& [low, high] = edges[k].ends();
      forward += (a == low && b == high) || (b == low && c == high) || (c == low && a == high) ? 1 : 0;
    }
    against += 2 * forward != end - begin ? 1 : 0;
  });
  return against;
}

/// Says whether the corners lie on one straight line, exactly.
bool is_flat(const Mesh& mesh, const Triangle& t) {
  const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
  return geom::orientation({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == 0 &&
         geom::orientation({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) == 0 &&
         geom::orientation({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) == 0;
}

/// Triangles that have the corners of one before them, and how they are turned.
struct Repeats {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  ///< a triangle and the first one like it
  bool turned_alike = false;                                   ///< one of them is turned as the first one is
  bool everywhere = true;                                      ///< every triangle is repeated
};
Repeats repeats_of(const std::vector<Triangle>& triangles) {
  struct Sorted {
    Triangle corners;
    std::uint32_t triangle;
    bool even;  ///< the corners turn as they are sorted
  };
  std::vector<Sorted> order;
  order.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    Triangle corners = triangles[t];
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    const bool even = corners[1] < corners[2];
    if (!even) std::swap(corners[1], corners[2]);
    order.push_back({corners, t, even});
  }
  ask(order.size() / 4);
  std::sort(order.begin(), order.end(), [](const Sorted& a, const Sorted& b) {
    return std::tie(a.corners, a.triangle) < std::tie(b.corners, b.triangle);
  });
  Repeats repeats;
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    for (end = begin + 1; end < order.size() && order[end].corners == order[begin].corners; ++end) {
      repeats.pairs.emplace_back(order[end].triangle, order[begin].triangle);
      repeats.turned_alike = repeats.turned_alike || order[end].even == order[begin].even;
    }
    repeats.everywhere = repeats.everywhere && end - begin > 1;
  }
  std::sort(repeats.pairs.begin(), repeats.pairs.end());
  return repeats;
}

}  // namespace

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
    Vector& p = mesh.vertices[v];
    for (double* const c : {&p.x, &p.y, &p.z}) {
      if (!(std::abs(*c) <= limits::kLargestCoordinate))
        return refuse(fmt::format("vertex {} at {} lies beyond {:g} mm; look at its units", v + 1, place(p),
                                  limits::kLargestCoordinate));
      if (std::abs(*c) < kSmallestCoordinate) *c = 0;
    }
  }
  ClosedMesh closed;
  const std::vector<std::uint32_t> becomes = weld(mesh.vertices);
  std::vector<Triangle> kept;
  std::vector<char> flat;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Triangle welded{becomes[a], becomes[b], becomes[c]};
    if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0]) continue;
    kept.push_back(welded);
    flat.push_back(is_flat(mesh, welded) ? 1 : 0);
    closed.numbers.push_back(t);
  }
  const std::size_t given = mesh.triangles.size();
  if (std::count(flat.begin(), flat.end(), 0) == 0)
    return refuse("there are no triangles in it, or none with an area");

  const Box box = box_of(mesh.vertices);
  for (const auto& [axis, low, high] :
       {std::tuple('x', box.low.x, box.high.x), {'y', box.low.y, box.high.y}, {'z', box.low.z, box.high.z}})
    if (low == high)
      return refuse(
          fmt::format("all of it lies in the plane {} = {:.6g}, so it encloses nothing; export it as "
                      "a solid body",
                      axis, low));
  std::vector<Edge> edges = sorted_edges(kept);
  Rim rim = rim_of(edges);
  // Bodies that touch may share a triangle, and are turned against each other there, so repeats may be meant.
  const Repeats repeats = repeats_of(kept);
  std::size_t repeated = 0;
  if (!repeats.pairs.empty() && (rim.open > 0 || repeats.turned_alike || repeats.everywhere)) {
    std::vector<char> again(kept.size(), 0);
    for (const auto& [triangle, first] : repeats.pairs) again[triangle] = 1;
    const auto without = [&again](const auto& all) {
      std::remove_cvref_t<decltype(all)> made;
      for (std::size_t k = 0; k < all.size(); ++k)
        if (again[k] == 0) made.push_back(all[k]);
      return made;
    };
    std::vector<Triangle> once = without(kept);
    std::vector<Edge> edges_of_once = sorted_edges(once);
    if (const Rim rim_of_once = rim_of(edges_of_once); rim_of_once.open == 0) {
      repeated = repeats.pairs.size();
      const auto& [triangle, first] = repeats.pairs.front();
      closed.notices.push_back(fmt::format(
          "{} one with the same corners and {} left out, the first of them triangle {}, which repeats "
          "triangle {}",
          counted(repeated, "triangle repeats", "triangles repeat"), repeated == 1 ? "is" : "are",
          closed.numbers[triangle] + 1, closed.numbers[first] + 1));
      closed.numbers = without(closed.numbers), flat = without(flat);
      kept = std::move(once), edges = std::move(edges_of_once), rim = rim_of_once;
    }
  }
  if (const auto seams = static_cast<std::size_t>(std::count(flat.begin(), flat.end(), 1)); seams > 0) {
    std::vector<Triangle> others;
    std::vector<std::uint32_t> numbers;
    for (std::size_t k = 0; k < kept.size(); ++k) {
      if (flat[k] != 0) continue;
      others.push_back(kept[k]);
      numbers.push_back(closed.numbers[k]);
    }
    std::vector<Edge> edges_of_others = sorted_edges(others);
    if (const Rim without = rim_of(edges_of_others); without.open == 0) {
      kept = std::move(others);
      closed.numbers = std::move(numbers);
      edges = std::move(edges_of_others);
      rim = without;
    } else if (rim.open == 0) {
      closed.notices.push_back(fmt::format("{} no area and {}, because the surface closes along {}",
                                           counted(seams, "triangle has", "triangles have"),
                                           seams == 1 ? "stays" : "stay", seams == 1 ? "it" : "them"));
    }
  }
  if (rim.open > 0) {
    std::string and_repeats;
    if (!repeats.pairs.empty())
      and_repeats = fmt::format(", and triangle {} repeats triangle {}",
                                closed.numbers[repeats.pairs.front().first] + 1,
                                closed.numbers[repeats.pairs.front().second] + 1);
    return refuse(
        fmt::format("the surface is open: {} to one triangle or an odd number of them, the first from {} to "
                    "{} on triangle {}{}; close it in the program that the mesh comes from",
                    rim.open == 1 ? std::string("1 edge belongs") : fmt::format("{} edges belong", rim.open),
                    place(mesh.vertices[rim.first.low]), place(mesh.vertices[rim.first.high]),
                    closed.numbers[rim.first.triangle] + 1, and_repeats));
  }
  if (const std::size_t without_area = given - repeated - kept.size(); without_area > 0)
    closed.notices.push_back(fmt::format("{} no area and {} left out",
                                         counted(without_area, "triangle has", "triangles have"),
                                         without_area == 1 ? "is" : "are"));
  mesh.triangles = std::move(kept);
  closed.mesh = std::move(mesh);
  find_shells(edges, closed);
  if (const std::size_t against = edges_against(edges, closed.mesh.triangles); against > 0)
    closed.notices.push_back(
        fmt::format("at {} the triangles are turned against each other; inside is where a way from outside "
                    "crosses the surface "
                    "an odd number of times, however they are turned",
                    counted(against, "edge")));
  drop_unused(closed.mesh);
  return closed;
}

}  // namespace lekalo::solid
