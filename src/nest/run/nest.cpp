#include "lekalo/nest/nest.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/base/stop.hpp"
#include "lekalo/layout/check.hpp"
#include "nest/exact/columns.hpp"
#include "nest/table/simplify.hpp"
#include "outer_outlines.hpp"
#include "run.hpp"

namespace lekalo::nest {
namespace {

/// The most pieces of one document: the exact check and the weights of pairs grow with their square.
constexpr std::int64_t kMostPieces = 100'000;

Result<void> check_document(const layout::Document& document, bool from_given) {
  if (document.stocks.empty())
    return failure(ErrorCode::bad_input, "the layout has no stock to nest on: add a strip, sheets or hides");
  std::int64_t pieces = 0;
  for (std::uint32_t p = 0; p < document.parts.size(); ++p) {
    pieces += layout::wanted(document, p);
    if (pieces > kMostPieces)
      return failure(
          ErrorCode::bad_input,
          fmt::format("more than {} pieces are wanted; nest them in several layouts", kMostPieces));
  }
  const bool has_given = from_given && std::any_of(document.placements.begin(), document.placements.end(),
                                                   [](const layout::Placement& p) { return !p.locked; });
  if (pieces == 0 && !has_given)
    return failure(ErrorCode::bad_input, "nothing to nest: no part has a demand and no kit is wanted");
  if (std::none_of(document.placements.begin(), document.placements.end(),
                   [](const layout::Placement& p) { return p.locked; }))
    return {};
  layout::Document locked = document;
  std::erase_if(locked.placements, [](const layout::Placement& p) { return !p.locked; });
  const auto violations = layout::check(locked);
  if (!violations.empty())
    return failure(ErrorCode::bad_input,
                   fmt::format("placement {}, which is to stay, breaks a rule ({}); move or unlock it first",
                               violations[0].a, layout::name_of(violations[0].kind)));
  return {};
}

/// The layout of a run that was stopped before it began: the given one where it breaks no rule, or what is
/// locked of it.
Nested as_given(const layout::Document& document, bool from_given) {
  const RunControl to_the_end;
  const Listening listening(to_the_end);
  Nested nested;
  nested.document = document;
  if (!from_given || !layout::check(document).empty())
    std::erase_if(nested.document.placements, [](const layout::Placement& p) { return !p.locked; });
  nested.merges = 1;
  for (std::uint32_t p = 0; p < document.parts.size(); ++p) {
    const auto placed = std::count_if(nested.document.placements.begin(), nested.document.placements.end(),
                                      [&](const layout::Placement& one) { return one.part == p; });
    const std::int64_t missing = layout::wanted(document, p) - placed;
    if (missing > 0) nested.unplaced.push_back({p, missing, Reason::not_tried});
  }
  return nested;
}

/// The layout that a search finds until a stop.
Nested found_until_stop(const layout::Document& document, const Options& options, const RunControl& control) {
  SearchOptions search;
  search.angles_of_any = std::clamp<std::size_t>(options.angles, 1, 360);
  search.given_angles = options.from_given;
  search.remnant = options.remnant;
  // A run has a work limit of its own, and nothing but its flag ends it sooner.
  RunControl until_stop;
  until_stop.stop = control.stop;
  const Listening listening(until_stop);
  try {
    const layout::Document searched = with_outer_outlines(document, options.from_given);
    const Problem problem(document, searched, search);
    Wanted wanted = wanted_items(problem, options.from_given);
    add_partners(problem, options.pair_distance, wanted.items);
    return run(problem, wanted, options, control);
  } catch (const Stopped&) {
    return as_given(document, options.from_given);
  }
}

}  // namespace

std::string_view name_of(Reason reason) noexcept {
  switch (reason) {
    case Reason::no_angle:
      return "no-angle";
    case Reason::too_large:
      return "too-large";
    case Reason::no_zone:
      return "no-zone";
    case Reason::no_stock:
      return "no-stock";
    case Reason::not_tried:
      return "not-tried";
  }
  return "";
}

Result<Nested> nest(const layout::Document& document, const Options& options, const RunControl& control) {
  LEKALO_CHECK(check_document(document, options.from_given));
  Nested nested = found_until_stop(document, options, control);
  const RunControl to_the_end;
  const Listening listening(to_the_end);
  place_in_columns(nested.document, nested.unplaced);
  return nested;
}

}  // namespace lekalo::nest
