#include "lekalo/jobs/nest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>

#include "jobs/document/report_document.hpp"
#include "layout_json.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/jobs/check.hpp"
#include "nest_checked.hpp"
#include "nest_rows.hpp"

namespace lekalo::jobs {
namespace {

using layout::Document;
using layout::Placement;

/// Returns the placement with this id, or nullptr where there is none.
const Placement* placement_of(const Document& document, std::uint64_t id) {
  const auto found = std::lower_bound(document.placements.begin(), document.placements.end(), id,
                                      [](const Placement& p, std::uint64_t wanted) { return p.id < wanted; });
  return found != document.placements.end() && found->id == id ? &*found : nullptr;
}

/// Returns the document with everything but a selection locked and nothing wanted, so that the nester moves
/// the selection alone.
Document selection_of(Document document, const std::vector<std::uint64_t>& only) {
  for (Placement& p : document.placements) p.locked = !std::binary_search(only.begin(), only.end(), p.id);
  for (layout::Part& part : document.parts) part.demand = 0;
  for (layout::Kit& kit : document.kits) kit.demand = 0;
  return document;
}

/// Returns the given document with the placements of another one, and the locks as they were given.
Document placed_as(Document given, const Document& found) {
  std::vector<Placement> placements = found.placements;
  for (Placement& p : placements)
    if (const Placement* const before = placement_of(given, p.id)) p.locked = before->locked;
  given.placements = std::move(placements);
  given.next_id = found.next_id;
  return given;
}

NestStanding standing_of(const Document& document) {
  std::map<layout::Sheet, double> reach;
  double parts = 0;
  for (const Placement& p : document.placements) {
    const geom::GridRegion outline = placed_outline(document.parts[p.part], p);
    parts += geom::area_mm2(outline);
    double& far = reach[{p.stock, p.copy}];
    far = std::max(far, geom::mm_from_grid(geom::bounds(outline).high.x));
  }
  NestStanding standing;
  double material = 0;
  for (const auto& [sheet, far] : reach) {
    const geom::GridRegion& outline = document.stocks[sheet.stock].outline.polygon;
    const geom::GridBox box = geom::bounds(outline);
    standing.length_mm = far;
    material += document.stocks[sheet.stock].kind == layout::StockKind::strip
                    ? far * geom::mm_from_grid(box.high.y - box.low.y)
                    : geom::area_mm2(outline);
  }
  standing.sheets = reach.size();
  if (material > 0) standing.density = parts / material;
  if (document.kits.empty()) return standing;
  std::vector<layout::PieceCount> placed(document.parts.size());
  for (const Placement& p : document.placements)
    ++(p.mirrored ? placed[p.part].mirrored : placed[p.part].upright);
  for (const std::int64_t kits : layout::kits_made(document, std::move(placed)).complete)
    standing.kits_complete += kits;
  for (const layout::Kit& kit : document.kits) standing.kits_wanted += kit.demand;
  return standing;
}

void write(io::JsonWriter& json, const layout::SheetUse& use, const Document& document) {
  json.begin_object().fields({{"stock", document.stocks[use.sheet.stock].id},
                              {"copy", use.sheet.copy},
                              {"parts", use.parts},
                              {"density", use.density()},
                              {"length", use.used_length_mm}});
  json.key("remnant");
  if (use.remnant.low.x < use.remnant.high.x) {
    const geom::Point low = geom::mm_from_grid(use.remnant.low), high = geom::mm_from_grid(use.remnant.high);
    json.list({low.x, low.y, high.x, high.y});
  } else {
    json.value(nullptr);
  }
  json.end();
}

void write_kits(io::JsonWriter& json, const Nested& nested) {
  json.begin_list();
  for (std::size_t i = 0; i < nested.document.kits.size(); ++i)
    json.object({{"kit", nested.document.kits[i].id},
                 {"complete", nested.completeness.kits[i].complete},
                 {"wanted", nested.document.kits[i].demand},
                 {"value", nested.document.kits[i].value}});
  json.end();
}

}  // namespace

Result<void> fine_selection(const Document& document, const std::vector<std::uint64_t>& ids) {
  for (const std::uint64_t id : ids) {
    const Placement* const found = placement_of(document, id);
    if (found == nullptr) return failure(ErrorCode::usage, fmt::format("there is no placement {}", id));
    if (found->locked) return failure(ErrorCode::usage, fmt::format("placement {} is locked", id));
  }
  return {};
}

Result<Nested> nest_checked(const Nester& nester, const Document& document, const NestOptions& options,
                            const RunControl& control) {
  LEKALO_CHECK(fine_selection(document, options.only));
  nest::Options search;
  search.seed = options.seed;
  search.threads = options.threads;
  search.angles = options.angles;
  search.from_given = options.from_given;
  search.pair_distance = options.pair_distance;
  search.remnant = options.remnant;
  // This stays without an error until a check refutes a better layout, or the caller does not take it.
  Result<void> fine;
  search.improved = [&](const nest::Nested& better) {
    if (options.improved && fine) {
      const Document layout = placed_as(document, better.document);
      const std::string bytes = io::write_layout(layout);
      fine = confirm_layout(layout, bytes).and_then([&] { return options.improved(layout, bytes); });
    }
    if (options.standing) options.standing(standing_of(better.document));
  };
  LEKALO_TRY(nest::Nested found, options.only.empty()
                                     ? nester(document, search, control)
                                     : nester(selection_of(document, options.only), search, control));
  LEKALO_CHECK(fine);
  // The best until a stop is checked and told all the same, and what is being checked is, too.
  const RunControl nobody;
  const Listening to_the_end(nobody);
  Nested best{placed_as(document, found.document),
              {},
              std::move(found.unplaced),
              found.work,
              found.merges,
              {},
              found.searched};
  share_out(2, kUsualThreads, [&](std::size_t task) {
    if (task == 0) best.bytes = io::write_layout(best.document);
    if (task == 1) best.completeness = layout::completeness(best.document);
  });
  Result<void> taken;
  share_out(2, kUsualThreads, [&](std::size_t task) {
    if (task == 0) fine = confirm_layout(best.document, best.bytes);
    if (task == 1 && options.while_checked) taken = options.while_checked(best.bytes);
  });
  LEKALO_CHECK(fine);
  LEKALO_CHECK(taken);
  return best;
}

Result<Nested> nest(const Document& document, const NestOptions& options, const RunControl& control) {
  if (options.common_line_gap_mm == 0) return nest_checked(nest::nest, document, options, control);
  CommonRows rows;
  const std::int64_t gap = geom::grid_from_mm_up(options.common_line_gap_mm);
  Result<Nested> nested =
      nest_checked([&](const Document& wanted, const nest::Options& search,
                       const RunControl& until) { return nest_in_rows(wanted, gap, search, until, rows); },
                   document, options, control);
  if (nested) nested->rows = rows;
  return nested;
}

void write_unplaced(io::JsonWriter& json, const Nested& nested) {
  json.key("unplaced").list(nested.unplaced, [&](const nest::Unplaced& u) {
    json.object({{"part", nested.document.parts[u.part].id},
                 {"count", u.count},
                 {"reason", nest::name_of(u.reason)}});
  });
}

std::string nest_json(const Layout& given, const NestOptions& options, const Nested& nested,
                      const std::string& written_as, double cpu_seconds) {
  io::JsonWriter json = begin_layout_json("lekalo-nest", nested.unplaced.empty() ? "complete" : "incomplete",
                                          given, options.seed, nested.work);
  json.key("outputs").begin_list();
  write_file(json, "nested", {written_as, nested.bytes});
  json.end().fields({{"merges", nested.merges},
                     {"density", nested.completeness.density},
                     {"cost", nested.completeness.cost}});
  const auto& sheets = nested.completeness.sheets;
  if (sheets.size() == 1) json.field("length", sheets[0].used_length_mm);
  json.key("stocks").list(sheets, [&](const layout::SheetUse& use) { write(json, use, nested.document); });
  write_kits(json.key("kits"), nested);
  write_unplaced(json, nested);
  json.key("run").object({{"cpu_seconds", cpu_seconds}, {"threads", options.threads}});
  return end_document(json);
}

}  // namespace lekalo::jobs
