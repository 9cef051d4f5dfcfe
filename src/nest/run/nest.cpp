#include "lekalo/nest/nest.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/layout/check.hpp"
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
  layout::Document locked = document;
  std::erase_if(locked.placements, [](const layout::Placement& p) { return !p.locked; });
  const auto violations = layout::check(locked);
  if (!violations.empty())
    return failure(ErrorCode::bad_input,
                   fmt::format("placement {}, which is to stay, breaks a rule ({}); move or unlock it first",
                               violations[0].a, layout::name_of(violations[0].kind)));
  return {};
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
  }
  return "";
}

Result<Nested> nest(const layout::Document& document, const Options& options, const RunControl& control) {
  LEKALO_CHECK(check_document(document, options.from_given));
  SearchOptions search;
  search.angles_of_any = std::clamp<std::size_t>(options.angles, 1, 360);
  search.given_angles = options.from_given;
  const Problem problem(document, search);
  Wanted wanted = wanted_items(problem, options.from_given);
  add_partners(problem, options.pair_distance, wanted.items);
  return run(problem, wanted, options, control);
}

}  // namespace lekalo::nest
