#include "slide_out.hpp"

#include <algorithm>
#include <limits>

#include "lekalo/base/stop.hpp"

namespace lekalo::phi {

using geom::GridPoint;
using geom::GridRegion;
using geom::Point;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Point> about(const GridRegion& region, GridPoint origin) {
  std::vector<Point> points;
  points.reserve(region.points.size());
  for (const GridPoint p : region.points)
    points.push_back({static_cast<double>(p.x - origin.x), static_cast<double>(p.y - origin.y)});
  return points;
}

}  // namespace

SlideOut::SlideOut(const GridRegion& a, const GridRegion& b, GridPoint b_shift, bool outside_of_b)
    : outside_of_b_(outside_of_b) {
  a_.points = about(a, a.points[0]);
  a_.loop_starts = a.loop_starts;
  b_.points = about(b, a.points[0] - b_shift);
  b_.loop_starts = b.loop_starts;
}

void SlideOut::Outline::turn(Point direction) {
  turned.resize(points.size());
  low = kInfinity;
  high = -kInfinity;
  for (std::size_t i = 0; i < points.size(); ++i) {
    turned[i] = {dot(direction, points[i]), cross(direction, points[i])};
    low = std::min(low, turned[i].y);
    high = std::max(high, turned[i].y);
  }
}

void SlideOut::Outline::cross_line(double height, std::vector<double>& places) const {
  ask(1 + turned.size() / 16);
  places.clear();
  for (std::size_t l = 0; l + 1 < loop_starts.size(); ++l) {
    const Point* before = &turned[loop_starts[l + 1] - 1];
    for (std::size_t i = loop_starts[l]; i < loop_starts[l + 1]; ++i) {
      const Point* at = &turned[i];
      if ((before->y > height) != (at->y > height))
        places.push_back(at->x + (before->x - at->x) * ((height - at->y) / (before->y - at->y)));
      before = at;
    }
  }
  std::sort(places.begin(), places.end());
}

/// Step 5 of docs/design/layout-check.md at one height: the first shift beyond all intervals that follow from
/// 0.
double SlideOut::least_at(double height) {
  a_.cross_line(height, line_a_);
  b_.cross_line(height, line_b_);
  if (outside_of_b_) {
    line_b_.insert(line_b_.begin(), -kInfinity);
    line_b_.push_back(kInfinity);
  }
  double distance = 0;
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t i = 0; i + 1 < line_a_.size(); i += 2)
      for (std::size_t j = 0; j + 1 < line_b_.size(); j += 2) {
        ask();
        const double from = line_b_[j] - line_a_[i + 1], to = line_b_[j + 1] - line_a_[i];
        if (from >= distance || to <= distance) continue;
        distance = to;
        moved = distance < kInfinity;
      }
  }
  return distance;
}

void SlideOut::Outline::collect_edges(double from, double to) {
  edges.clear();
  for (std::size_t l = 0; l + 1 < loop_starts.size(); ++l) {
    std::size_t before = loop_starts[l + 1] - 1;
    for (std::size_t i = loop_starts[l]; i < loop_starts[l + 1]; before = i++) {
      const bool upwards = turned[before].y < turned[i].y;
      const Point p = upwards ? turned[before] : turned[i], q = upwards ? turned[i] : turned[before];
      if (p.y == q.y || q.y <= from || p.y >= to) continue;
      edges.push_back({p.y, q.y, p.x, (q.x - p.x) / (q.y - p.y), points[i] - points[before]});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& p, const Edge& q) { return p.low < q.low; });
  active.clear();
  next = 0;
}

void SlideOut::Outline::cross_slab(double bottom, double top) {
  ask(1 + active.size() / 16);
  std::erase_if(active, [&](const Edge* edge) { return edge->high <= bottom; });
  while (next < edges.size() && edges[next].low <= bottom) {
    if (edges[next].high > bottom) active.push_back(&edges[next]);
    ++next;
  }
  crossings.clear();
  for (const Edge* edge : active) crossings.push_back({edge->at(bottom), edge->at(top), edge});
  const auto to_the_left = [](const Crossing& p, const Crossing& q) {
    return p.bottom + p.top < q.bottom + q.top;
  };
  // There are few crossings, and they are mostly in order, so sorting by insertion is quick.
  for (std::size_t i = 1; i < crossings.size(); ++i)
    for (std::size_t j = i; j > 0 && to_the_left(crossings[j], crossings[j - 1]); --j)
      std::swap(crossings[j], crossings[j - 1]);
}

