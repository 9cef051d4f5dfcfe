#include "outline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

namespace lekalo::verify {
namespace {

/// Returns indices ordered by x, then y. Of equal points only the first in the file stays.
std::vector<std::size_t> sorted_distinct(const Ring& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&points](std::size_t i, std::size_t j) {
    return std::tie(points[i].x, points[i].y) < std::tie(points[j].x, points[j].y);
  });
  order.erase(std::unique(order.begin(), order.end(),
                          [&points](std::size_t i, std::size_t j) { return points[i] == points[j]; }),
              order.end());
  return order;
}

/// Finds the hull by the monotone chain (Andrew 1979), the lower half and then the upper one. Only corners
/// with a strict left turn stay.
std::vector<std::size_t> convex_hull(const Ring& points) {
  std::vector<std::size_t> order = sorted_distinct(points);
  std::vector<std::size_t> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t base = hull.size();
    for (const std::size_t i : order) {
      while (hull.size() >= base + 2 && cross(points[hull.back()] - points[hull[hull.size() - 2]],
                                              points[i] - points[hull.back()]) <= 0) {
        hull.pop_back();
      }
      hull.push_back(i);
    }
    // The last corner of this half is the first one of the other half.
    hull.pop_back();
    std::reverse(order.begin(), order.end());
  }
  return hull;
}

void measure_dents(Outline& outline) {
  const std::size_t n = outline.points.size();
  for (std::size_t j = 0; j < outline.hull.size(); ++j) {
    const Point side = outline.side(j);
    const std::size_t from = outline.hull[j], to = outline.hull[(j + 1) % outline.hull.size()];
    Integer deepest = 0;
    for (std::size_t i = from; i != to;) {
      i = outline.counter_clockwise ? (i + 1) % n : (i + n - 1) % n;
      deepest = std::max(deepest, cross(side, outline.points[i] - outline.corner(j)));
    }
    outline.dents.push_back(deepest);
  }
}

}  // namespace

bool Outline::convex() const {
  return std::all_of(dents.begin(), dents.end(), [](const Integer& dent) { return dent == 0; });
}

Result<Outline> make_outline(Ring points, std::string_view name) {
  Outline outline;
  outline.points = std::move(points);
  outline.hull = convex_hull(outline.points);
  if (outline.hull.size() < 3)
    return failure(ErrorCode::bad_input, fmt::format("{}: the contour has no area", name));
  std::vector<std::size_t> around = outline.hull;
  std::rotate(around.begin(), std::min_element(around.begin(), around.end()), around.end());
  outline.counter_clockwise = std::is_sorted(around.begin(), around.end());
  if (!outline.counter_clockwise && !std::is_sorted(around.rbegin(), std::prev(around.rend()))) {
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: the contour does not run once around its convex hull", name));
  }
  measure_dents(outline);
  return outline;
}

std::size_t lowest_corner(const Outline& outline, const Point& direction, std::size_t start) {
  const std::size_t n = outline.hull.size();
  const auto lower = [&](std::size_t i, std::size_t j) {
    return cross(direction, outline.corner(i) - outline.corner(j)) < 0;
  };
  std::size_t at = start % n;
  for (const std::size_t step : {std::size_t{1}, n - 1}) {
    while (lower(at + step, at)) at = (at + step) % n;
  }
  return at;
}

namespace {

/// Step 7 of docs/design/verify.md: says whether the open segment from a to b meets the interior of the hull.
/// It does where the stretch on the left of every side is not empty.
/// \pre no side of the hull has a and b both on its right or on its line
bool enters(const Point& a, const Point& b, const Outline& hull) {
  Fraction low = 0, high = 1;
  for (std::size_t j = 0; j < hull.hull.size(); ++j) {
    const Point side = hull.side(j);
    const Integer at_a = cross(side, a - hull.corner(j)), at_b = cross(side, b - hull.corner(j));
    // The wanted t have at_a + t slope > 0.
    const Integer slope = at_b - at_a;
    if (slope > 0) {
      low = std::max<Fraction>(low, Fraction(-at_a) / Fraction(slope));
    } else if (slope < 0) {
      high = std::min<Fraction>(high, Fraction(-at_a) / Fraction(slope));
    }
    if (low >= high) return false;
  }
  return true;
}

/// Returns how often the outline winds around p / scale.
/// \pre p does not lie on the outline
long winding_number(const Outline& outline, const Point& p, long scale) {
  const std::size_t n = outline.points.size();
  long winding = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Point a{outline.points[i].x * scale, outline.points[i].y * scale};
    const Point& next = outline.points[(i + 1) % n];
    const Point b{next.x * scale, next.y * scale};
    // An edge that comes up to p's height counts where p is on its left, one that goes down on its right.
    const int way = (a.y <= p.y) - (b.y <= p.y);
    if (way == sgn(cross(b - a, p - a))) winding += way;
  }
  return winding;
}

}  // namespace

bool lies_inside(const Outline& inner, const Outline& outer, std::size_t& culprit) {
  const std::size_t n = outer.points.size();
  // The side of `inner` that kept the last edge out most likely keeps out the next one too, or else a side
  // further on in the way that `outer` runs.
  const std::size_t m = inner.hull.size(), step = outer.counter_clockwise ? 1 : m - 1;
  std::size_t side = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Point &a = outer.points[i], &b = outer.points[(i + 1) % n];
    const auto keeps_out = [&](std::size_t j) {
      return cross(inner.side(j), a - inner.corner(j)) <= 0 && cross(inner.side(j), b - inner.corner(j)) <= 0;
    };
    std::size_t left = m;
    for (; left > 0 && !keeps_out(side); --left) side += step;
    if (left > 0) continue;
    culprit = i;
    if (enters(a, b, inner)) return false;
  }
  const Point middle{inner.corner(0).x + inner.corner(1).x + inner.corner(2).x,
                     inner.corner(0).y + inner.corner(1).y + inner.corner(2).y};
  culprit = 0;
  return winding_number(outer, middle, 3) != 0;
}

}  // namespace lekalo::verify
