#include "flat_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace lekalo::phi {
namespace {

using geom::GridPoint;
using geom::GridRegion;

template <class Visit>
void visit_edges(const GridRegion& region, Visit&& visit) {
  for (std::size_t l = 0; l < region.loops(); ++l) {
    GridPoint from = region.points[region.loop_starts[l + 1] - 1];
    for (std::size_t i = region.loop_starts[l]; i < region.loop_starts[l + 1]; ++i) {
      visit(from, region.points[i]);
      from = region.points[i];
    }
  }
}

/// Returns twice the area of a triangle if its sign is certain, else 0. Differences of coordinates are exact.
double certain_turn(double ax, double ay, double bx, double by, double cx, double cy) noexcept {
  const double left = (bx - ax) * (cy - ay), right = (by - ay) * (cx - ax), area = left - right;
  return std::abs(area) > 0x1p-51 * (std::abs(left) + std::abs(right)) ? area : 0;
}

/// Returns the squared distance, roughly.
double distance_to_edges(const GridRegion& region, GridPoint p) {
  double least = HUGE_VAL;
  visit_edges(region, [&](GridPoint from, GridPoint to) {
    const double dx = static_cast<double>(to.x - from.x), dy = static_cast<double>(to.y - from.y);
    const double px = static_cast<double>(p.x - from.x), py = static_cast<double>(p.y - from.y);
    const double share = std::clamp((px * dx + py * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    const double x = px - share * dx, y = py - share * dy;
    least = std::min(least, x * x + y * y);
  });
  return least;
}

}  // namespace

Overlap quick_overlap(const FlatOutline& a, const FlatOutline& b, GridPoint shift) noexcept {
  using Edge = FlatOutline::Edge;
  constexpr std::size_t kMost = 64;
  std::array<Edge, kMost> near;
  std::size_t count = 0;
  // The boxes have this part in common, and edges beyond it meet nothing.
  const double dx = static_cast<double>(shift.x), dy = static_cast<double>(shift.y);
  const double left = std::max(0.0, dx),
               right = std::min(static_cast<double>(a.width), dx + static_cast<double>(b.width));
  const double bottom = std::max(0.0, dy),
               top = std::min(static_cast<double>(a.height), dy + static_cast<double>(b.height));
  if (left >= right || bottom >= top) return Overlap::no;
  const auto beyond = [&](const Edge& e) {
    return (e.x0 < left && e.x1 < left) || (e.x0 > right && e.x1 > right) ||
           (e.y0 < bottom && e.y1 < bottom) || (e.y0 > top && e.y1 > top);
  };
  for (const Edge& edge : b.edges) {
    const Edge moved{edge.x0 + dx, edge.y0 + dy, edge.x1 + dx, edge.y1 + dy};
    if (beyond(moved)) continue;
    if (count == kMost) return Overlap::unsure;
    near[count++] = moved;
  }
  bool touch = false;
  for (const Edge& e : a.edges) {
    if (beyond(e)) continue;
    const double low_x = std::min(e.x0, e.x1), high_x = std::max(e.x0, e.x1);
    const double low_y = std::min(e.y0, e.y1), high_y = std::max(e.y0, e.y1);
    for (std::size_t i = 0; i < count; ++i) {
      const Edge& f = near[i];
      if (std::max(f.x0, f.x1) < low_x || std::min(f.x0, f.x1) > high_x || std::max(f.y0, f.y1) < low_y ||
          std::min(f.y0, f.y1) > high_y)
        continue;
      const double f0 = certain_turn(e.x0, e.y0, e.x1, e.y1, f.x0, f.y0),
                   f1 = certain_turn(e.x0, e.y0, e.x1, e.y1, f.x1, f.y1);
      if ((f0 > 0 && f1 > 0) || (f0 < 0 && f1 < 0)) continue;
      const double e0 = certain_turn(f.x0, f.y0, f.x1, f.y1, e.x0, e.y0),
                   e1 = certain_turn(f.x0, f.y0, f.x1, f.y1, e.x1, e.y1);
      if ((e0 > 0 && e1 > 0) || (e0 < 0 && e1 < 0)) continue;
      if (f0 != 0 && f1 != 0 && e0 != 0 && e1 != 0) return Overlap::yes;
      touch = true;
    }
  }
  if (touch) return Overlap::unsure;
  // Outlines that do not meet lie in each other or apart. Only an outline whose box lies in the other's can
  // lie in it.
  const auto held = [](const FlatOutline& holder, const FlatOutline& one, GridPoint at) {
    return at.x >= 0 && at.y >= 0 && at.x + one.width <= holder.width && at.y + one.height <= holder.height &&
           locate_point(holder.region, one.region.points[0] + at) == geom::PointLocation::inside;
  };
  return held(a, b, shift) || held(b, a, -shift) ? Overlap::yes : Overlap::no;
}

FlatOutline flat_outline(GridRegion region) {
  const geom::GridBox box = bounds(region);
  FlatOutline flat;
  flat.region = geom::moved(std::move(region), -box.low);
  flat.width = box.high.x - box.low.x;
  flat.height = box.high.y - box.low.y;
  const auto& p = flat.region.points;
  visit_edges(flat.region, [&](GridPoint from, GridPoint to) {
    flat.edges.push_back({static_cast<double>(from.x), static_cast<double>(from.y), static_cast<double>(to.x),
                          static_cast<double>(to.y)});
  });
  flat.box = p.size() == 4;
  for (std::size_t i = 0; i < p.size() && flat.box; ++i)
    flat.box = (p[i].x == 0 || p[i].x == flat.width) && (p[i].y == 0 || p[i].y == flat.height);
  return flat;
}

std::vector<GridPoint> inner_points(const FlatOutline& outline) {
  constexpr std::int64_t kAcross = 9;
  constexpr std::size_t kPoints = 4;
  struct Candidate {
    GridPoint at;
    /// The squared distance to the edges and to the points chosen so far.
    double room;
  };
  std::vector<Candidate> candidates;
  for (std::int64_t y = 1; y <= kAcross; ++y)
    for (std::int64_t x = 1; x <= kAcross; ++x) {
      const GridPoint p{outline.width * x / (kAcross + 1), outline.height * y / (kAcross + 1)};
      if (locate_point(outline.region, p) == geom::PointLocation::inside)
        candidates.push_back({p, distance_to_edges(outline.region, p)});
    }
  std::vector<GridPoint> chosen;
  while (chosen.size() < kPoints && !candidates.empty()) {
    const auto best =
        std::max_element(candidates.begin(), candidates.end(),
                         [](const Candidate& a, const Candidate& b) { return a.room < b.room; });
    const GridPoint p = best->at;
    chosen.push_back(p);
    candidates.erase(best);
    for (Candidate& one : candidates)
      one.room = std::min(one.room, 0.25 * static_cast<double>(dot(one.at - p, one.at - p)));
  }
  return chosen;
}

std::vector<FlatOutline::Span> covered_spans(const FlatOutline& outline, double row) {
  // Positions computed here may be off by this many steps.
  constexpr double kMargin = 2;
  std::vector<FlatOutline::Span> spans;
  std::vector<std::pair<double, double>> taken;
  for (std::size_t j = 0; static_cast<double>(j) * row <= static_cast<double>(outline.height); ++j) {
    const double low = (static_cast<double>(j) - 1) * row - kMargin,
                 high = (static_cast<double>(j) + 1) * row + kMargin;
    FlatOutline::Span best;
    if (low >= 0 && high <= static_cast<double>(outline.height)) {
      // The list holds the parts of the band that edges pass. Between two of them the band is all material or
      // has none.
      taken.clear();
      visit_edges(outline.region, [&](GridPoint from, GridPoint to) {
        const double x = static_cast<double>(from.x), y = static_cast<double>(from.y);
        const double dx = static_cast<double>(to.x) - x, dy = static_cast<double>(to.y) - y;
        if (std::max(y, y + dy) < low || std::min(y, y + dy) > high) return;
        double a = 0, b = 1;
        if (dy != 0) a = std::clamp((low - y) / dy, 0.0, 1.0), b = std::clamp((high - y) / dy, 0.0, 1.0);
        taken.emplace_back(std::min(x + a * dx, x + b * dx) - kMargin,
                           std::max(x + a * dx, x + b * dx) + kMargin);
      });
      std::sort(taken.begin(), taken.end());
      const auto middle_y = static_cast<std::int64_t>((low + high) / 2);
      double end = taken.empty() ? 0 : taken.front().second;
      for (const auto& [from, to] : taken) {
        const auto first = static_cast<std::int64_t>(end) + 1, last = static_cast<std::int64_t>(from) - 1;
        if (last - first > best.high - best.low &&
            locate_point(outline.region, {first + (last - first) / 2, middle_y}) ==
                geom::PointLocation::inside)
          best = {first, last};
        end = std::max(end, to);
      }
    }
    spans.push_back(best);
  }
  return spans;
}

}  // namespace lekalo::phi
