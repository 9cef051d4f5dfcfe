#include "scan_order.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/predicates.hpp"
#include "parity_index.hpp"
#include "point_hash.hpp"

namespace lekalo::locate {
namespace {

using geom::Point;

/// More loose ends than this do not come from a few gaps in coverage.
constexpr std::size_t kMostLooseEnds = 512;
/// The choice of a loose end is a guess when another one is less than this times as far.
constexpr double kClearlyNearer = 1.25;

double distance(Point a, Point b) { return norm(a - b); }

std::vector<std::uint32_t> spread_points(const geom::Ring& points, const std::vector<std::uint32_t>& sorted,
                                         double spread) {
  std::vector<std::uint32_t> chosen;
  PointHash hash(spread, 1024, geom::largest_coordinate(points));
  for (const std::uint32_t i : sorted) {
    bool covered = false;
    hash.visit_near(points[i], spread,
                    [&](std::uint32_t j) { covered = covered || distance(points[i], points[j]) < spread; });
    if (covered) continue;
    hash.insert(i, points[i]);
    chosen.push_back(i);
  }
  return chosen;
}

/// The chosen points, each with up to two neighbours.
class Links {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  Links(const geom::Ring& points, std::vector<std::uint32_t> chosen)
      : points_(points), chosen_(std::move(chosen)), links_(chosen_.size(), {kNone, kNone}) {}

  Result<void> link_relative_neighbours(double link) {
    PointHash hash(link, chosen_.size(), geom::largest_coordinate(points_));
    for (std::uint32_t i = 0; i < chosen_.size(); ++i) hash.insert(i, at(i));
    std::vector<std::pair<double, std::uint32_t>> near;
    for (std::uint32_t i = 0; i < chosen_.size(); ++i) {
      ask();
      near.clear();
      hash.visit_near(at(i), link, [&](std::uint32_t j) {
        const double d = distance(at(i), at(j));
        if (j != i && d <= link) near.push_back({d, j});
      });
      std::sort(near.begin(), near.end());
      std::size_t degree = 0;
      for (std::size_t k = 0; k < near.size(); ++k) {
        const double d = near[k].first;
        const std::uint32_t j = near[k].second;
        const bool blocked = std::any_of(
            near.begin(), near.begin() + static_cast<std::ptrdiff_t>(k),
            [&](const auto& third) { return third.first < d && distance(at(third.second), at(j)) < d; });
        if (blocked) continue;
        if (degree == 2) {
          return failure(
              ErrorCode::bad_input,
              fmt::format(
                  "near {} the neighbours of a point cannot be told: walls, corners or noise there are "
                  "finer than {:.3g} mm; give the points in order along the contour, a smaller --step, "
                  "or the probe's true uncertainty",
                  place_of(at(i)), link));
        }
        links_[i][degree++] = j;
      }
    }
    return {};
  }

  Result<void> join_loose_ends() {
    std::vector<std::uint32_t> ends;
    for (std::uint32_t i = 0; i < chosen_.size(); ++i)
      for (std::size_t k = degree(i); k < 2; ++k) ends.push_back(i);
    if (ends.empty()) return {};
    if (ends.size() > kMostLooseEnds) {
      return failure(ErrorCode::bad_input,
                     fmt::format("the points form no closed contours: {} loose ends, one near {}; is --step "
                                 "smaller than the spacing of the points?",
                                 ends.size(), place_of(at(ends.front()))));
    }
    while (!ends.empty()) {
      LEKALO_CHECK(join_nearest(ends));
    }
    return {};
  }

  [[nodiscard]] Result<std::vector<Loop>> loops() const {
    std::vector<Loop> made;
    std::vector<bool> seen(chosen_.size(), false);
    for (std::uint32_t start = 0; start < chosen_.size(); ++start) {
      if (seen[start]) continue;
      Loop loop;
      std::uint32_t before = kNone;
      for (std::uint32_t i = start; !seen[i];) {
        seen[i] = true;
        loop.push_back(chosen_[i]);
        const std::uint32_t next = links_[i][0] != before ? links_[i][0] : links_[i][1];
        before = std::exchange(i, next);
      }
      if (loop.size() < 3) return stands_alone(start);
      made.push_back(std::move(loop));
    }
    return made;
  }

 private:
  [[nodiscard]] Point at(std::uint32_t i) const { return points_[chosen_[i]]; }
  [[nodiscard]] std::size_t degree(std::uint32_t i) const {
    return links_[i][0] == kNone ? 0U : links_[i][1] == kNone ? 1U : 2U;
  }
  [[nodiscard]] bool linked(std::uint32_t i, std::uint32_t j) const {
    return links_[i][0] == j || links_[i][1] == j;
  }
  [[nodiscard]] tl::unexpected<Error> stands_alone(std::uint32_t i) const {
    return failure(ErrorCode::bad_input,
                   fmt::format("the point at {} belongs to no closed contour; measure there again, or leave "
                               "out points that stand alone with --drop-outliers",
                               place_of(at(i))));
  }

  /// Returns the end of the chain that begins at `start`, going along links.
  [[nodiscard]] std::uint32_t other_end(std::uint32_t start) const {
    std::uint32_t before = kNone, i = start;
    while (true) {
      const std::uint32_t next = links_[i][0] != before ? links_[i][0] : links_[i][1];
      if (next == kNone || next == start) return i;
      before = std::exchange(i, next);
    }
  }

