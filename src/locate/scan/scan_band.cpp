#include "scan_band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lekalo/base/assert.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/predicates.hpp"
#include "parity_index.hpp"
#include "point_hash.hpp"

namespace lekalo::locate {
namespace {

using geom::Point;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The slab along the chord of edges [first, last), and how far its inner side is beyond what it covers.
struct Fit {
  Slab slab;
  double excess = kInfinity;
  /// True when nothing lies far behind the chord's beginning or beyond its end.
  bool forward = false;
};

Fit fit_slab(const geom::Ring& points, const GuardedLoop& loop, std::size_t first, std::size_t last,
             double guard, double slack) {
  Fit fit;
  const Point a = points[loop.vertex(first)], chord = points[loop.vertex(last)] - a;
  const double length = norm(chord);
  if (!(length > 0)) return fit;
  const Point d = (1 / length) * chord, n = perpendicular(d);
  Slab slab{d, kInfinity, -kInfinity, kInfinity, -kInfinity};
  double least_front = kInfinity, least = kInfinity, most = -kInfinity;
  const auto take = [&](Point p, double reach) {
    const double across = dot(n, p), along = dot(d, p);
    slab.low = std::min(slab.low, across - reach);
    slab.high = std::max(slab.high, across + reach);
    slab.back = std::min(slab.back, along - reach);
    slab.front = std::max(slab.front, along + reach);
    least = std::min(least, along);
    most = std::max(most, along);
    return across + reach;
  };
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t e = i % loop.vertices.size();
    double front = std::min(take(points[loop.vertex(i)], loop.reach[e]),
                            take(points[loop.vertex(i + 1)], loop.reach[e]));
    for (std::uint32_t k = loop.beside_starts[e]; k < loop.beside_starts[e + 1]; ++k)
      front = std::max(front, take(points[loop.beside[k]], guard));
    least_front = std::min(least_front, front);
  }
  fit.slab = slab;
  fit.excess = slab.high - least_front;
  const double from = dot(d, a);
  fit.forward = least >= from - slack && most <= from + length + slack;
  return fit;
}

geom::Contour rectangle(const Slab& s, double margin) {
  const Point d = s.along, n = perpendicular(d);
  const double back = s.back - margin, front = s.front + margin, low = s.low - margin, high = s.high + margin;
  const Point corners[4] = {back * d + low * n, front * d + low * n, front * d + high * n,
                            back * d + high * n};
  geom::Contour contour;
  for (std::size_t i = 0; i < 4; ++i)
    contour.push_back({geom::EdgeKind::line, corners[i], corners[(i + 1) % 4], {}});
  return contour;
}

std::vector<Loop> loops_of(const std::vector<GuardedLoop>& loops) {
  std::vector<Loop> made;
  for (const GuardedLoop& loop : loops) made.push_back(loop.vertices);
  return made;
}

// ---- corners cut off --------------------------------------------------------------------------------------

/// Step 5 of docs/design/scan.md: the vertices of all contours of a set of regions, linked along the
/// contours, from which corners are cut off.
class CornerCutter {
 public:
  CornerCutter(const std::vector<geom::Region>& regions, double tolerance)
      : tolerance_(tolerance), hash_(cell_of(regions), geom::edges_in(regions), largest_of(regions)) {
    for (const geom::Region& region : regions) {
      add(region.outer);
      for (const geom::Contour& hole : region.holes) add(hole);
    }
    for (std::uint32_t i = 0; i < at_.size(); ++i) hash_.insert(i, at_[i]);
  }

  void cut() {
    // Every other vertex is looked at, and then again, so that a run of small steps is not eaten from one
    // end.
    for (bool changed = true; changed;) {
      changed = false;
      std::uint32_t last_cut = kNone;
      for (std::uint32_t i = 0; i < at_.size(); ++i) {
        if (gone_[i] || (last_cut != kNone && last_cut + 1 == i) || !can_go(i)) continue;
        gone_[i] = true;
        next_[before_[i]] = next_[i];
        before_[next_[i]] = before_[i];
        last_cut = i;
        changed = true;
      }
    }
  }

