#pragma once

// Slow and exact answers about outlines on the grid, by other ideas than the engine's: material is cut into
// triangles; two triangles have no interior in common when a side of one separates them; a region lies in
// another when no triangle of it meets one of the complement; distances are least values of a quadratic
// function, in GMP fractions.

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::oracle {

using geom::GridPoint;
using geom::GridRegion;
using geom::Int128;
using Triangle = std::array<GridPoint, 3>;
using Loop = std::vector<GridPoint>;

inline int side(GridPoint a, GridPoint b, GridPoint c) { return geom::sign(cross(b - a, c - a)); }

inline bool on_segment(GridPoint p, GridPoint a, GridPoint b) {
  return side(a, b, p) == 0 && dot(a - p, b - p) <= 0;
}
inline bool segments_meet(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  if (on_segment(a, c, d) || on_segment(b, c, d) || on_segment(c, a, b) || on_segment(d, a, b)) return true;
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

/// No common interior: a side of one has all of the other on its right.
inline bool apart(const Triangle& s, const Triangle& t) {
  for (int swap = 0; swap < 2; ++swap) {
    const Triangle &p = swap == 0 ? s : t, &q = swap == 0 ? t : s;
    for (std::size_t i = 0; i < 3; ++i) {
      const GridPoint a = p[i], b = p[(i + 1) % 3];
      if (side(a, b, q[0]) <= 0 && side(a, b, q[1]) <= 0 && side(a, b, q[2]) <= 0) return true;
    }
  }
  return false;
}

namespace detail {

/// v lies strictly within the corner prev, at, next of a counter-clockwise polygon.
inline bool in_corner(GridPoint prev, GridPoint at, GridPoint next, GridPoint v) {
  if (side(prev, at, next) > 0) return side(prev, at, v) > 0 && side(at, next, v) > 0;
  return !(side(prev, at, v) <= 0 && side(at, next, v) <= 0);
}

/// Joins a hole (clockwise) to the loop by a cut that meets no edge of any loop.
inline void join(Loop& outer, const Loop& hole, const std::vector<Loop>& all) {
  for (std::size_t h = 0; h < hole.size(); ++h)
    for (std::size_t v = 0; v < outer.size(); ++v) {
      const GridPoint m = hole[h], at = outer[v];
      const auto prev = [](const Loop& loop, std::size_t i) {
        return loop[(i + loop.size() - 1) % loop.size()];
      };
      const auto next = [](const Loop& loop, std::size_t i) { return loop[(i + 1) % loop.size()]; };
      if (!in_corner(prev(outer, v), at, next(outer, v), m) ||
          !in_corner(prev(hole, h), m, next(hole, h), at))
        continue;
      bool clear = true;
      const auto check = [&](const Loop& loop) {
        for (std::size_t i = 0; i < loop.size() && clear; ++i) {
          const GridPoint a = loop[i], b = next(loop, i);
          const bool at_a = a == m || a == at, at_b = b == m || b == at;
          if (at_a && at_b) clear = false;
          if (at_a != at_b) clear = clear && !on_segment(at_a ? b : a, m, at);
          if (!at_a && !at_b) clear = clear && !segments_meet(m, at, a, b);
        }
      };
      check(outer);
      for (const Loop& loop : all) check(loop);
      if (!clear) continue;
      Loop joined(outer.begin(), outer.begin() + static_cast<std::ptrdiff_t>(v) + 1);
      for (std::size_t i = 0; i <= hole.size(); ++i) joined.push_back(hole[(h + i) % hole.size()]);
      joined.insert(joined.end(), outer.begin() + static_cast<std::ptrdiff_t>(v), outer.end());
      outer = std::move(joined);
      return;
    }
  throw std::logic_error("no cut to a hole");
}

inline std::vector<Triangle> cut_ears(Loop loop) {
  std::vector<Triangle> triangles;
  while (loop.size() > 2) {
    const std::size_t n = loop.size();
    bool cut = false;
    for (std::size_t i = 0; i < n && !cut; ++i) {
      const GridPoint a = loop[(i + n - 1) % n], b = loop[i], c = loop[(i + 1) % n];
      const int turn = side(a, b, c);
      if (turn == 0) {  // on a straight line, or a spike left over from a cut
        loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
        cut = true;
        break;
      }
      if (turn < 0) continue;
      bool ear = true;
      for (std::size_t j = 0; j < n && ear; ++j) {
        const GridPoint p = loop[j];
        if (p == a || p == b || p == c) continue;
        ear = !(side(a, b, p) >= 0 && side(b, c, p) >= 0 && side(c, a, p) >= 0);
      }
      if (!ear) continue;
      triangles.push_back({a, b, c});
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
      cut = true;
    }
    if (!cut) throw std::logic_error("no ear");
  }
  return triangles;
}

/// Throws unless the triangles tile an area: not overlapping, and as large as it.
inline void prove(const std::vector<Triangle>& triangles, Int128 twice_area) {
  Int128 sum = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    sum += cross(triangles[i][1] - triangles[i][0], triangles[i][2] - triangles[i][0]);
    for (std::size_t j = 0; j < i; ++j)
      if (!apart(triangles[i], triangles[j])) throw std::logic_error("triangles overlap");
  }
  if (sum != twice_area) throw std::logic_error("triangles do not fill the outline");
}

inline std::vector<Triangle> triangles_of(const std::vector<Loop>& loops) {
  Loop outer = loops[0];
  for (std::size_t h = 1; h < loops.size(); ++h) join(outer, loops[h], loops);
  std::vector<Triangle> triangles = cut_ears(std::move(outer));
  Int128 twice_area = 0;
  for (const Loop& loop : loops)
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      twice_area += cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
  prove(triangles, twice_area);
  return triangles;
}

inline mpz_class wide(Int128 v) {
  const bool negative = v < 0;
  Int128 rest = negative ? -v : v;
  mpz_class result = static_cast<unsigned long>(rest >> 64);
  result <<= 64;
  result += static_cast<unsigned long>(rest);
  return negative ? mpz_class(-result) : result;
}

}  // namespace detail

/// Squared distance of two segments: |a + s u - c - t v|^2 over the unit square is least at its critical
/// point when that lies within, else on a side of the square.
inline mpq_class squared_distance(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  using detail::wide;
  const GridPoint u = b - a, v = d - c, w = a - c;
  const mpz_class uu = wide(dot(u, u)), vv = wide(dot(v, v)), uv = wide(dot(u, v)), uw = wide(dot(u, w)),
                  vw = wide(dot(v, w)), ww = wide(dot(w, w));
  const auto value = [&](const mpq_class& s, const mpq_class& t) -> mpq_class {
    return s * s * uu + t * t * vv - 2 * s * t * uv + 2 * s * uw - 2 * t * vw + ww;
  };
  const auto clamped = [](const mpz_class& top, const mpz_class& bottom) {
    mpq_class q(top, bottom);
    q.canonicalize();
    return q < 0 ? mpq_class(0) : q > 1 ? mpq_class(1) : q;
  };
  // On s = 0, s = 1, t = 0, t = 1.
  mpq_class best = value(0, clamped(vw, vv));
  best = std::min(best, value(1, clamped(vw + uv, vv)));
  best = std::min(best, value(clamped(-uw, uu), 0));
  best = std::min(best, value(clamped(uv - uw, uu), 1));
  const mpz_class determinant = uu * vv - uv * uv;
  if (determinant != 0) {
    mpq_class s(uv * vw - vv * uw, determinant), t(uu * vw - uv * uw, determinant);
    s.canonicalize();
    t.canonicalize();
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, value(s, t));
  }
  return best;
}

