#include "reason.hpp"

#include <algorithm>

#include "builder.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {
namespace {

/// True if a place for one piece is found on stock that holds only what counts.
bool has_place(const Problem& problem, std::uint32_t part, Placer::Counts counts) {
  const auto& bins = problem.bins();
  Items items;
  items.parts = {part};
  items.forms = {problem.forms_of(part)};
  Placer placer(problem, items, Random(0, 0), counts);
  placer.load(empty_state(problem, items));
  for (std::uint32_t b = 0; b < bins.size(); ++b) {
    const bool is_first = b == 0 || bins[b].stock != bins[b - 1].stock;
    if (is_first && placer.can_hold(b, 0) && placer.place_low(0, b, tuning::kReasonTries)) return true;
  }
  return false;
}

}  // namespace

Reason reason_alone(const Problem& problem, std::uint32_t part) {
  if (has_place(problem, part, Placer::Counts::features)) return Reason::no_stock;
  if (has_place(problem, part, Placer::Counts::border)) return Reason::no_zone;
  return Reason::too_large;
}

}  // namespace lekalo::nest
