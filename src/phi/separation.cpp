#include "lekalo/phi/separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "lekalo/phi/outline_relation.hpp"
#include "slide_out.hpp"

namespace lekalo::phi {
namespace {

using geom::GridBox;
using geom::GridPoint;
using geom::GridRegion;
using geom::Point;

/// Cosine and sine of 1/16 and 1/128 of a turn: the angle between the rays of the fan, and the first step
/// between them.
constexpr Point kFanStep{0.92387953251128674, 0.38268343236508978};
constexpr Point kFineStep{0.99879545620517241, 0.049067674327418015};

Point turned_by(Point p, Point by) noexcept { return {by.x * p.x - by.y * p.y, by.y * p.x + by.x * p.y}; }
// Returns half the angle, below half a turn.
Point halved(Point by) noexcept {
  const Point sum{1 + by.x, by.y};
  return (1 / norm(sum)) * sum;
}
Point opposite_turn(Point by) noexcept { return {by.x, -by.y}; }

/// Returns the shift along one axis that moves a box least out of another.
GridPoint box_shift_out(const GridBox& a, const GridBox& b) noexcept {
  const std::array<GridPoint, 4> shifts{
      {{b.high.x - a.low.x, 0}, {b.low.x - a.high.x, 0}, {0, b.high.y - a.low.y}, {0, b.low.y - a.high.y}}};
  return *std::min_element(shifts.begin(), shifts.end(),
                           [](GridPoint p, GridPoint q) { return dot(p, p) < dot(q, q); });
}

/// Returns the shift that brings a box into another. A box larger than the other is not moved.
GridPoint box_shift_in(const GridBox& a, const GridBox& outer) noexcept {
  const auto axis = [](std::int64_t low, std::int64_t high, std::int64_t to_low, std::int64_t to_high) {
    if (low < to_low) return to_low - low;
    return high > to_high ? to_high - high : std::int64_t{0};
  };
  return {axis(a.low.x, a.high.x, outer.low.x, outer.high.x),
          axis(a.low.y, a.high.y, outer.low.y, outer.high.y)};
}

/// Step 6 of docs/design/layout-check.md: tries directions and remembers what each of them gave.
class Search {
 public:
  Search(SlideOut& slide, double limit) : slide_(slide), least_(limit) {}

  bool attempt(Point direction, double spare = 1) {
    const auto stop = slide_.along(direction, spare * least_);
    if (!stop) return false;
    stops_.push_back(*stop);
    const bool better = stop->distance < least_;
    least_ = std::min(least_, stop->distance);
    return better;
  }
  /// Tries rays in all directions. Where the best way is across some edge, the next ray is longer by at most
  /// 1 / cos(1/32 turn), if the same edge hinders there.
  void fan() {
    constexpr double kSpare = 1.06;
    Point ray{1, 0};
    for (int i = 0; i < 16; ++i, ray = turned_by(ray, kFanStep)) {
      attempt(ray, kSpare);
      across_contacts();
    }
  }
  /// Tries the directions across the edges in contact: where such an edge is all that hinders, no direction
  /// is shorter.
  void across_contacts() {
    for (; looked_at_ < stops_.size(); ++looked_at_) {
      const SlideOut::Stop stop = stops_[looked_at_];
      for (const Point edge : {stop.edge_of_a, stop.edge_of_b}) {
        if (edge == Point{}) continue;
        const Point across = (1 / norm(edge)) * perpendicular(edge);
        const double along = dot(across, stop.direction);
        // The way across is shorter than this one by the cosine at best.
        if (!(std::abs(along) < 1 - 1e-9) || std::abs(along) * stop.distance >= least_) continue;
        attempt(along < 0 ? -across : across);
      }
    }
  }
  /// Tries steps around the best direction and halves them. Where two contacts hinder at once, the best
  /// direction is across neither of them.
  void between_contacts() {
    if (stops_.empty() || is_across(shortest())) return;
    Point best = shortest().direction, step = kFineStep;
    for (int i = 0; i < 7; ++i, step = halved(step))
      for (const Point by : {step, opposite_turn(step)})
        if (attempt(turned_by(best, by))) {
          best = shortest().direction;
          break;
        }
    across_contacts();
  }
  [[nodiscard]] const SlideOut::Stop& shortest() const {
    return *std::min_element(stops_.begin(), stops_.end(), shorter);
  }
  [[nodiscard]] std::vector<SlideOut::Stop> sorted() {
    std::stable_sort(stops_.begin(), stops_.end(), shorter);
    return stops_;
  }

 private:
  static bool shorter(const SlideOut::Stop& p, const SlideOut::Stop& q) noexcept {
    return p.distance < q.distance;
  }
  static bool is_across(const SlideOut::Stop& stop) noexcept {
    for (const Point edge : {stop.edge_of_a, stop.edge_of_b})
      if (std::abs(dot(edge, stop.direction)) < 1e-9 * norm(edge)) return true;
    return false;
  }

