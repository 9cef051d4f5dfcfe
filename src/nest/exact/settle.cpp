#include "settle.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "lekalo/layout/check.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {
namespace {

/// Steps beyond what is missing: two pieces are rounded, by half a step each along both axes.
constexpr double kReserve = 2.0;

struct Steps {
  double x = 0, y = 0;
  bool keeps_x = false, keeps_y = false;
};

layout::Document placed(const Problem& problem, const Items& items, const State& state,
                        const std::vector<Steps>& at) {
  layout::Document document = problem.given();
  std::erase_if(document.placements, [](const layout::Placement& p) { return !p.locked; });
  for (std::size_t i = 0; i < items.movable(); ++i) {
    const Spot& spot = state.spots[i];
    if (spot.bin == kNowhere) continue;
    const Form& form = problem.forms()[spot.form];
    layout::Placement placement;
    placement.id = problem.given().next_id + i;
    placement.part = items.parts[i];
    placement.stock = problem.bins()[spot.bin].stock;
    placement.copy = problem.bins()[spot.bin].copy;
    placement.rotation = form.rotation;
    placement.mirrored = form.mirrored;
    placement.at = {std::llround(at[i].x), std::llround(at[i].y)};
    document.placements.push_back(placement);
  }
  document.next_id = problem.given().next_id + items.movable();
  return document;
}

/// True if a shift can end this violation.
bool can_be_shifted(const layout::Violation& v) { return v.direction.x != 0 || v.direction.y != 0; }

/// Shifts both pieces of a violation apart by what is missing.
void shift(const layout::Violation& v, std::uint64_t first, std::vector<Steps>& at) {
  const double by = v.amount_mm * static_cast<double>(geom::kGridPerMm) + kReserve;
  const auto move = [&](std::uint64_t id, double share) {
    if (id < first) return;
    Steps& s = at[id - first];
    if (!s.keeps_x) s.x += share * by * v.direction.x;
    if (!s.keeps_y) s.y += share * by * v.direction.y;
  };
  const bool one = v.b == 0 || v.b < first || v.a < first;
  // On a strip there is room on the right, so the piece on that side gives way further.
  if (one) {
    move(v.a, 1);
    move(v.b, -1);
  } else if (v.direction.x > 0) {
    move(v.a, 0.75);
    move(v.b, -0.25);
  } else {
    move(v.a, 0.25);
    move(v.b, -0.75);
  }
}

/// The item that breaks most rules; of equal ones the smallest.
std::size_t worst_of(const Problem& problem, const Items& items, std::uint64_t first,
                     const std::vector<layout::Violation>& violations) {
  std::vector<int> broken(items.movable(), 0);
  for (const layout::Violation& v : violations)
    for (const std::uint64_t id : {v.a, v.b})
      if (id >= first) ++broken[id - first];
  std::size_t worst = 0;
  for (std::size_t i = 1; i < broken.size(); ++i)
    if (broken[i] > broken[worst] ||
        (broken[i] == broken[worst] && problem.area_of(items.parts[i]) < problem.area_of(items.parts[worst])))
      worst = i;
  return worst;
}

/// The violations of a document in which only the pieces of these have moved since the last check.
std::vector<layout::Violation> checked_again(const layout::Document& document,
                                             const std::vector<layout::Violation>& before) {
  std::set<std::uint64_t> ids;
  for (const layout::Violation& v : before) ids.insert({v.a, v.b});
  std::vector<layout::Placement> moved, others;
  for (const layout::Placement& p : document.placements) (ids.contains(p.id) ? moved : others).push_back(p);
  return layout::check_some(document, moved, others);
}

/// Shifts pieces that break a rule by what is missing, over and over; nothing where that does not end.
/// `at_first` gets the violations of the first round.
std::optional<Settled> mended(const Problem& problem, const Items& items, const State& state,
                              std::vector<Steps> at, std::vector<layout::Violation>& at_first) {
  const std::uint64_t first = problem.given().next_id;
  std::vector<layout::Violation> violations;
  for (int round = 0; round < tuning::kSettleRounds; ++round) {
    layout::Document document = placed(problem, items, state, at);
    violations = round == 0 ? layout::check(document) : checked_again(document, violations);
    if (violations.empty()) {
      Settled done{std::move(document), state};
      for (std::size_t i = 0; i < items.movable(); ++i) {
        Spot& spot = done.state.spots[i];
        spot.x = geom::mm_from_grid(std::llround(at[i].x));
        spot.y = geom::mm_from_grid(std::llround(at[i].y));
      }
      return done;
    }
    const bool can_end = std::all_of(violations.begin(), violations.end(), can_be_shifted);
    for (const layout::Violation& v : violations) shift(v, first, at);
    if (round == 0) at_first = violations;
    if (!can_end) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

/// nest.md, step 12.
Settled settled(const Problem& problem, const Items& items, State state) {
  std::vector<Steps> at(items.movable());
  for (std::size_t i = 0; i < items.movable(); ++i)
    at[i] = {state.spots[i].x * static_cast<double>(geom::kGridPerMm),
             state.spots[i].y * static_cast<double>(geom::kGridPerMm), false, false};
  std::vector<layout::Violation> broken;
  // Drawings in whole units fit one another in whole units, so these are tried first.
  if (problem.unit() > 0) {
    std::vector<Steps> snapped = at;
    const double unit = problem.unit() * static_cast<double>(geom::kGridPerMm);
    const auto snap = [&](double& value, bool& keeps) {
      const double near = std::round(value / unit) * unit;
      if (std::abs(value - near) > unit * 0x1p-10) return;
      value = near;
      keeps = true;
    };
    for (Steps& s : snapped) {
      snap(s.x, s.keeps_x);
      snap(s.y, s.keeps_y);
    }
    if (auto done = mended(problem, items, state, std::move(snapped), broken)) return std::move(*done);
  }
  bool is_whole = true;
  while (true) {
    if (auto done = mended(problem, items, state, at, broken)) {
      done->is_whole = is_whole;
      return std::move(*done);
    }
    state.spots[worst_of(problem, items, problem.given().next_id, broken)].bin = kNowhere;
    is_whole = false;
  }
}

}  // namespace lekalo::nest
