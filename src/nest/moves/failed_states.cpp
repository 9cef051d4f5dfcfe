#include "failed_states.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lekalo::nest {
namespace {

/// A number of mean 0 and deviation 1, about normally distributed.
double about_normal(Random& random) {
  double sum = 0;
  for (int k = 0; k < 12; ++k) sum += random.uniform();
  return sum - 6;
}

/// True if item i is much smaller than another one and its middle lies within that one's box.
bool lies_in(const Search& search, const State& state, std::uint32_t i, std::uint32_t other) {
  const Spot& s = state.spots[other];
  const Box& box = search.problem.forms()[s.form].box;
  const geom::Point m = middle_of(search.problem, state.spots[i]);
  return state.spots[i].bin == s.bin && m.x > s.x + box.x0 && m.x < s.x + box.x1 && m.y > s.y + box.y0 &&
         m.y < s.y + box.y1 &&
         search.problem.hull_area_of(search.items.parts[i]) <
             0.5 * search.problem.hull_area_of(search.items.parts[other]);
}

/// Lets items a and b change places, each with what lies in it.
void exchange(Search& search, std::uint32_t a, std::uint32_t b) {
  const State& state = search.separator.state();
  const geom::Point way =
      middle_of(search.problem, state.spots[b]) - middle_of(search.problem, state.spots[a]);
  std::vector<std::pair<std::uint32_t, Spot>> moves;
  const auto shift = [&](std::uint32_t i, geom::Point by) {
    Spot spot = state.spots[i];
    spot.x += by.x;
    spot.y += by.y;
    moves.emplace_back(i, spot);
  };
  shift(a, way);
  shift(b, -way);
  for (std::uint32_t i = 0; i < search.items.movable(); ++i) {
    if (i == a || i == b) continue;
    if (lies_in(search, state, i, a))
      shift(i, way);
    else if (lies_in(search, state, i, b))
      shift(i, -way);
  }
  for (const auto& [item, spot] : moves) search.separator.set_spot(item, spot);
  search.separator.set_limits(kStrip, state.ends[kStrip], state.tops[kStrip]);
}

}  // namespace

void FailedStates::add(const Attempt& attempt, std::size_t most) {
  states_.push_back({attempt.least(), attempt.least_overlap()});
  if (states_.size() > most) states_.erase(states_.begin());
}

void FailedStates::load_disrupted(Search& search) {
  Random& random = search.random();
  std::stable_sort(states_.begin(), states_.end(),
                   [](const Failed& a, const Failed& b) { return a.overlap < b.overlap; });
  const auto rank =
      static_cast<std::size_t>(std::min(0.999, std::abs(tuning::kPoolSpread * about_normal(random))) *
                               static_cast<double>(states_.size()));
  search.separator.load(states_[rank].state);
  const std::vector<std::uint32_t>& large = search.large;
  if (large.size() < 2) return;
  const std::uint32_t a = large[random.below(large.size())];
  std::uint32_t b = a;
  const auto& parts = search.items.parts;
  for (int tries = 0; tries < tuning::kOtherPartTries && parts[b] == parts[a]; ++tries)
    b = large[random.below(large.size())];
  const auto& spots = search.separator.state().spots;
  if (parts[a] != parts[b] && spots[a].bin != kNowhere && spots[b].bin != kNowhere) exchange(search, a, b);
}

}  // namespace lekalo::nest