  [[nodiscard]] std::vector<geom::Region> regions(const std::vector<geom::Region>& original) const {
    std::vector<geom::Region> made;
    std::uint32_t first = 0;
    const auto contour = [&](const geom::Contour& old) {
      geom::Contour c;
      std::uint32_t start = first;
      const std::uint32_t end = first + static_cast<std::uint32_t>(old.size());
      while (start < end && gone_[start]) ++start;
      LEKALO_ASSERT(start < end);
      std::uint32_t i = start;
      do {
        c.push_back({geom::EdgeKind::line, at_[i], at_[next_[i]], {}});
        i = next_[i];
      } while (i != start);
      first = end;
      return c;
    };
    for (const geom::Region& region : original) {
      geom::Region r;
      r.outer = contour(region.outer);
      for (const geom::Contour& hole : region.holes) r.holes.push_back(contour(hole));
      made.push_back(std::move(r));
    }
    return made;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  static double largest_of(const std::vector<geom::Region>& regions) {
    double largest = 0;
    for (const geom::Region& region : regions)
      for (const geom::Edge& e : region.outer)
        largest = std::max({largest, std::abs(e.from.x), std::abs(e.from.y)});
    return largest;
  }
  static double cell_of(const std::vector<geom::Region>& regions) {
    double length = 0, longest = 0;
    const auto add = [&](const geom::Contour& c) {
      for (const geom::Edge& e : c) {
        length += norm(e.to - e.from);
        longest = std::max(longest, norm(e.to - e.from));
      }
    };
    for (const geom::Region& region : regions) {
      add(region.outer);
      for (const geom::Contour& hole : region.holes) add(hole);
    }
    return std::max(2 * length / static_cast<double>(geom::edges_in(regions)), longest / 64);
  }

  void add(const geom::Contour& contour) {
    const std::uint32_t first = static_cast<std::uint32_t>(at_.size()),
                        n = static_cast<std::uint32_t>(contour.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      at_.push_back(contour[i].from);
      before_.push_back(first + (i + n - 1) % n);
      next_.push_back(first + (i + 1) % n);
      // This is the contour's own order: the vertex after this one in the contour as it was before any cut.
      original_next_.push_back(first + (i + 1) % n);
    }
    gone_.resize(at_.size(), false);
  }

  [[nodiscard]] bool can_go(std::uint32_t i) const {
    const std::uint32_t a = before_[i], c = next_[i];
    if (a == c || before_[a] == next_[c] || before_[a] == c) return false;
    const Point pa = at_[a], pb = at_[i], pc = at_[c];
    if (geom::orientation(pa, pb, pc) <= 0) return false;
    const Point chord = pc - pa;
    const double length = norm(chord);
    if (!(length > 0) || !(dot(chord, pb - pa) >= 0) || !(dot(chord, pc - pb) >= 0)) return false;
    // All vertices that were cut off between the two before must not be deeper than the tolerance now,
    // either.
    for (std::uint32_t k = original_next_[a]; k != c; k = original_next_[k])
      if (!(std::abs(cross(chord, at_[k] - pa)) <= tolerance_ * length)) return false;
    // Nothing else may lie in the triangle that is cut off.
    const Point middle = 0.5 * (pa + pc);
    bool free = true;
    hash_.visit_near(middle, 0.5 * length + tolerance_, [&](std::uint32_t k) {
      if (!free || gone_[k] || k == a || k == i || k == c) return;
      const Point p = at_[k];
      if (geom::orientation(pa, pb, p) >= 0 && geom::orientation(pb, pc, p) >= 0 &&
          geom::orientation(pc, pa, p) >= 0) {
        free = false;
      }
    });
    return free;
  }

  double tolerance_;
  PointHash hash_;
  std::vector<Point> at_;
  std::vector<std::uint32_t> before_, next_, original_next_;
  std::vector<bool> gone_;
};

}  // namespace

std::vector<Slab> cover_by_slabs(const geom::Ring& points, const GuardedLoop& loop, double guard,
                                 double tolerance) {
  const std::size_t n = loop.vertices.size();
  const double slack = std::max(tolerance, guard);
  std::vector<Slab> slabs;
  for (std::size_t first = 0; first < n;) {
    const auto fits = [&](std::size_t last) {
      const Fit fit = fit_slab(points, loop, first, last, guard, slack);
      return fit.forward && fit.excess <= tolerance;
    };
    // The walk always takes one edge, then twice as many as long as they fit, and then finds the most by
    // halving.
    std::size_t good = first + 1, bad = n + 1;
    for (std::size_t step = 1; good + step <= n; step *= 2) {
      if (!fits(good + step)) {
        bad = good + step;
        break;
      }
      good += step;
    }
    while (good + 1 < std::min(bad, n + 1)) {
      const std::size_t middle = good + (std::min(bad, n + 1) - good) / 2;
      (fits(middle) ? good : bad) = middle;
    }
    slabs.push_back(fit_slab(points, loop, first, good, guard, slack).slab);
    first = good;
  }
  return slabs;
}

Result<std::vector<geom::Region>> inside_of_slabs(const geom::Ring& points,
                                                  const std::vector<GuardedLoop>& loops,
                                                  const std::vector<Slab>& slabs, double margin) {
  std::vector<geom::Region> pieces;
  for (const Slab& slab : slabs) {
    LEKALO_TRY(auto made, geom::make_region(rectangle(slab, margin)));
    pieces.push_back(std::move(made));
  }
  LEKALO_TRY(const auto band, geom::united(pieces));
  // The pieces are the holes of the band that lie inside the outlines. Where parts of the band lie in such a
  // hole, they are taken out of it.
  const ParityIndex parity(points, loops_of(loops));
  std::vector<geom::Region> faces;
  bool islands = false;
  for (const geom::Region& piece : band.regions) {
    islands = islands || parity.odd(piece.outer.front().from);
    for (const geom::Contour& hole : piece.holes) {
      if (!parity.odd(hole.front().from)) continue;
      auto face = geom::make_region(hole);
      // A sliver without area holds nothing worth having.
      if (face) faces.push_back(*std::move(face));
    }
  }
  if (!islands || faces.empty()) return faces;
  LEKALO_TRY(auto rest,
             geom::combine(faces, band.regions, geom::BooleanOperation::subtract, band.edge_error));
  std::erase_if(rest.regions,
                [&](const geom::Region& piece) { return !parity.odd(piece.outer.front().from); });
  return std::move(rest.regions);
}

std::vector<geom::Region> cut_corners(const std::vector<geom::Region>& regions, double tolerance) {
  if (regions.empty()) return regions;
  CornerCutter cutter(regions, tolerance);
  cutter.cut();
  return cutter.regions(regions);
}

}  // namespace lekalo::locate