  Result<void> join_nearest(std::vector<std::uint32_t>& ends) {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t a = kNone, b = kNone;
    for (std::size_t m = 0; m < ends.size(); ++m)
      for (std::size_t n = m + 1; n < ends.size(); ++n) {
        if (ends[m] == ends[n] || linked(ends[m], ends[n])) continue;
        const double d = distance(at(ends[m]), at(ends[n]));
        if (d < least) least = d, a = ends[m], b = ends[n];
      }
    if (a == kNone) return stands_alone(ends.front());
    const std::uint32_t far_a = other_end(a), far_b = other_end(b);
    for (const std::uint32_t c : ends) {
      if (c == a || c == b || c == far_a || c == far_b) continue;
      if (distance(at(a), at(c)) < kClearlyNearer * least ||
          distance(at(b), at(c)) < kClearlyNearer * least) {
        return failure(
            ErrorCode::bad_input,
            fmt::format("the contour is not measured near {}, and how it goes on there is not clear: "
                        "loose ends at {} and {}; measure there, or give the points in order",
                        place_of(at(a)), place_of(at(b)), place_of(at(c))));
      }
    }
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
      links_[i][degree(i)] = j;
      ends.erase(std::find(ends.begin(), ends.end(), i));
    }
    return {};
  }

  const geom::Ring& points_;
  std::vector<std::uint32_t> chosen_;
  std::vector<std::array<std::uint32_t, 2>> links_;
};

}  // namespace

std::string place_of(Point p) { return fmt::format("({:.4g}, {:.4g})", p.x, p.y); }

double median_nearest(const geom::Ring& points, const std::vector<std::uint32_t>& sorted) {
  // Cells are about as wide as the spacing of the points, if they lie along an outline around all but the
  // outermost 2 % of them.
  const std::size_t n = sorted.size();
  std::vector<double> x, y;
  for (const std::uint32_t i : sorted) x.push_back(points[i].x), y.push_back(points[i].y);
  const auto extent = [&](std::vector<double>& v) {
    const auto low = v.begin() + static_cast<std::ptrdiff_t>(n / 100),
               high = v.begin() + static_cast<std::ptrdiff_t>(n - 1 - n / 100);
    std::nth_element(v.begin(), low, v.end());
    const double from = *low;
    std::nth_element(v.begin(), high, v.end());
    return *high - from;
  };
  double farthest = 0;
  for (const std::uint32_t i : sorted)
    farthest = std::max({farthest, std::abs(points[i].x), std::abs(points[i].y)});
  double cell = 8 * std::max(extent(x), extent(y)) / static_cast<double>(n);
  if (!(cell > 0x1p-40 * farthest)) cell = std::max(0x1p-40 * farthest, 1e-90);
  PointHash hash(cell, n, farthest);
  for (const std::uint32_t i : sorted) hash.insert(i, points[i]);
  std::vector<double> nearest;
  const std::size_t stride = std::max<std::size_t>(1, n / 2000);
  for (std::size_t k = 0; k < n; k += stride) {
    ask();
    const Point p = points[sorted[k]];
    double least = std::numeric_limits<double>::infinity();
    for (double reach = cell; reach <= 8 * cell && !(least <= reach); reach *= 2) {
      hash.visit_near(p, reach, [&](std::uint32_t j) {
        if (j != sorted[k]) least = std::min(least, distance(p, points[j]));
      });
    }
    nearest.push_back(std::isfinite(least) ? least : 8 * cell);
  }
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2),
                   nearest.end());
  return nearest[nearest.size() / 2];
}

std::vector<std::uint32_t> lonely_points(const geom::Ring& points, double reach) {
  // Points that share a small cell have company, and only the others look around.
  const double largest = geom::largest_coordinate(points);
  PointHash firsts(reach / 2, points.size(), largest), all(reach / 2, points.size(), largest);
  std::vector<bool> company(points.size(), false);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    bool empty = true;
    firsts.visit_cell(firsts.index(points[i].x), firsts.index(points[i].y), [&](std::uint32_t j) {
      empty = false;
      if (distance(points[i], points[j]) <= reach) company[i] = company[j] = true;
    });
    if (empty) firsts.insert(i, points[i]);
    all.insert(i, points[i]);
  }
  std::vector<std::uint32_t> lonely;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (company[i]) continue;
    bool found = false;
    all.visit_near(points[i], reach, [&](std::uint32_t j) {
      found = found || (j != i && distance(points[i], points[j]) <= reach);
    });
    if (!found) lonely.push_back(i);
  }
  return lonely;
}

Result<std::vector<Loop>> order_points(const geom::Ring& points, const std::vector<std::uint32_t>& sorted,
                                       double spread, double link) {
  Links links(points, spread_points(points, sorted, spread));
  LEKALO_CHECK(links.link_relative_neighbours(link));
  LEKALO_CHECK(links.join_loose_ends());
  return links.loops();
}

void turn_material_left(const geom::Ring& points, std::vector<Loop>& loops) {
  const ParityIndex parity(points, loops);
  for (std::uint32_t i = 0; i < loops.size(); ++i) {
    geom::Ring ring;
    for (const std::uint32_t v : loops[i]) ring.push_back(points[v]);
    const bool hole = loops.size() > 1 && parity.odd(ring.front(), i);
    if ((geom::signed_area(ring) < 0) != hole) std::reverse(loops[i].begin() + 1, loops[i].end());
  }
}

}  // namespace lekalo::locate