template <class Visit>
bool SlideOut::visit_slabs(Visit&& visit) {
  if (outside_of_b_ && (a_.low < b_.low || a_.high > b_.high)) return false;
  const double low = std::max(a_.low, b_.low), high = std::min(a_.high, b_.high);
  heights_.clear();
  for (const Outline* outline : {&a_, &b_})
    for (const Point p : outline->turned)
      if (low <= p.y && p.y <= high) heights_.push_back(p.y);
  std::sort(heights_.begin(), heights_.end());
  a_.collect_edges(low, high);
  b_.collect_edges(low, high);
  for (std::size_t i = 0; i + 1 < heights_.size(); ++i) {
    const double bottom = heights_[i], top = heights_[i + 1];
    if (!(bottom < top)) continue;
    a_.cross_slab(bottom, top);
    b_.cross_slab(bottom, top);
    // The gaps between the pieces of `b` are what is forbidden now.
    if (outside_of_b_) {
      b_.crossings.insert(b_.crossings.begin(), {-kInfinity, -kInfinity, nullptr});
      b_.crossings.push_back({kInfinity, kInfinity, nullptr});
    }
    if (!visit(bottom, top, a_.crossings, b_.crossings)) return false;
  }
  return true;
}

std::optional<SlideOut::Stop> SlideOut::along(Point direction, double limit) {
  // A gap between forbidden stretches that is narrower than this does not count, because rounding could make
  // it.
  constexpr double kNarrow = 0.5;
  a_.turn(direction);
  b_.turn(direction);
  const double low = std::max(a_.low, b_.low), high = std::min(a_.high, b_.high);
  // A few lines across prove for a tenth of the cost that most directions are too long (step 6).
  if (probe_ && least_at(cross(direction, *probe_)) >= limit) return std::nullopt;
  for (const double share : {0.5, 0.25, 0.75})
    if (least_at(low + share * (high - low)) >= limit) return std::nullopt;
  // Step 5: the strips between neighbouring heights, each with the intervals of shifts that its pieces
  // exclude.
  intervals_.clear();
  Stop stop;
  stop.direction = direction;
  const auto advance = [&](const Interval& interval) {
    if (interval.from >= stop.distance + kNarrow || interval.to <= stop.distance) return false;
    stop.distance = interval.to;
    if (interval.of_a != nullptr) stop.edge_of_a = interval.of_a->direction;
    if (interval.of_b != nullptr) stop.edge_of_b = interval.of_b->direction;
    return true;
  };
  const bool all =
      visit_slabs([&](double, double, const std::vector<Crossing>& a, const std::vector<Crossing>& b) {
        for (std::size_t i = 0; i + 1 < a.size(); i += 2)
          for (std::size_t j = 0; j + 1 < b.size(); j += 2) {
            const Interval interval{std::min(b[j].bottom - a[i + 1].bottom, b[j].top - a[i + 1].top),
                                    std::max(b[j + 1].bottom - a[i].bottom, b[j + 1].top - a[i].top),
                                    a[i].edge, b[j + 1].edge};
            if (interval.to <= stop.distance || interval.from >= limit) continue;
            if (!advance(interval)) intervals_.push_back(interval);
            if (stop.distance >= limit) return false;
          }
        return true;
      });
  if (!all) return std::nullopt;
  for (bool moved = true; moved;) {
    moved = false;
    for (const Interval& interval : intervals_) moved = advance(interval) || moved;
    if (stop.distance >= limit) return std::nullopt;
  }
  return stop;
}

std::optional<Point> SlideOut::place_in_common() {
  double largest = 0;
  std::optional<Point> place;
  a_.turn({1, 0});
  b_.turn({1, 0});
  visit_slabs([&](double bottom, double top, const std::vector<Crossing>& a, const std::vector<Crossing>& b) {
    for (std::size_t i = 0; i + 1 < a.size(); i += 2)
      for (std::size_t j = 0; j + 1 < b.size(); j += 2) {
        const double left = std::max(a[i].bottom + a[i].top, b[j].bottom + b[j].top) / 2;
        const double right = std::min(a[i + 1].bottom + a[i + 1].top, b[j + 1].bottom + b[j + 1].top) / 2;
        const double size = std::min(right - left, top - bottom);
        if (!(size > largest)) continue;
        largest = size;
        place = Point{(left + right) / 2, (bottom + top) / 2};
      }
    return true;
  });
  return place;
}

}  // namespace lekalo::phi
