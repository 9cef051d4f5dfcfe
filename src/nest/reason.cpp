#include "reason.hpp"

#include <algorithm>

#include "builder.hpp"

namespace lekalo::nest {
namespace {

constexpr std::size_t kTries = 4000;

/// Whether a place was found on stock with nothing on it but what `counts` says.
template <class Counts>
bool has_place(const Problem& problem, std::uint32_t part, Counts counts) {
  const auto& bins = problem.bins();
  Items items;
  items.parts = {part};
  items.forms = {problem.forms_of(part)};
  for (std::uint32_t b = 0; b < bins.size(); ++b)
    for (const Obstacle& o : bins[b].obstacles)
      if (counts(problem.kind_of(problem.forms()[o.form]))) items.fixed.push_back({o.x, o.y, o.form, b});
  Separator separator(problem, items, Random(0, 0));
  separator.load(empty_state(problem, items));
  for (std::uint32_t b = 0; b < bins.size(); ++b) {
    const bool is_first = b == 0 || bins[b].stock != bins[b - 1].stock;
    if (is_first && separator.can_hold(b, 0) && separator.place_low(0, b, kTries)) return true;
  }
  return false;
}

}  // namespace

Reason reason_alone(const Problem& problem, std::uint32_t part) {
  using Kind = SearchShape::Kind;
  if (has_place(problem, part, [](Kind kind) { return kind != Kind::part; })) return Reason::no_stock;
  if (has_place(problem, part, [](Kind kind) { return kind == Kind::border; })) return Reason::no_zone;
  return Reason::too_large;
}

}  // namespace lekalo::nest