/// A region cut up once, asked often. Movements are translations.
class Cut {
 public:
  explicit Cut(const GridRegion& region) {
    for (std::size_t l = 0; l < region.loops(); ++l)
      loops_.emplace_back(region.points.begin() + region.loop_starts[l],
                          region.points.begin() + region.loop_starts[l + 1]);
    material_ = detail::triangles_of(loops_);
    constexpr std::int64_t kFar = geom::kGridLimit * 2;
    Loop around(loops_[0].rbegin(), loops_[0].rend());
    complement_ =
        detail::triangles_of({{{-kFar, -kFar}, {kFar, -kFar}, {kFar, kFar}, {-kFar, kFar}}, around});
    for (std::size_t h = 1; h < loops_.size(); ++h) {
      const auto hole = detail::triangles_of({Loop(loops_[h].rbegin(), loops_[h].rend())});
      complement_.insert(complement_.end(), hole.begin(), hole.end());
    }
  }

  [[nodiscard]] bool interiors_meet(const Cut& b, GridPoint shift) const { return meet(material_, b, shift); }
  [[nodiscard]] bool holds(const Cut& b, GridPoint shift) const { return !meet(complement_, b, shift); }
  [[nodiscard]] bool edges_nearer_than(const Cut& b, std::int64_t gap, GridPoint shift) const {
    const mpz_class squared = detail::wide(Int128{gap} * gap);
    bool nearer = false;
    const auto beyond = [&](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
      return std::min(p, q) - std::max(r, s) > gap || std::min(r, s) - std::max(p, q) > gap;
    };
    each_edge({}, [&](GridPoint p, GridPoint q) {
      if (nearer) return;
      b.each_edge(shift, [&](GridPoint r, GridPoint s) {
        if (nearer || beyond(p.x, q.x, r.x, s.x) || beyond(p.y, q.y, r.y, s.y)) return;
        nearer = squared_distance(p, q, r, s) < squared;
      });
    });
    return nearer;
  }
  /// The square of the least distance of edges.
  [[nodiscard]] mpq_class squared_edge_distance(const Cut& b, GridPoint shift) const {
    mpq_class best = -1;
    each_edge({}, [&](GridPoint p, GridPoint q) {
      b.each_edge(shift, [&](GridPoint r, GridPoint s) {
        const mpq_class d = squared_distance(p, q, r, s);
        if (best < 0 || d < best) best = d;
      });
    });
    return best;
  }
  [[nodiscard]] const std::vector<Triangle>& material() const { return material_; }

 private:
  static bool meet(const std::vector<Triangle>& material, const Cut& b, GridPoint shift) {
    for (const Triangle& t : b.material_) {
      const Triangle at{t[0] + shift, t[1] + shift, t[2] + shift};
      for (const Triangle& s : material)
        if (!apart(s, at)) return true;
    }
    return false;
  }
  template <class Visit>
  void each_edge(GridPoint shift, Visit&& visit) const {
    for (const Loop& loop : loops_)
      for (std::size_t i = 0; i < loop.size(); ++i)
        visit(loop[i] + shift, loop[(i + 1) % loop.size()] + shift);
  }

  std::vector<Loop> loops_;
  std::vector<Triangle> material_, complement_;
};

}  // namespace lekalo::oracle
