#include <algorithm>
#include <cmath>
#include <numeric>

#include "lekalo/base/stop.hpp"
#include "nest/tuning/tuning.hpp"
#include "separator.hpp"

namespace lekalo::nest {

std::vector<std::pair<std::uint32_t, std::uint32_t>> Separator::close_pairs(double margin) const {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < total_; ++i)
    if (state_.spots[i].bin != kNowhere) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return boxes_[a].x0 != boxes_[b].x0 ? boxes_[a].x0 < boxes_[b].x0 : a < b;
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::uint32_t i = order[k];
    const Box& a = boxes_[i];
    for (std::size_t m = k + 1; m < order.size(); ++m) {
      const std::uint32_t j = order[m];
      const Box& b = boxes_[j];
      if (b.x0 > a.x1 + margin) break;
      if (b.y0 > a.y1 + margin || b.y1 < a.y0 - margin) continue;
      if (state_.spots[i].bin != state_.spots[j].bin || std::min(i, j) >= items_.movable()) continue;
      pairs.emplace_back(std::min(i, j), std::max(i, j));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// nest.md, step 4.
bool Separator::relax(int rounds) {
  const std::vector<Spot> before = state_.spots;
  const double gap = problem_.widest_gap();
  const auto pairs = close_pairs(gap + tuning::kCloseMargin * unit_);
  double first = 0, least = std::numeric_limits<double>::infinity();
  int stalled = 0;
  for (int round = 0; round < rounds && stalled <= tuning::kStalledRounds; ++round) {
    ask(1 + pairs.size() / 8);
    double sum = 0;
    for (const auto& [i, j] : pairs) {
      const Box &a = boxes_[i], &b = boxes_[j];
      if (!b.meets(a.at(0, 0, gap))) continue;
      const Spot s = state_.spots[i], t = state_.spots[j];
      const NoFit::Way way =
          problem_.way_out(problem_.forms()[s.form], problem_.forms()[t.form], t.x - s.x, t.y - s.y);
      if (way.depth <= 0.5 * kTolerance) continue;
      if (way.depth > kTolerance) sum += way.depth;
      const double by = way.depth + 0.5 * kTolerance;
      const auto shift = [&](std::size_t k, const Spot& spot, double amount) {
        const Range r = range_of(spot.form, spot.bin, items_.parts[k]);
        set_spot(k, r.clamped(spot, spot.x + amount * way.direction.x, spot.y + amount * way.direction.y));
      };
      // The smaller item goes further, and a fixed one stays.
      double share = 0;
      if (j < items_.movable()) {
        share = size_[i] * size_[i] / (size_[i] * size_[i] + size_[j] * size_[j]);
        shift(j, t, share * by);
      }
      shift(i, s, (share - 1) * by);
    }
    work_ += pairs.size() / tuning::kPairsAsPlace + 1;
    if (sum <= 0 && overlap() <= 0) return true;
    if (round == 0) first = sum;
    if (sum > 2 * first) break;
    if (sum < 0.99 * least) {
      least = sum;
      stalled = 0;
    } else {
      ++stalled;
    }
  }
  for (std::size_t i = 0; i < items_.movable(); ++i) set_spot(i, before[i]);
  overlap();
  return false;
}

}  // namespace lekalo::nest
