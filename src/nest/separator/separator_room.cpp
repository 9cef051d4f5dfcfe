#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"
#include "nest/tuning/tuning.hpp"
#include "separator.hpp"

namespace lekalo::nest {
namespace {

/// The cosine of 45 degrees, which the two ways aslant have to the straight one.
constexpr double kAslant = 0.7071;

}  // namespace

/// True if item i overlaps none of the items gathered around when it lies there.
bool Separator::is_free(std::size_t i, const Spot& spot) {
  ++work_;
  if (distance_too_far(i, spot) > 0.5 * kTolerance) return false;
  const Form& form = problem_.forms()[spot.form];
  const Box around = form.box.at(spot.x, spot.y, problem_.widest_gap());
  return std::none_of(near_.begin(), near_.end(), [&](std::uint32_t j) {
    if (!boxes_[j].meets(around)) return false;
    const Spot& other = state_.spots[j];
    return problem_.depth(form, problem_.forms()[other.form], other.x - spot.x, other.y - spot.y) >
           0.5 * kTolerance;
  });
}

/// nest-sheets.md, step 3.
void Separator::make_room(std::uint32_t bin, geom::Point at) {
  std::vector<std::pair<double, std::uint32_t>> order;
  const auto middle = [&](std::size_t i) {
    return geom::Point{0.5 * (boxes_[i].x0 + boxes_[i].x1), 0.5 * (boxes_[i].y0 + boxes_[i].y1)};
  };
  for (std::uint32_t i = 0; i < items_.movable(); ++i)
    if (state_.spots[i].bin == bin) order.emplace_back(-geom::norm(middle(i) - at), i);
  std::sort(order.begin(), order.end());
  for (const auto& entry : order) {
    const double less = entry.first;
    const std::uint32_t i = entry.second;
    ask();
    if (less == 0) continue;
    Spot spot = state_.spots[i];
    const geom::Point way = (-1 / less) * (middle(i) - at);
    const std::array<geom::Point, 3> ways = {
        way, geom::Point{kAslant * (way.x - way.y), kAslant * (way.x + way.y)},
        geom::Point{kAslant * (way.x + way.y), kAslant * (way.y - way.x)}};
    const Range r = range_of(spot.form, bin, items_.parts[i]);
    double step = tuning::kFirstRoomSlide * min_dim_[i];
    double reach = 0, ax = spot.x, ay = spot.y;
    while (step > tuning::kLastRoomSlide * min_dim_[i]) {
      if (std::hypot(spot.x - ax, spot.y - ay) + step > reach) {
        ax = spot.x;
        ay = spot.y;
        reach = 3 * step;
        gather(problem_.forms()[spot.form].box.at(ax, ay, reach), bin, i);
      }
      const bool moved = std::any_of(ways.begin(), ways.end(), [&](geom::Point d) {
        const Spot to = r.clamped(spot, spot.x + step * d.x, spot.y + step * d.y);
        if ((to.x == spot.x && to.y == spot.y) || !is_free(i, to)) return false;
        if ((to.x - spot.x) * way.x + (to.y - spot.y) * way.y < tuning::kLeastSlideGain * step) return false;
        spot = to;
        return true;
      });
      if (!moved) step *= 0.5;
    }
    set_spot(i, spot);
  }
}

}  // namespace lekalo::nest
