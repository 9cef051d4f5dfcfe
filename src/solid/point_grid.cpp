#include "point_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/stop.hpp"

namespace lekalo::solid {
namespace {

/// The shares of the work that are done when points have spread to the cells, and when the ball has come to
/// where it can. Measured.
constexpr double kSpread = 0.45, kFlooded = 0.6;
/// So many cells that need nothing done count as a step of work.
constexpr std::size_t kIdleCells = 64;

}  // namespace

PointGrid::PointGrid(std::vector<Vector> points, const Box& box, double step, double ball, bool floor,
                     const Listener& told)
    : points_(std::move(points)), low_(box.low), step_(step), ball_(ball), floor_(floor) {
  const double around = ball + 2 * step;
  low_ = low_ - Vector{around, around, floor ? 0 : around};
  const Vector size = box.high - low_;
  const auto count = [&](double length) { return static_cast<std::int32_t>((length + around) / step) + 1; };
  count_ = {count(size.x), count(size.y), count(size.z)};
  const std::size_t all = number({0, 0, count_.z});
  state_.assign(all, 0);
  near_.assign(all, kNone);
  occupy([&](double share) { told(share * kSpread); });
  flood();
  told(kFlooded);
  roll([&](double share) { told(std::lerp(kFlooded, 1.0, share)); });
}

PointGrid::Place PointGrid::place(std::size_t number) const noexcept {
  const auto nx = static_cast<std::size_t>(count_.x), ny = static_cast<std::size_t>(count_.y);
  return {static_cast<std::int32_t>(number % nx), static_cast<std::int32_t>(number / nx % ny),
          static_cast<std::int32_t>(number / nx / ny)};
}
Vector PointGrid::corner(Place c) const noexcept {
  return low_ + step_ * Vector{double(c.x), double(c.y), double(c.z)};
}
Vector PointGrid::middle(Place c) const noexcept { return corner(c) + 0.5 * step_ * Vector{1, 1, 1}; }
PointGrid::Place PointGrid::cell_of(Vector p) const noexcept {
  const auto at = [&](double x, double low, std::int32_t count) {
    return std::min(static_cast<std::int32_t>((x - low) / step_), count - 1);
  };
  return {at(p.x, low_.x, count_.x), at(p.y, low_.y, count_.y), at(p.z, low_.z, count_.z)};
}

template <class At, class May>
void PointGrid::spread(std::vector<std::uint32_t>& sources, std::vector<std::uint32_t> front, double reach,
                       const At& at, const May& may, const Listener& told) {
  const double most = reach * reach, rounds = reach / step_;
  const auto squared = [&](Vector a, Vector b) { return dot(a - b, a - b); };
  std::vector<std::uint32_t> next;
  for (double round = 0; !front.empty(); ++round) {
    told(std::min(1.0, round / rounds));
    next.clear();
    for (const std::uint32_t from : front) {
      ask();
      state_[from] &= static_cast<std::uint8_t>(~kWaits);
      const Place c = place(from);
      const std::uint32_t source = sources[from];
      const Vector p = at(source);
      for (std::int32_t dz = -1; dz <= 1; ++dz)
        for (std::int32_t dy = -1; dy <= 1; ++dy)
          for (std::int32_t dx = -1; dx <= 1; ++dx) {
            const Place d{c.x + dx, c.y + dy, c.z + dz};
            if (!has(d)) continue;
            const std::size_t to = number(d);
            if (sources[to] == source || !may(to)) continue;
            const Vector m = middle(d);
            const double distance = squared(p, m);
            if (!(distance < most)) continue;
            if (sources[to] != kNone && !(distance < squared(at(sources[to]), m))) continue;
            sources[to] = source;
            if ((state_[to] & kWaits) != 0) continue;
            state_[to] |= kWaits;
            next.push_back(static_cast<std::uint32_t>(to));
          }
    }
    std::swap(front, next);
  }
}

/// Each cell with points is held by the one nearest to its middle.
void PointGrid::occupy(const Listener& told) {
  std::vector<std::uint32_t> front;
  for (std::uint32_t k = 0; k < points_.size(); ++k) {
    ask();
    const Place c = cell_of(points_[k]);
    const std::size_t at = number(c);
    const auto far = [&](std::uint32_t p) { return norm(points_[p] - middle(c)); };
    if ((state_[at] & kOccupied) == 0) {
      front.push_back(static_cast<std::uint32_t>(at));
      near_[at] = k;
    } else if (far(k) < far(near_[at])) {
      near_[at] = k;
    }
    state_[at] |= kOccupied;
  }
  spread(
      near_, std::move(front), ball_, [&](std::uint32_t k) { return points_[k]; },
      [&](std::size_t to) { return (state_[to] & kOccupied) == 0; }, told);
}

/// The middle of the ball comes from the sides of the grid to wherever it is not too near to a point.
void PointGrid::flood() {
  std::vector<std::uint32_t> reached;
  const auto reach = [&](Place c) {
    if (!has(c)) return;
    const std::size_t at = number(c);
    if ((state_[at] & kOutside) != 0 || near_[at] != kNone) return;
    state_[at] |= kOutside;
    reached.push_back(static_cast<std::uint32_t>(at));
  };
  for (std::int32_t y = 0; y < count_.y; ++y)
    for (std::int32_t x = 0; x < count_.x; ++x) {
      reach({x, y, count_.z - 1});
      if (!floor_) reach({x, y, 0});
    }
  for (std::int32_t z = 0; z < count_.z; ++z) {
    for (std::int32_t x = 0; x < count_.x; ++x) reach({x, 0, z}), reach({x, count_.y - 1, z});
    for (std::int32_t y = 0; y < count_.y; ++y) reach({0, y, z}), reach({count_.x - 1, y, z});
  }
  while (!reached.empty()) {
    ask();
    const Place c = place(reached.back());
    reached.pop_back();
    for (int axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1}) {
        Place beside = c;
        beside[axis] += way;
        reach(beside);
      }
  }
}

