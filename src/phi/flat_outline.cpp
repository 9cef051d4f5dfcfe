#include "flat_outline.hpp"

#include <algorithm>
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

/// Squared, about.
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

std::vector<GridPoint> inner_points(const FlatOutline& outline) {
  constexpr std::int64_t kAcross = 9;
  constexpr std::size_t kPoints = 4;
  struct Candidate {
    GridPoint at;
    double room;  ///< squared distance to the edges and to the points chosen
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

}  // namespace

FlatOutline flat_outline(GridRegion region) {
  const geom::GridBox box = bounds(region);
  FlatOutline flat;
  flat.region = geom::moved(std::move(region), -box.low);
  flat.width = box.high.x - box.low.x;
  flat.height = box.high.y - box.low.y;
  const auto& p = flat.region.points;
  flat.box = p.size() == 4;
  for (std::size_t i = 0; i < p.size() && flat.box; ++i)
    flat.box = (p[i].x == 0 || p[i].x == flat.width) && (p[i].y == 0 || p[i].y == flat.height);
  flat.inner = inner_points(flat);
  return flat;
}

std::vector<FlatOutline::Span> covered_spans(const FlatOutline& outline, double row) {
  // Steps that positions computed here may be off.
  constexpr double kMargin = 2;
  std::vector<FlatOutline::Span> spans;
  std::vector<std::pair<double, double>> taken;
  for (std::size_t j = 0; static_cast<double>(j) * row <= static_cast<double>(outline.height); ++j) {
    const double low = (static_cast<double>(j) - 1) * row - kMargin,
                 high = (static_cast<double>(j) + 1) * row + kMargin;
    FlatOutline::Span best;
    if (low >= 0 && high <= static_cast<double>(outline.height)) {
      // What edges take of the band; between two of them all is material or nothing.
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
