#include "reduce.hpp"

#include <algorithm>
#include <numeric>

namespace lekalo::nest {

bool Reduce::begin(Search& search) {
  if (cheaper_ != search.cheaper) turns_ = 0;
  cheaper_ = search.cheaper;
  // Its turns come again and again, but ever less often.
  if (turns_ >= tuning::kFirstReductions &&
      search.turns % (1 << std::min(turns_, tuning::kRarestReduction)) != 0)
    return false;
  ++turns_;
  const std::vector<std::uint32_t> chosen = cheaper_stock(search);
  if (chosen.empty()) return false;
  State& state = search.current.state;
  state.open_bins = chosen;
  for (std::size_t i = 0; i < search.items.movable(); ++i) {
    Spot& spot = state.spots[i];
    if (std::find(chosen.begin(), chosen.end(), spot.bin) == chosen.end()) spot.bin = kNowhere;
  }
  search.current.merit = search.merit_of(state);
  begin_with(search.nowhere(state).size());
  return true;
}

std::vector<std::uint32_t> Reduce::cheaper_stock(Search& search) const {
  const auto& bins = search.problem.bins();
  const Valid& best = search.best;
  if (best.state.open_bins.size() < 2) return {};
  const auto cost_of = [&](std::uint32_t b) { return search.problem.document().stocks[bins[b].stock].cost; };
  std::vector<std::uint32_t> chosen;
  double cost = 0, room = 0;
  const auto choose = [&](std::uint32_t b) {
    chosen.push_back(b);
    cost += cost_of(b);
    room += bins[b].area;
  };
  for (std::uint32_t b = 0; b < bins.size(); ++b)
    if (bins[b].holds_locked) choose(b);
  double needed = 0;
  for (std::size_t i = 0; i < search.items.movable(); ++i)
    if (best.state.spots[i].bin != kNowhere) needed += search.problem.area_of(search.items.parts[i]);
  // The most spacious for their price come first; where that was tried, chance blurs the order.
  const double noise = turns_ < tuning::kFirstReductions ? 0 : tuning::kRankNoise;
  std::vector<std::uint32_t> order(bins.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<double> rank;
  for (const std::uint32_t b : order)
    rank.push_back(bins[b].area / std::max(cost_of(b), 1e-9) * (1 + noise * search.random().uniform(-1, 1)));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return rank[a] > rank[b]; });
  for (const std::uint32_t b : order)
    if (!bins[b].holds_locked && cost + cost_of(b) < best.merit.cost) choose(b);
  if (cost >= best.merit.cost || needed > tuning::kFullest * room) return {};
  return chosen;
}

}  // namespace lekalo::nest