/// From where its middle is the ball reaches the cells around, but for those of points and those where its
/// middle could be, too, but does not come. It stays a cell away from them, so that it does not pass between
/// two.
void PointGrid::roll(const Listener& told) {
  std::vector<std::uint32_t> from(state_.size(), kNone), front;
  for (std::uint32_t at = 0; at < state_.size(); ++at) {
    if (at % kIdleCells == 0) ask();
    if ((state_[at] & kOutside) != 0) {
      from[at] = at;
      const Place c = place(at);
      bool border = false;
      for (int axis = 0; axis < 3; ++axis)
        for (const int way : {-1, 1}) {
          Place beside = c;
          beside[axis] += way;
          border = border || (has(beside) && !outside(beside));
        }
      if (border) front.push_back(at);
    }
  }
  spread(
      from, std::move(front), ball_ - step_, [&](std::uint32_t at) { return middle(place(at)); },
      [&](std::size_t to) { return (state_[to] & (kOccupied | kOutside)) == 0 && near_[to] != kNone; }, told);
  for (std::size_t at = 0; at < state_.size(); ++at)
    if (from[at] != kNone) state_[at] |= kOutside;
}

std::optional<std::uint32_t> PointGrid::nearest_point(Place c) const {
  const Vector at = corner(c);
  std::optional<std::uint32_t> best;
  double least = 0;
  for (std::int32_t dz = -1; dz <= 0; ++dz)
    for (std::int32_t dy = -1; dy <= 0; ++dy)
      for (std::int32_t dx = -1; dx <= 0; ++dx) {
        const Place cell{c.x + dx, c.y + dy, c.z + dz};
        if (!has(cell)) continue;
        const std::uint32_t p = near_[number(cell)];
        if (p == kNone) continue;
        const double far = norm(points_[p] - at);
        if (best && (far > least || (far == least && p >= *best))) continue;
        best = p, least = far;
      }
  return best;
}

}  // namespace lekalo::solid
