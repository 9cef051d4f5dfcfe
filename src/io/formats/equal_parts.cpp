#include "equal_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/grid.hpp"

namespace lekalo::io {
namespace {

using geom::GridPoint;
using geom::GridRegion;
using geom::Point;
using layout::Part;

/// The largest step between two polygons, the second moved by `shift` and its loops read from `offset` points
/// on in the first loop; nothing where it is more than kSameOutline.
std::optional<std::int64_t> difference(const GridRegion& a, const GridRegion& b, GridPoint shift,
                                       std::uint32_t offset) {
  const std::int64_t most = geom::grid_from_mm(kSameOutline);
  std::int64_t largest = 0;
  for (std::size_t l = 0; l < a.loops(); ++l) {
    const std::uint32_t begin = a.loop_starts[l], size = a.loop_starts[l + 1] - begin;
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t j = l == 0 ? (i + offset) % size : i;
      const GridPoint apart = b.points[begin + j] + shift - a.points[begin + i];
      largest = std::max({largest, std::abs(apart.x), std::abs(apart.y)});
      if (largest > most) return std::nullopt;
    }
  }
  return largest;
}

bool same_marks(const Part& a, const Part& b, GridPoint shift) {
  const Point moved = geom::mm_from_grid(shift);
  const auto near = [&](const Point& p, const Point& q) {
    return std::abs(q.x + moved.x - p.x) <= kSameOutline && std::abs(q.y + moved.y - p.y) <= kSameOutline;
  };
  return std::equal(a.marks.begin(), a.marks.end(), b.marks.begin(), b.marks.end(),
                    [&](const layout::PartMark& m, const layout::PartMark& n) {
                      return m.layer == n.layer && m.colour == n.colour && m.role == n.role &&
                             std::equal(m.edges.begin(), m.edges.end(), n.edges.begin(), n.edges.end(),
                                        [&](const geom::Edge& e, const geom::Edge& f) {
                                          const bool line = e.kind == geom::EdgeKind::line;
                                          return e.kind == f.kind && near(e.from, f.from) &&
                                                 near(e.to, f.to) && (line || near(e.centre, f.centre));
                                        });
                    });
}

bool same_texts(const Part& a, const Part& b, GridPoint shift) {
  const Point moved = geom::mm_from_grid(shift);
  return std::equal(a.texts.begin(), a.texts.end(), b.texts.begin(), b.texts.end(),
                    [&](const layout::PartText& t, layout::PartText u) {
                      const Point apart = u.at + moved - t.at;
                      u.at = t.at;
                      return std::abs(apart.x) <= kSameOutline && std::abs(apart.y) <= kSameOutline && t == u;
                    });
}

/// The largest difference of two parts that are one outline, the second moved by `shift`; nothing for others.
std::optional<double> same_part(const Part& a, const Part& b, GridPoint shift) {
  const GridRegion &p = a.outline.polygon, &q = b.outline.polygon;
  if (p.points.size() != q.points.size() || p.loop_starts != q.loop_starts ||
      a.marks.size() != b.marks.size() || a.outline.curves.size() != b.outline.curves.size())
    return std::nullopt;
  const std::int64_t most = geom::grid_from_mm(kSameOutline);
  for (std::uint32_t offset = 0; offset < p.loop_starts[1]; ++offset) {
    const GridPoint apart = q.points[offset] + shift - p.points[0];
    if (std::abs(apart.x) > most || std::abs(apart.y) > most) continue;
    const auto found = difference(p, q, shift, offset);
    if (found && same_marks(a, b, shift) && same_texts(a, b, shift)) return geom::mm_from_grid(*found);
  }
  return std::nullopt;
}

}  // namespace

double merge_equal(std::vector<Part>& parts) {
  /// Numbers of points, loops and marks, and the cell of width and height.
  using Key = std::array<std::int64_t, 5>;
  constexpr std::int64_t kCell = 1024;  // grid steps, a multiple of what equal outlines may differ by
  std::vector<Part> kept;
  std::vector<GridPoint> corners;  // of the boxes of those that are kept, lower left
  std::map<Key, std::vector<std::size_t>> alike;
  double largest = 0;
  for (Part& part : parts) {
    const GridRegion& polygon = part.outline.polygon;
    const geom::GridBox box = geom::bounds(polygon);
    const Key key{static_cast<std::int64_t>(polygon.points.size()),
                  static_cast<std::int64_t>(polygon.loops()), static_cast<std::int64_t>(part.marks.size()),
                  (box.high.x - box.low.x) / kCell, (box.high.y - box.low.y) / kCell};
    std::optional<std::size_t> same;
    for (int cell = 0; cell < 9 && !same; ++cell) {
      Key beside = key;
      beside[3] += cell / 3 - 1, beside[4] += cell % 3 - 1;
      const auto found = alike.find(beside);
      if (found == alike.end()) continue;
      for (const std::size_t k : found->second) {
        ask(polygon.points.size());
        // The corners of both boxes come to lie on each other.
        const auto difference = same_part(kept[k], part, corners[k] - box.low);
        if (!difference) continue;
        largest = std::max(largest, *difference);
        same = k;
        break;
      }
    }
    if (same) {
      kept[*same].demand += part.demand;
      continue;
    }
    alike[key].push_back(kept.size());
    kept.push_back(std::move(part));
    corners.push_back(box.low);
  }
  parts = std::move(kept);
  return largest;
}

}  // namespace lekalo::io
