#include <fmt/core.h>

#include <algorithm>
#include <compare>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "solid_mesh.hpp"
#include "verify/number/vec3.hpp"

namespace lekalo::verify {
namespace {

/// Orders the places of two vertices exactly: nearest doubles that differ are in the order of their numbers.
std::partial_ordering compare_places(const SolidMesh& mesh, std::uint32_t a, std::uint32_t b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto order = mesh.near[a][axis] <=> mesh.near[b][axis];
    if (std::is_neq(order)) return order;
    if (mesh.written.empty()) continue;
    const Decimal &u = mesh.written[a][axis], &v = mesh.written[b][axis];
    const auto exact = (u.exponent == v.exponent ? cmp(u.digits, v.digits) : compare(u, v)) <=> 0;
    if (std::is_neq(exact)) return exact;
  }
  return std::partial_ordering::equivalent;
}

/// Triangles by their corners, with the numbers that they have in the file.
struct Kept {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> numbers;
  void add(const std::array<std::uint32_t, 3>& triangle, std::uint32_t number) {
    triangles.push_back(triangle);
    numbers.push_back(number);
  }
};

/// Returns the number of each vertex after those at one place have become one, and keeps one of each.
std::vector<std::uint32_t> weld(SolidMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.near.size()), becomes(mesh.near.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    ask();
    return std::is_lt(compare_places(mesh, a, b));
  });
  SolidMesh kept;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || std::is_neq(compare_places(mesh, order[k - 1], order[k]))) {
      kept.near.push_back(mesh.near[order[k]]);
      if (!mesh.written.empty()) kept.written.push_back(mesh.written[order[k]]);
    }
    becomes[order[k]] = static_cast<std::uint32_t>(kept.near.size() - 1);
  }
  mesh.near = std::move(kept.near);
  mesh.written = std::move(kept.written);
  return becomes;
}

/// Returns an edge that belongs to an odd number of triangles.
using Edge = std::pair<std::uint32_t, std::uint32_t>;
std::optional<Edge> open_edge(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const auto& [a, b, c] : triangles)
    for (const auto& [from, to] : {Edge{a, b}, Edge{b, c}, Edge{c, a}})
      edges.emplace_back(std::min(from, to), std::max(from, to));
  ask(edges.size());
  std::sort(edges.begin(), edges.end());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    if ((end - begin) % 2 != 0) return edges[begin];
  }
  return std::nullopt;
}

/// Leaves of the triangles on the same three corners the first one, where the surface closes so, and they
/// mean it only once: it is open with them, or two of them are turned alike, or no triangle stands alone.
void drop_repeats(Kept& all) {
  using Corners = std::array<std::uint32_t, 3>;
  const auto sorted = [](Corners t) {
    std::ranges::sort(t);
    return t;
  };
  /// Turned alike are those whose corners follow each other in the same order from the least one on.
  const auto from_least = [](Corners t) {
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    return t;
  };
  std::vector<std::pair<Corners, std::size_t>> order;
  for (std::size_t k = 0; k < all.triangles.size(); ++k) order.emplace_back(sorted(all.triangles[k]), k);
  ask(order.size());
  std::ranges::sort(order);
  std::vector<std::size_t> first;
  bool alike = false, alone = false;
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end =
        std::find_if(begin, order.end(), [&](const auto& one) { return one.first != begin->first; });
    first.push_back(begin->second);
    alone = alone || std::next(begin) == end;
    alike = alike || std::any_of(std::next(begin), end, [&](const auto& again) {
              return from_least(all.triangles[again.second]) == from_least(all.triangles[begin->second]);
            });
    begin = end;
  }
  if (first.size() == order.size() || (!alike && alone && !open_edge(all.triangles))) return;
  std::ranges::sort(first);
  Kept once;
  for (const std::size_t k : first) once.add(all.triangles[k], all.numbers[k]);
  if (!open_edge(once.triangles)) all = std::move(once);
}

template <class Number>
Of3<Number> normal_of(const SolidMesh& mesh, const std::array<std::uint32_t, 3>& triangle,
                      Number (SolidMesh::*coordinate)(std::uint32_t, std::size_t) const) {
  std::array<Of3<Number>, 3> at{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) at[k][axis] = (mesh.*coordinate)(triangle[k], axis);
  return normal(at);
}

/// Says whether the corners lie exactly on one line.
bool is_flat(const SolidMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  if (std::ranges::any_of(normal_of(mesh, triangle, &SolidMesh::enclosed),
                          [](Span s) { return sure_sign(s) != 0; }))
    return false;
  return std::ranges::all_of(normal_of(mesh, triangle, &SolidMesh::exact),
                             [](const Fraction& f) { return sgn(f) == 0; });
}

}  // namespace

Result<SolidMesh> closed(SolidMesh mesh, const std::string& name) {
  const std::vector<std::uint32_t> becomes = weld(mesh);
  Kept all, with_area;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    ask();
    const auto& [a, b, c] = mesh.triangles[k];
    const std::array<std::uint32_t, 3> t{becomes[a], becomes[b], becomes[c]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    all.add(t, mesh.numbers[k]);
  }
  drop_repeats(all);
  for (std::size_t k = 0; k < all.triangles.size(); ++k) {
    ask();
    if (!is_flat(mesh, all.triangles[k])) with_area.add(all.triangles[k], all.numbers[k]);
  }
  const auto with = [&](Kept& kept) {
    mesh.triangles = std::move(kept.triangles), mesh.numbers = std::move(kept.numbers);
    return std::move(mesh);
  };
  if (with_area.triangles.empty())
    return failure(ErrorCode::bad_input, name + ": none of its triangles has an area");
  if (!open_edge(with_area.triangles)) return with(with_area);
  if (const auto edge = open_edge(all.triangles)) {
    const auto &a = mesh.near[edge->first], &b = mesh.near[edge->second];
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: the surface is open: the edge from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, "
                               "{:.6g}, {:.6g}) belongs to one triangle or an odd number of them",
                               name, a[0], a[1], a[2], b[0], b[1], b[2]));
  }
  return with(all);
}

}  // namespace lekalo::verify
