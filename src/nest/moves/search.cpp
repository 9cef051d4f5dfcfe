#include "search.hpp"

#include <algorithm>

#include "nest/exact/builder.hpp"

namespace lekalo::nest {
namespace {

std::vector<std::uint32_t> large_items(const Problem& problem, const Items& items,
                                       std::vector<std::uint32_t> order) {
  const auto area = [&](std::uint32_t i) { return problem.hull_area_of(items.parts[i]); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return area(a) > area(b); });
  double all = 0, sum = 0;
  for (const std::uint32_t i : order) all += area(i);
  std::vector<std::uint32_t> large;
  for (const std::uint32_t i : order) {
    if (sum > tuning::kLargeShare * all && large.size() >= 2) break;
    sum += area(i);
    large.push_back(i);
  }
  return large;
}

}  // namespace

Search::Search(const Problem& of, const Items& moved, Random chance)
    : problem(of),
      items(moved),
      separator(of, moved, chance),
      by_size(nest::by_size(of, moved)),
      large(large_items(of, moved, by_size)) {}

std::vector<std::uint32_t> Search::nowhere(const State& state) const {
  std::vector<std::uint32_t> missing;
  for (const std::uint32_t i : by_size)
    if (state.spots[i].bin == kNowhere) missing.push_back(i);
  return missing;
}

std::size_t Search::pick(std::size_t count) { return random().below(2) == 0 ? 0 : random().below(count); }

void Search::tidy(State& state) const {
  if (problem.is_strip()) return;
  for (std::uint32_t b = 0; b < state.ends.size(); ++b) {
    state.ends[b] = problem.bins()[b].box.x1;
    state.tops[b] = problem.bins()[b].box.y1;
  }
  std::vector<char> used(problem.bins().size(), 0);
  for (std::size_t i = 0; i < items.movable(); ++i)
    if (state.spots[i].bin != kNowhere) used[state.spots[i].bin] = 1;
  std::erase_if(state.open_bins,
                [&](std::uint32_t b) { return used[b] == 0 && !problem.bins()[b].holds_locked; });
}

void Search::keep_if_best() {
  const Merit &was = best.merit, &is = current.merit;
  if (!(is < was)) return;
  if (is.cost < was.cost) ++cheaper;
  if (is.unplaced < was.unplaced || is.missing < was.missing) ++fuller;
  best = current;
}

void Search::begin_separation() {
  separator.forget_weights();
  const double overlap = separator.overlap();
  attempt.begin(overlap, separator.state());
}

Outcome Search::after_pass(double overlap, Patience patience) {
  const double unit = problem.unit();
  if (overlap <= 0 || (separator.deepest() < unit && separator.snap(unit))) return Outcome::valid;
  switch (attempt.after_pass(overlap, separator.state(), patience)) {
    case Attempt::Next::on:
      return Outcome::under_way;
    case Attempt::Next::stuck:
      return Outcome::failed;
    case Attempt::Next::from_least:
      separator.load(attempt.least());
      separator.overlap();
  }
  return Outcome::under_way;
}

geom::Point middle_of(const Problem& problem, const Spot& spot) {
  const Box& box = problem.forms()[spot.form].box;
  return {spot.x + 0.5 * (box.x0 + box.x1), spot.y + 0.5 * (box.y0 + box.y1)};
}

}  // namespace lekalo::nest
