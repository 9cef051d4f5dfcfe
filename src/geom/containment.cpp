#include "lekalo/geom/containment.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>

#include "lekalo/geom/predicates.hpp"
#include "monotone.hpp"

namespace lekalo::geom {
namespace detail {
namespace {

/// A monotone part of a contour, upright.
struct Part {
  Monotone shape;
  Point low, high;
  std::uint32_t contour = 0, number = 0;
  bool upwards = false;
};

double x_at(const Part& part, double y) {
  if (!part.shape.is_line()) return arc_x_at(part.shape, y);
  return part.low.x + (y - part.low.y) / (part.high.y - part.low.y) * (part.high.x - part.low.x);
}

/// The order from left to right of parts that are cut by one level line. Parts that do not cross keep their
/// order between all the levels that they share, so it is taken half way.
struct FromLeft {
  using is_transparent = void;

  bool operator()(const Part* a, const Part* b) const {
    if (a == b) return false;
    if (a->shape.is_line() && b->shape.is_line()) {
      if (a->low == b->low)
        if (const int turn = orientation(a->low, a->high, b->high)) return turn < 0;
      if (a->high == b->high)
        if (const int turn = orientation(a->high, a->low, b->low)) return turn > 0;
    }
    const double y = 0.5 * std::max(a->low.y, b->low.y) + 0.5 * std::min(a->high.y, b->high.y);
    const double of_a = x_at(*a, y), of_b = x_at(*b, y);
    return of_a != of_b ? of_a < of_b : a->number < b->number;
  }
  bool operator()(const Part* a, const Point& p) const {
    if (a->shape.is_line()) return orientation(a->low, a->high, p) < 0;
    return x_at(*a, p.y) < p.x;
  }
};

/// At one level contours are asked about first, so that a contour is not among the parts that it is held
/// against, and parts end before others begin.
enum class What : std::uint8_t { ask, end, begin };
struct Event {
  double y;
  What what;
  std::uint32_t number;  ///< of a contour or of a part
};

class Sweep {
 public:
  explicit Sweep(const std::vector<const Contour*>& contours) : contours_(contours) {
    std::size_t edges = 0;
    for (const Contour* contour : contours) edges += contour->size();
    curves_.reserve(edges);
    for (std::uint32_t c = 0; c < contours.size(); ++c) add(c);
    std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
      return std::tie(a.y, a.what, a.number) < std::tie(b.y, b.what, b.number);
    });
  }

  std::vector<Enclosed> run() {
    std::vector<Enclosed> found(contours_.size());
    std::multiset<const Part*, FromLeft> cut;
    std::vector<std::multiset<const Part*, FromLeft>::iterator> place(parts_.size(), cut.end());
    for (const Event& event : events_) {
      switch (event.what) {
        case What::begin:
          place[event.number] = cut.insert(&parts_[event.number]);
          break;
        case What::end:
          cut.erase(place[event.number]);
          break;
        case What::ask: {
          const auto next = cut.lower_bound(lowest_[event.number]);
          if (next == cut.begin()) break;
          const Part& left = **std::prev(next);
          // The place to the right of a part is inside its contour or beside it, and then the same is around
          // both.
          const bool inside = left.upwards != anticlockwise_[left.contour];
          const std::size_t by = inside ? left.contour : found[left.contour].by;
          if (by != kNoContour) found[event.number] = {by, found[by].depth + 1};
          break;
        }
      }
    }
    return found;
  }

 private:
  void add(std::uint32_t c) {
    Point lowest = contours_[c]->front().from;
    for (const Edge& edge : *contours_[c]) {
      visit_monotone(curves_.emplace_back(make_curve(edge)), [&](const Monotone& shape) {
        const bool rises = shape.begin.y < shape.end.y;
        Part part{shape, rises ? shape.begin : shape.end,           rises ? shape.end : shape.begin,
                  c,     static_cast<std::uint32_t>(parts_.size()), rises != (edge.kind == EdgeKind::arc_cw)};
        if (std::tie(part.low.y, part.low.x) < std::tie(lowest.y, lowest.x)) lowest = part.low;
        if (!(part.low.y < part.high.y)) return;
        events_.push_back({part.low.y, What::begin, part.number});
        events_.push_back({part.high.y, What::end, part.number});
        parts_.push_back(part);
      });
    }
    lowest_.push_back(lowest);
    anticlockwise_.push_back(signed_area(*contours_[c]) > 0);
    events_.push_back({lowest.y, What::ask, c});
  }

  const std::vector<const Contour*>& contours_;
  std::vector<Curve> curves_;
  std::vector<Part> parts_;
  std::vector<Event> events_;
  std::vector<Point> lowest_;
  std::vector<bool> anticlockwise_;
};

}  // namespace
}  // namespace detail

std::vector<Enclosed> enclosed_contours(const std::vector<const Contour*>& contours) {
  return detail::Sweep(contours).run();
}

}  // namespace lekalo::geom
