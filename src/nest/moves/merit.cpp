#include "merit.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "lekalo/layout/completeness.hpp"

namespace lekalo::nest {
namespace {

double missing_value(const Problem& problem, const Items& items, const State& state) {
  const layout::Document& document = problem.document();
  if (document.kits.empty()) return 0;
  const auto complete = layout::kits_made(document, placed_pieces(problem, items, state)).complete;
  double missing = 0;
  for (std::size_t k = 0; k < complete.size(); ++k)
    missing += document.kits[k].value * static_cast<double>(document.kits[k].demand - complete[k]);
  return missing;
}

/// How far from the lower left corner of its bin something reaches, with its border gap.
struct Reach {
  double x = 0, y = 0;
  void add(const Problem& problem, std::uint32_t part, const Spot& spot) {
    const Bin& bin = problem.bins()[spot.bin];
    const Box& box = problem.forms()[spot.form].box;
    const double gap = problem.border_gap_of(part);
    x = std::max(x, gap + (spot.x + box.x1 - bin.box.x0));
    y = std::max(y, gap + (spot.y + box.y1 - bin.box.y0));
  }
};

Reach reach_of_locked(const Bin& bin) { return {bin.locked_reach - bin.box.x0, bin.locked_top - bin.box.y0}; }

/// The box in use of a bin on which things reach so far.
BoxSize box_of(const Problem& problem, std::uint32_t b, const Reach& reach) {
  const Bin& bin = problem.bins()[b];
  const Remnant remnant = problem.remnant();
  const BoxSize along_x = {reach.x, bin.box.y1 - bin.box.y0};
  if (bin.open || remnant == Remnant::strip) return along_x;
  if (remnant == Remnant::corner) return {reach.x, reach.y};
  const BoxSize along_y = {bin.box.x1 - bin.box.x0, reach.y};
  return along_y.area() < along_x.area() ? along_y : along_x;
}

double left_beside(const Problem& problem, std::uint32_t b, const BoxSize& box) {
  const Bin& bin = problem.bins()[b];
  return (bin.box.x1 - bin.box.x0) * (bin.box.y1 - bin.box.y0) - box.area();
}

}  // namespace

Merit merit_of(const Problem& problem, const Items& items, const State& state) {
  Merit merit;
  for (std::size_t i = 0; i < items.movable(); ++i)
    if (state.spots[i].bin == kNowhere) {
      const int priority = problem.document().parts[items.parts[i]].priority;
      merit.unplaced += problem.area_of(items.parts[i]) * (1 + std::max(0, priority));
    }
  for (const std::uint32_t bin : state.open_bins)
    merit.cost += problem.document().stocks[problem.bins()[bin].stock].cost;
  if (problem.is_strip()) {
    merit.reach = strip_length(problem, items, state);
    return merit;
  }
  merit.missing = missing_value(problem, items, state);
  if (!state.open_bins.empty())
    merit.reach = -leftover_of(problem, items, state, emptiest(problem, items, state));
  return merit;
}

/// This adds up in another order than reach_of(), and layouts depend on the last bit of it.
double strip_length(const Problem& problem, const Items& items, const State& state) {
  const Bin& strip = problem.bins()[kStrip];
  double length = std::max(0.0, strip.locked_reach - strip.box.x0);
  for (std::size_t i = 0; i < items.movable(); ++i) {
    const Spot& spot = state.spots[i];
    if (spot.bin == kNowhere) continue;
    length = std::max(length, problem.border_gap_of(items.parts[i]) + spot.x +
                                  problem.forms()[spot.form].box.x1 - strip.box.x0);
  }
  return length;
}

double reach_of(const Problem& problem, const Items& items, const State& state, std::uint32_t b, int axis) {
  Reach reach = reach_of_locked(problem.bins()[b]);
  for (std::size_t i = 0; i < items.movable(); ++i)
    if (state.spots[i].bin == b) reach.add(problem, items.parts[i], state.spots[i]);
  return std::max(0.0, axis == 0 ? reach.x : reach.y);
}

BoxSize box_in_use(const Problem& problem, const Items& items, const State& state, std::uint32_t b) {
  return box_of(problem, b, {reach_of(problem, items, state, b, 0), reach_of(problem, items, state, b, 1)});
}

double leftover_of(const Problem& problem, const Items& items, const State& state, std::uint32_t b) {
  return left_beside(problem, b, box_in_use(problem, items, state, b));
}

/// Looks at every item once, since sheets may be as many as items.
std::uint32_t emptiest(const Problem& problem, const Items& items, const State& state) {
  std::vector<Reach> reaches(problem.bins().size());
  for (const std::uint32_t bin : state.open_bins) reaches[bin] = reach_of_locked(problem.bins()[bin]);
  for (std::size_t i = 0; i < items.movable(); ++i)
    if (const Spot& spot = state.spots[i]; spot.bin != kNowhere)
      reaches[spot.bin].add(problem, items.parts[i], spot);
  std::uint32_t found = state.open_bins.front();
  double most = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t bin : state.open_bins) {
    const Reach reach{std::max(0.0, reaches[bin].x), std::max(0.0, reaches[bin].y)};
    const double leftover = left_beside(problem, bin, box_of(problem, bin, reach));
    if (leftover > most) {
      most = leftover;
      found = bin;
    }
  }
  return found;
}

double used_area(const Problem& problem, const Items& items, const State& state, std::uint32_t bin) {
  double area = 0;
  for (std::size_t i = 0; i < items.movable(); ++i)
    if (state.spots[i].bin == bin) area += problem.area_of(items.parts[i]);
  return area;
}

std::vector<layout::PieceCount> placed_pieces(const Problem& problem, const Items& items,
                                              const State& state) {
  std::vector<layout::PieceCount> placed = problem.locked_pieces();
  for (std::size_t i = 0; i < items.movable(); ++i) {
    const Spot& spot = state.spots[i];
    if (spot.bin == kNowhere) continue;
    layout::PieceCount& count = placed[items.parts[i]];
    ++(problem.forms()[spot.form].mirrored ? count.mirrored : count.upright);
  }
  return placed;
}

}  // namespace lekalo::nest
