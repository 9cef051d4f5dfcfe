#include "convex_pieces.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "lekalo/base/stop.hpp"

namespace lekalo::nest {
namespace {

using geom::GridPoint;
using Loop = std::vector<std::uint32_t>;

/// True if p lies in the closed triangle abc, corners counter-clockwise.
bool holds(GridPoint a, GridPoint b, GridPoint c, GridPoint p) {
  return geom::turn(a, b, p) >= 0 && geom::turn(b, c, p) >= 0 && geom::turn(c, a, p) >= 0;
}

/// True if the open segment pq and the segment ab have a point in common that is no end of pq.
bool crosses(GridPoint p, GridPoint q, GridPoint a, GridPoint b) {
  const auto at_end = [&](GridPoint x) { return x == p || x == q; };
  if (at_end(a) && at_end(b)) return false;
  const int pa = geom::turn(p, q, a), pb = geom::turn(p, q, b);
  const int ap = geom::turn(a, b, p), aq = geom::turn(a, b, q);
  if (pa * pb < 0 && ap * aq < 0) return true;
  const auto between = [&](GridPoint x) {
    return geom::turn(p, q, x) == 0 && !at_end(x) && geom::sign(dot(x - p, q - p)) > 0 &&
           geom::sign(dot(x - q, p - q)) > 0;
  };
  return between(a) || between(b) || (ap == 0 && !(p == a) && !(p == b) && between(p)) ||
         (ap == 0 && pa * pb < 0 && !(p == a) && !(p == b)) ||
         (aq == 0 && pa * pb < 0 && !(q == a) && !(q == b));
}

/// The region as one loop, which runs into every hole and back along the same way.
Loop joined_loops(const geom::GridRegion& region) {
  const auto& points = region.points;
  const auto loop_of = [&](std::size_t l) {
    Loop loop;
    for (std::uint32_t k = region.loop_starts[l]; k < region.loop_starts[l + 1]; ++k) loop.push_back(k);
    return loop;
  };
  Loop joined = loop_of(0);
  std::vector<Loop> holes;
  for (std::size_t l = 1; l < region.loops(); ++l) {
    Loop hole = loop_of(l);
    const auto right = std::max_element(hole.begin(), hole.end(), [&](std::uint32_t a, std::uint32_t b) {
      return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
    });
    std::rotate(hole.begin(), right, hole.end());
    holes.push_back(std::move(hole));
  }
  std::stable_sort(holes.begin(), holes.end(),
                   [&](const Loop& a, const Loop& b) { return points[a[0]].x > points[b[0]].x; });
  for (std::size_t h = 0; h < holes.size(); ++h) {
    const GridPoint from = points[holes[h][0]];
    const auto is_free = [&](GridPoint to) {
      ask(1 + joined.size() / 16);
      const auto meets = [&](const Loop& loop) {
        for (std::size_t k = 0; k < loop.size(); ++k)
          if (crosses(from, to, points[loop[k]], points[loop[(k + 1) % loop.size()]])) return true;
        return false;
      };
      if (meets(joined)) return false;
      for (std::size_t other = h; other < holes.size(); ++other)
        if (meets(holes[other])) return false;
      return true;
    };
    // The nearest corner is tried first. At both ends the way has to lead into the material.
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < joined.size(); ++k) {
      const GridPoint d = points[joined[k]] - from;
      order.emplace_back(static_cast<double>(d.x) * static_cast<double>(d.x) +
                             static_cast<double>(d.y) * static_cast<double>(d.y),
                         k);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [distance, k] : order) {
      const GridPoint to = points[joined[k]];
      const GridPoint before = points[joined[(k + joined.size() - 1) % joined.size()]],
                      after = points[joined[(k + 1) % joined.size()]];
      const bool convex = geom::turn(before, to, after) > 0;
      const bool left_of_in = geom::turn(before, to, from) > 0, left_of_out = geom::turn(to, after, from) > 0;
      if (convex ? !(left_of_in && left_of_out) : !(left_of_in || left_of_out)) continue;
      if (!is_free(to)) continue;
      Loop with(joined.begin(), joined.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      with.insert(with.end(), holes[h].begin(), holes[h].end());
      with.push_back(holes[h][0]);
      with.insert(with.end(), joined.begin() + static_cast<std::ptrdiff_t>(k), joined.end());
      joined = std::move(with);
      break;
    }
  }
  return joined;
}

/// A corner of a loop as an ear: the triangle with its neighbours.
struct Ear {
  std::uint32_t corner = 0;
  bool is_known = false;
  int side = 0;
  double quality = 0;
  /// A corner in the triangle, which cannot be cut off before that one is gone.
  std::optional<std::uint32_t> blocked_by;
};

void find_out(const std::vector<GridPoint>& points, std::vector<Ear>& loop, std::size_t k) {
  const std::size_t n = loop.size();
  Ear& ear = loop[k];
  const GridPoint a = points[loop[(k + n - 1) % n].corner], b = points[ear.corner],
                  c = points[loop[(k + 1) % n].corner];
  ear.is_known = true;
  ear.side = geom::turn(a, b, c);
  ear.blocked_by.reset();
  if (ear.side <= 0) return;
  ask(1 + n / 16);
  for (std::size_t m = 0; m < n && !ear.blocked_by; ++m) {
    const GridPoint p = points[loop[m].corner];
    if (!(p == a || p == b || p == c) && holds(a, b, c, p)) ear.blocked_by = loop[m].corner;
  }
  const GridPoint d = c - a;
  const double area = static_cast<double>(cross(b - a, d));
  const double length = static_cast<double>(d.x) * static_cast<double>(d.x) +
                        static_cast<double>(d.y) * static_cast<double>(d.y);
  ear.quality = length > 0 ? area / length : 0;
}

/// The ear to be cut off: a corner on a line, where there is nothing to cut off, or else the fattest one,
/// because thin ones make many pieces.
std::size_t best_ear(const std::vector<GridPoint>& points, std::vector<Ear>& loop) {
  const std::size_t n = loop.size();
  std::size_t best = n;
  for (std::size_t k = 0; k < n; ++k) {
    if (!loop[k].is_known) find_out(points, loop, k);
    const Ear& ear = loop[k];
    if (ear.side == 0) return k;
    if (ear.side > 0 && !ear.blocked_by && (best == n || ear.quality > loop[best].quality)) best = k;
  }
  if (best < n) return best;
  // This cannot be in a simple loop; a triangle that turns left covers more, never less.
  for (std::size_t k = 0; k < n; ++k)
    if (loop[k].side > 0) return k;
  return 0;
}

std::vector<Loop> triangles_of(const std::vector<GridPoint>& points, const Loop& corners) {
  std::vector<Loop> triangles;
  std::vector<Ear> loop;
  for (const std::uint32_t corner : corners) loop.push_back({corner, false, 0, 0, {}});
  const auto add = [&](std::size_t k) {
    const std::size_t n = loop.size();
    const Loop triangle = {loop[(k + n - 1) % n].corner, loop[k].corner, loop[(k + 1) % n].corner};
    if (geom::turn(points[triangle[0]], points[triangle[1]], points[triangle[2]]) > 0)
      triangles.push_back(triangle);
  };
  while (loop.size() > 3) {
    const std::size_t n = loop.size(), k = best_ear(points, loop);
    ask(1 + n / 64);
    add(k);
    const std::uint32_t gone = loop[k].corner;
    loop[(k + n - 1) % n].is_known = loop[(k + 1) % n].is_known = false;
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(k));
    for (Ear& ear : loop)
      if (ear.blocked_by == gone) ear.is_known = false;
  }
  add(1);
  return triangles;
}

/// Joins two pieces along an edge that both have, if the result is convex.
bool join(const std::vector<GridPoint>& points, Loop& a, const Loop& b) {
  const std::size_t n = a.size(), m = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t p = a[i], q = a[(i + 1) % n];
    for (std::size_t j = 0; j < m; ++j) {
      if (b[j] != q || b[(j + 1) % m] != p) continue;
      const GridPoint before_p = points[a[(i + n - 1) % n]], after_p = points[b[(j + 2) % m]];
      const GridPoint before_q = points[b[(j + m - 1) % m]], after_q = points[a[(i + 2) % n]];
      if (geom::turn(before_p, points[p], after_p) < 0 || geom::turn(before_q, points[q], after_q) < 0)
        return false;
      Loop joined;
      for (std::size_t k = 1; k <= n; ++k) joined.push_back(a[(i + k) % n]);  // q ... p
      for (std::size_t k = 2; k < m; ++k) joined.push_back(b[(j + k) % m]);
      a = std::move(joined);
      return true;
    }
  }
  return false;
}

}  // namespace

std::vector<ConvexPiece> convex_pieces(const geom::GridRegion& region) {
  if (region.empty()) return {};
  std::vector<Loop> pieces = triangles_of(region.points, joined_loops(region));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    ask(1 + pieces.size() / 4);
    for (std::size_t j = i + 1; j < pieces.size();) {
      if (join(region.points, pieces[i], pieces[j])) {
        pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
        j = i + 1;
      } else {
        ++j;
      }
    }
  }
  std::vector<ConvexPiece> result;
  for (const Loop& piece : pieces) {
    ConvexPiece corners;
    for (const std::uint32_t k : piece) corners.push_back(geom::mm_from_grid(region.points[k]));
    result.push_back(std::move(corners));
  }
  return result;
}

}  // namespace lekalo::nest