  SlideOut& slide_;
  double least_;
  std::size_t looked_at_ = 0;
  std::vector<SlideOut::Stop> stops_;
};

/// Step 7: returns the first of the slides that `frees` approves. It is rounded to the grid, and prolonged by
/// some steps where rounding would take it back.
template <class Frees>
std::optional<GridPoint> proved(const std::vector<SlideOut::Stop>& stops, Frees&& frees) {
  for (const SlideOut::Stop& stop : stops)
    for (const double more : {0.0, 1.0, 2.0, 4.0, 16.0}) {
      const Point end = (stop.distance + more) * stop.direction;
      const auto outward = [](double v) {
        return static_cast<std::int64_t>(v < 0 ? std::floor(v) : std::ceil(v));
      };
      const GridPoint shift{outward(end.x), outward(end.y)};
      if (frees(shift)) return shift;
    }
  return std::nullopt;
}

Separation made(GridPoint shift, Point at_mm) noexcept {
  const Point v = geom::mm_from_grid(shift);
  const double length = norm(v);
  return {shift, length, length > 0 ? (1 / length) * v : Point{}, at_mm};
}

double length_of(GridPoint v) noexcept {
  return geom::norm({static_cast<double>(v.x), static_cast<double>(v.y)});
}

void try_direction(Search& search, GridPoint v) {
  if (v == GridPoint{}) return;
  const double length = length_of(v);
  search.attempt({static_cast<double>(v.x) / length, static_cast<double>(v.y) / length});
  search.across_contacts();
}

/// Returns a point of a's outline that lies in the forbidden. Some overlaps are too thin to have a middle in
/// floating point, or one that a grid point shows.
Point edge_place(const GridRegion& a, const GridRegion& b, GridPoint b_shift) {
  return edge_distance(a, b, b_shift).on_a;
}

Point place_shown(const GridRegion& a, const GridRegion& b, GridPoint b_shift,
                  const std::optional<Point>& place) {
  if (!place) return edge_place(a, b, b_shift);
  const Point at = geom::mm_from_grid(a.points[0]) + geom::mm_from_steps(*place);
  const GridPoint nearest{geom::grid_from_mm(at.x), geom::grid_from_mm(at.y)};
  const bool in_both = locate_point(a, nearest) != geom::PointLocation::outside &&
                       locate_point(b, nearest - b_shift) != geom::PointLocation::outside;
  return in_both ? at : edge_place(a, b, b_shift);
}

}  // namespace

Separation separate(const GridRegion& a, const GridRegion& b, GridPoint b_shift) {
  const GridPoint box_shift = box_shift_out(bounds(a), geom::moved(bounds(b), b_shift));
  SlideOut slide(a, b, b_shift, false);
  const auto place = slide.place_in_common();
  if (place) slide.probe_at(*place);
  // The limit is a little above the length along the axis, so that this direction is among the answers.
  Search search(slide, length_of(box_shift) + 1);
  try_direction(search, box_shift);
  search.fan();
  search.between_contacts();
  const auto shift =
      proved(search.sorted(), [&](GridPoint by) { return !interiors_meet(a, b, b_shift - by); });
  const bool by_box = !shift || dot(box_shift, box_shift) < dot(*shift, *shift);
  return made(by_box ? box_shift : *shift, place_shown(a, b, b_shift, place));
}

std::optional<Separation> bring_inside(const GridRegion& container, const GridRegion& a) {
  const GridBox outer = bounds(container), box = bounds(a);
  if (box.high.x - box.low.x > outer.high.x - outer.low.x ||
      box.high.y - box.low.y > outer.high.y - outer.low.y)
    return std::nullopt;
  SlideOut slide(a, container, {}, true);
  const auto place = slide.place_in_common();
  if (place) slide.probe_at(*place);
  Search search(slide, std::numeric_limits<double>::infinity());
  // No shift is shorter than the one that brings the box in.
  const GridPoint by_box = box_shift_in(box, outer);
  const Point at =
      place ? geom::mm_from_grid(a.points[0]) + geom::mm_from_steps(*place) : sticking_out(container, a).at;
  if (lies_within(container, a, by_box)) return made(by_box, at);
  try_direction(search, by_box);
  search.fan();
  search.between_contacts();
  const auto shift = proved(search.sorted(), [&](GridPoint by) { return lies_within(container, a, by); });
  if (!shift) return std::nullopt;
  return made(*shift, at);
}

StickingOut sticking_out(const GridRegion& container, const GridRegion& a) {
  StickingOut most;
  bool found = false;
  for (const GridPoint p : a.points) {
    ask(1 + container.points.size() / 16);
    if (locate_point(container, p) != geom::PointLocation::outside) continue;
    double squared = std::numeric_limits<double>::infinity();
    for (std::size_t l = 0; l < container.loops(); ++l) {
      std::size_t before = container.loop_starts[l + 1] - 1;
      for (std::size_t i = container.loop_starts[l]; i < container.loop_starts[l + 1]; before = i++) {
        const Point from = geom::mm_from_grid(container.points[before] - p);
        const Point edge = geom::mm_from_grid(container.points[i] - container.points[before]);
        const double share = std::clamp(-dot(from, edge) / dot(edge, edge), 0.0, 1.0);
        const Point foot = from + share * edge;
        squared = std::min(squared, dot(foot, foot));
      }
    }
    if (found && std::sqrt(squared) <= most.distance_mm) continue;
    most = {std::sqrt(squared), geom::mm_from_grid(p)};
    found = true;
  }
  if (!found) most.at = edge_place(a, container, {});
  return most;
}

}  // namespace lekalo::phi
