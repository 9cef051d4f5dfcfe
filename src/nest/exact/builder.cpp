#include "builder.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {
namespace {

/// The bins that are not open: by stock the copies that are left, the next one last. The stock comes first of
/// which area is cheapest, of equal ones the larger.
std::vector<std::vector<std::uint32_t>> closed_bins(const Problem& problem, const State& state) {
  const auto& bins = problem.bins();
  const auto price = [&](std::uint32_t b) {
    return problem.document().stocks[bins[b].stock].cost / bins[b].area;
  };
  std::vector<std::uint32_t> order(bins.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return price(a) != price(b) ? price(a) < price(b) : bins[a].area > bins[b].area;
  });
  std::vector<bool> is_open(bins.size(), false);
  for (const std::uint32_t b : state.open_bins) is_open[b] = true;
  std::vector<std::vector<std::uint32_t>> closed;
  for (const std::uint32_t b : order) {
    if (is_open[b]) continue;
    if (closed.empty() || bins[closed.back().front()].stock != bins[b].stock) closed.emplace_back();
    closed.back().push_back(b);
  }
  for (std::vector<std::uint32_t>& copies : closed) std::reverse(copies.begin(), copies.end());
  return closed;
}

}  // namespace

std::vector<std::uint32_t> by_size(const Problem& problem, const Items& items) {
  std::vector<std::uint32_t> order(items.movable());
  std::iota(order.begin(), order.end(), 0u);
  const auto& parts = problem.document().parts;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t p = items.parts[a], q = items.parts[b];
    if (parts[p].priority != parts[q].priority) return parts[p].priority > parts[q].priority;
    return problem.hull_area_of(p) > problem.hull_area_of(q);
  });
  return order;
}

State empty_state(const Problem& problem, const Items& items) {
  State state;
  for (const Forms& forms : items.forms) state.spots.push_back({0, 0, forms.first, kNowhere});
  state.spots.insert(state.spots.end(), items.fixed.begin(), items.fixed.end());
  for (std::uint32_t b = 0; b < problem.bins().size(); ++b) {
    const Bin& bin = problem.bins()[b];
    state.ends.push_back(bin.box.x1);
    state.tops.push_back(bin.box.y1);
    if (bin.holds_locked) state.open_bins.push_back(b);
  }
  return state;
}

/// nest.md, step 11.
State built(const Problem& problem, const Items& items, Placer& placer, const State& from,
            const std::vector<std::uint32_t>& order, const std::function<bool()>& enough,
            const tuning::Tries& tries) {
  const auto& bins = problem.bins();
  const bool strip = problem.is_strip();
  double widest = 0;
  for (const Forms& forms : items.forms)
    for (std::uint32_t f = forms.first; f < forms.last; ++f)
      widest = std::max(widest, problem.forms()[f].box.x1 - problem.forms()[f].box.x0);
  const std::size_t of_one =
      std::clamp(tries.in_all / std::max<std::size_t>(1, items.movable()), tries.least, tries.most);
  State state = from;
  if (strip) {
    double end = std::max(bins[0].locked_reach, bins[0].box.x0), area = 0;
    for (std::size_t i = 0; i < items.movable(); ++i) {
      const Spot& spot = state.spots[i];
      if (spot.bin == 0)
        end =
            std::max(end, spot.x + problem.forms()[spot.form].box.x1 + problem.border_gap_of(items.parts[i]));
      else
        area += problem.area_of(items.parts[i]);
    }
    if (area > 0) end += widest + 0.5 * area / (bins[0].box.y1 - bins[0].box.y0);
    state.ends[0] = std::min(bins[0].box.x1, end);
  }
  placer.load(state);
  const auto open = [&](std::uint32_t bin) {
    const auto& all = placer.state().open_bins;
    return std::find(all.begin(), all.end(), bin) != all.end();
  };
  std::vector<std::vector<std::uint32_t>> closed = closed_bins(problem, state);
  // Pieces with partners are not alike, because each has to lie near its own.
  const bool alike = items.partners.empty();
  // By first form of pieces: on so many of the bins opened first they found no place.
  std::map<std::uint32_t, std::size_t> full;
  std::vector<Forms> hopeless;  // forms of pieces that found no place on any bin
  for (const std::uint32_t i : order) {
    if (placer.state().spots[i].bin != kNowhere) continue;
    if (std::find(hopeless.begin(), hopeless.end(), items.forms[i]) != hopeless.end()) continue;
    if (enough && enough()) break;
    bool placed = false;
    const auto try_open = [&] {
      const std::vector<std::uint32_t>& in_use = placer.state().open_bins;
      std::size_t first = 0;
      std::size_t& next = strip || !alike ? first : full[items.forms[i].first];
      for (; next < in_use.size(); ++next)
        if (placer.place_low(i, in_use[next], of_one)) return true;
      return false;
    };
    while (!(placed = try_open()) && strip && (!open(0) || placer.state().ends[0] < bins[0].box.x1)) {
      if (!open(0))
        placer.open_bin(0);
      else
        placer.set_end(0, std::min(bins[0].box.x1, placer.state().ends[0] + widest));
    }
    // One more copy of each stock is tried, because the others are the same.
    for (std::size_t k = 0; !placed && !strip && k < closed.size(); ++k) {
      if (closed[k].empty() || !placer.can_hold(closed[k].back(), i)) continue;
      const std::uint32_t bin = closed[k].back();
      placer.open_bin(bin);
      placed = placer.place_low(i, bin, tries.most);
      placed ? closed[k].pop_back() : placer.close_bin(bin);
    }
    if (!placed && alike) hopeless.push_back(items.forms[i]);
  }
  return placer.state();
}

}  // namespace lekalo::nest
