#include "lekalo/phi/slide.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lekalo/base/stop.hpp"

namespace lekalo::phi {
namespace {

using geom::GridBox;
using geom::GridPoint;
using geom::GridRegion;
using geom::Point;

Point in_doubles(GridPoint p) noexcept { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

/// Step 1 of docs/design/slide.md: collects the places s in [0, length] at which the way p + s u enters or
/// leaves the region within `gap` of a segment.
class Crossings {
 public:
  Crossings(Point direction, double length, double gap, std::vector<double>& events)
      : direction_(direction), length_(length), gap_(gap), events_(events) {}

  /// Adds the sides of the band along the edge, and the disc around its first end. The disc around its other
  /// end comes with the edge that begins there.
  void add(Point p, Point from, Point to) {
    const Point edge = to - from;
    const double size = norm(edge), across = cross(direction_, edge) / size;
    const Point out = p - from;
    if (gap_ > 0) {
      side(out, edge, size, across, gap_);
      side(out, edge, size, across, -gap_);
      disc(out);
    } else if (across != 0) {
      side(out, edge, size, across, 0);
    } else {
      // The way runs along the edge's own line, so the edge's beginning is the event.
      push(-dot(out, direction_));
    }
  }

 private:
  /// Adds the line at `offset` left of the edge, between perpendiculars at its ends.
  void side(Point out, Point edge, double size, double across, double offset) {
    if (across == 0) return;
    const double height = cross(edge, out) / size;  // left of the edge
    const double s = (height - offset) / across;
    const double along = dot(out + s * direction_, edge);
    // The reserve is generous, so that rounding only adds events.
    const double reserve = 1e-9 * size * size + 4 * size;
    if (along >= -reserve && along <= size * size + reserve) push(s);
  }
  void disc(Point centre_to_p) {
    const double middle = -dot(centre_to_p, direction_), off = cross(direction_, centre_to_p);
    const double half_squared = gap_ * gap_ - off * off;
    if (!(half_squared >= 0)) return;
    const double half = std::sqrt(half_squared);
    push(middle - half);
    push(middle + half);
  }
  void push(double s) {
    if (s > 0 && s < length_) events_.push_back(s);
  }

  Point direction_;
  double length_, gap_;
  std::vector<double>& events_;
};

struct SweptBox {
  Point low, high;
  [[nodiscard]] bool meets(Point a, Point b) const noexcept {
    return std::min(a.x, b.x) <= high.x && std::max(a.x, b.x) >= low.x && std::min(a.y, b.y) <= high.y &&
           std::max(a.y, b.y) >= low.y;
  }
};

/// Returns the window that a box sweeps on its way, with `reach` around it.
SweptBox swept(const GridBox& box, Point from, Point way, double reach) noexcept {
  const Point low = in_doubles(box.low) + from, high = in_doubles(box.high) + from;
  return {{low.x + std::min(0.0, way.x) - reach, low.y + std::min(0.0, way.y) - reach},
          {high.x + std::max(0.0, way.x) + reach, high.y + std::max(0.0, way.y) + reach}};
}

/// Adds the places where points of `one` meet edges of `other` along `direction`, each outline in its place.
void add_all(const GridRegion& one, Point one_at, const GridRegion& other, Point other_at, Point direction,
             double length, std::int64_t gap, std::vector<double>& events) {
  const double reach = static_cast<double>(gap) + 4;
  const Point way = length * direction;
  Crossings crossings(direction, length, static_cast<double>(gap), events);
  const SweptBox window = swept(bounds(one), one_at, way, reach);
  const SweptBox from_other = swept(bounds(other), other_at, -way, reach);
  std::vector<Point> points;
  for (const GridPoint p : one.points) {
    const Point at = in_doubles(p) + one_at;
    if (from_other.meets(at, at)) points.push_back(at);
  }
  if (points.empty()) return;
  for (std::size_t l = 0; l < other.loops(); ++l) {
    const std::uint32_t begin = other.loop_starts[l], end = other.loop_starts[l + 1];
    Point from = in_doubles(other.points[end - 1]) + other_at;
    for (std::uint32_t i = begin; i < end; ++i) {
      lekalo::ask(1 + points.size() / 16);
      const Point to = in_doubles(other.points[i]) + other_at;
      if (window.meets(from, to)) {
        const SweptBox near{{std::min(from.x, to.x) - reach + std::min(0.0, -way.x),
                             std::min(from.y, to.y) - reach + std::min(0.0, -way.y)},
                            {std::max(from.x, to.x) + reach + std::max(0.0, -way.x),
                             std::max(from.y, to.y) + reach + std::max(0.0, -way.y)}};
        for (const Point p : points)
          if (near.meets(p, p)) crossings.add(p, from, to);
      }
      from = to;
    }
  }
}

/// Step 4: the grid point of the path itself, then its neighbours, the nearest first.
constexpr std::array<GridPoint, 9> kBeside = {
    {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};

std::optional<GridPoint> valid_near(GridPoint p, const std::function<bool(GridPoint)>& valid) {
  for (const GridPoint d : kBeside)
    if (valid(p + d)) return p + d;
  return std::nullopt;
}

}  // namespace

GridPoint SlidePath::at(double s) const noexcept {
  return {start.x + static_cast<std::int64_t>(std::nearbyint(s * direction.x)),
          start.y + static_cast<std::int64_t>(std::nearbyint(s * direction.y))};
}

void append_slide_events(const GridRegion& moving, const SlidePath& path, const GridRegion& fixed,
                         GridPoint fixed_at, std::int64_t gap, std::vector<double>& events) {
  // Coordinates are taken from the start of the way, so that differences stay exact.
  const Point there = in_doubles(fixed_at - path.start);
  add_all(moving, {}, fixed, there, path.direction, path.length, gap, events);
  add_all(fixed, there, moving, {}, -path.direction, path.length, gap, events);
}

SlideEnd slide(const SlidePath& path, std::vector<double> events,
               const std::function<bool(GridPoint)>& valid) {
  // Intervals shorter than this are not asked about. So each question is asked at least 2 steps from the
  // events on either side.
  constexpr double kShortest = 4;  // steps
  events.push_back(path.length);
  std::sort(events.begin(), events.end());
  double open = 0, event = 0, shut = path.length;  // open: reached
  GridPoint reached = path.start;
  bool blocked = false;
  const auto ask = [&](double s) {
    const auto place = valid_near(path.at(s), valid);
    if (place) {
      open = s;
      reached = *place;
    } else {
      shut = s;
      blocked = true;
    }
  };
  // Step 2: one question between two neighbouring events answers for all of the interval.
  for (const double next : events) {
    if (next - event >= kShortest) {
      ask(event + (next - event) / 2);
      if (blocked) break;
    }
    event = next;
  }
  if (!blocked && path.length > open) ask(path.length);
  // Step 3: halving. At the end the points of the way at `open` and `shut` are the same or neighbours. The
  // place that was reached lies beside the one, and nothing beside the other is valid. So some neighbour of
  // the place is not valid, and the gap is kept with less than sqrt(2) steps to spare.
  while (blocked && shut - open > 0.5) ask(open + (shut - open) / 2);
  return {reached, open, blocked};
}

}  // namespace lekalo::phi
