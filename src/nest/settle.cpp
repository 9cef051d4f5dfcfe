#include "settle.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/layout/check.hpp"

namespace lekalo::nest {
namespace {

constexpr int kRounds = 60;
/// Beyond what is missing, steps: two roundings.
constexpr double kReserve = 2.0;

struct Steps {
  double x = 0, y = 0;
  bool keeps_x = false, keeps_y = false;
};

layout::Document placed(const Problem& problem, const Items& items, const State& state,
                        const std::vector<Steps>& at) {
  layout::Document document = problem.document();
  std::erase_if(document.placements, [](const layout::Placement& p) { return !p.locked; });
  for (std::size_t i = 0; i < items.movable(); ++i) {
    const Spot& spot = state.spots[i];
    if (spot.bin == kNowhere) continue;
    const Form& form = problem.forms()[spot.form];
    layout::Placement placement;
    placement.id = problem.document().next_id + i;
    placement.part = items.parts[i];
    placement.stock = problem.bins()[spot.bin].stock;
    placement.copy = problem.bins()[spot.bin].copy;
    placement.rotation = form.rotation;
    placement.mirrored = form.mirrored;
    placement.at = {std::llround(at[i].x), std::llround(at[i].y)};
    document.placements.push_back(placement);
  }
  document.next_id = problem.document().next_id + items.movable();
  return document;
}

/// Shifts what breaks a rule by what is missing, over and over.
std::optional<layout::Document> mended(const Problem& problem, const Items& items, const State& state,
                                       std::vector<Steps> at) {
  const std::uint64_t first = problem.document().next_id;
  for (int round = 0; round < kRounds; ++round) {
    layout::Document document = placed(problem, items, state, at);
    const std::vector<layout::Violation> violations = layout::check(document);
    if (violations.empty()) return document;
    for (const layout::Violation& v : violations) {
      geom::Point direction = v.direction;
      const double amount = v.amount_mm;
      if (v.kind == layout::ViolationKind::rotation || v.kind == layout::ViolationKind::mirror ||
          v.kind == layout::ViolationKind::grain || v.kind == layout::ViolationKind::stock)
        return std::nullopt;
      if (direction.x == 0 && direction.y == 0) return std::nullopt;
      const double by = amount * static_cast<double>(geom::kGridPerMm) + kReserve;
      const auto move = [&](std::uint64_t id, double share) {
        if (id < first) return;
        Steps& s = at[id - first];
        if (!s.keeps_x) s.x += share * by * direction.x;
        if (!s.keeps_y) s.y += share * by * direction.y;
      };
      const bool one = v.b == 0 || v.b < first || v.a < first;
      // Rightwards there is room on a strip: whoever lies there gives way.
      if (one) {
        move(v.a, 1);
        move(v.b, -1);
      } else if (direction.x > 0) {
        move(v.a, 0.75);
        move(v.b, -0.25);
      } else {
        move(v.a, 0.25);
        move(v.b, -0.75);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<layout::Document> settled(const Problem& problem, const Items& items, const State& state) {
  std::vector<Steps> at(items.movable());
  for (std::size_t i = 0; i < items.movable(); ++i)
    at[i] = {state.spots[i].x * static_cast<double>(geom::kGridPerMm),
             state.spots[i].y * static_cast<double>(geom::kGridPerMm), false, false};
  // Drawings in whole units fit one another in whole units.
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
    if (auto document = mended(problem, items, state, std::move(snapped))) return document;
  }
  return mended(problem, items, state, std::move(at));
}

}  // namespace lekalo::nest
