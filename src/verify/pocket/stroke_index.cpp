#include "stroke_index.hpp"

#include <algorithm>
#include <limits>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify {

void box_of(const Stroke& s, Place& low, Place& high) {
  low = {std::min(s.from.x, s.to.x), std::min(s.from.y, s.to.y)};
  high = {std::max(s.from.x, s.to.x), std::max(s.from.y, s.to.y)};
  if (!s.arc) return;
  const double bulge = length(at_share(s, 0.5) - 0.5 * (s.from + s.to)) + 1e-9;
  low = low - Place{bulge, bulge}, high = high + Place{bulge, bulge};
}

StrokeIndex::StrokeIndex(Place low, Place high, double cell) : low_(low), cell_(cell) {
  const Place size = high - low;
  cell_ = std::max({cell, size.x / 1000, size.y / 1000});
  columns_ = static_cast<long>(size.x / cell_) + 1, rows_ = static_cast<long>(size.y / cell_) + 1;
  lists_.resize(static_cast<std::size_t>(columns_ * rows_));
}

StrokeIndex::Cells StrokeIndex::cells(Place low, Place high) const {
  const auto column = [&](double x) {
    return static_cast<long>(std::clamp((x - low_.x) / cell_, 0.0, static_cast<double>(columns_ - 1)));
  };
  const auto row = [&](double y) {
    return static_cast<long>(std::clamp((y - low_.y) / cell_, 0.0, static_cast<double>(rows_ - 1)));
  };
  return {column(low.x), row(low.y), column(high.x), row(high.y)};
}

void StrokeIndex::add(std::uint32_t number, const Stroke& stroke) {
  Place low, high;
  box_of(stroke, low, high);
  const Cells c = cells(low, high);
  for (long y = c.low_y; y <= c.high_y; ++y)
    for (long x = c.low_x; x <= c.high_x; ++x)
      lists_[static_cast<std::size_t>(y * columns_ + x)].push_back(number);
}

void StrokeIndex::near(Place p, double reach, std::vector<std::uint32_t>& numbers) const {
  numbers.clear();
  if (lists_.empty()) return;
  const Cells c = cells(p - Place{reach, reach}, p + Place{reach, reach});
  for (long y = c.low_y; y <= c.high_y; ++y)
    for (long x = c.low_x; x <= c.high_x; ++x) {
      ask();
      const auto& list = lists_[static_cast<std::size_t>(y * columns_ + x)];
      numbers.insert(numbers.end(), list.begin(), list.end());
    }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Returns the least distance. A stroke that is not looked at is farther away than `reach`, so its distance
/// less its width is not below reach - widest.
template <class Distance>
double StrokeIndex::least(Place p, double widest, Distance&& distance_of) const {
  double least = std::numeric_limits<double>::infinity();
  if (lists_.empty()) return least;
  const double whole =
      cell_ * static_cast<double>(columns_ + rows_) + std::abs(p.x - low_.x) + std::abs(p.y - low_.y);
  for (double reach = cell_;; reach *= 2) {
    const Cells c = cells(p - Place{reach, reach}, p + Place{reach, reach});
    for (long y = c.low_y; y <= c.high_y; ++y)
      for (long x = c.low_x; x <= c.high_x; ++x)
        for (const std::uint32_t i : lists_[static_cast<std::size_t>(y * columns_ + x)])
          least = std::min(least, distance_of(i));
    if (least <= reach - widest || reach > 2 * whole) return least;
  }
}

double StrokeIndex::nearest(Place p, const std::vector<Stroke>& strokes) const {
  return least(p, 0, [&](std::uint32_t i) { return distance(p, strokes[i]); });
}

double StrokeIndex::nearest(Place p, const std::vector<Stroke>& strokes, const std::vector<double>& wider,
                            double widest) const {
  return least(p, widest, [&](std::uint32_t i) { return distance(p, strokes[i]) - wider[i]; });
}

}  // namespace lekalo::verify
