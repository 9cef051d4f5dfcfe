#include "lekalo/layout/completeness.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "kit_choice.hpp"
#include "lekalo/geom/boolean.hpp"
#include "remnant.hpp"

namespace lekalo::layout {
namespace {

/// The pieces of one part that one kit takes.
struct Share {
  std::int64_t upright = 0, mirrored = 0, either = 0;
  void add(std::optional<bool> hand, std::int64_t count) {
    (hand ? (*hand ? mirrored : upright) : either) += count;
  }
};

std::map<std::uint32_t, Share> shares_of(const Kit& kit) {
  std::map<std::uint32_t, Share> shares;
  for (const KitPiece& piece : kit.pieces) shares[piece.part].add(piece.mirrored, piece.count);
  return shares;
}

/// Takes pieces that serve either way, from the side that has more.
void take_either(PieceCount& pieces, std::int64_t count) {
  const std::int64_t level =
      std::min(count, std::max<std::int64_t>(0, std::abs(pieces.upright - pieces.mirrored)));
  (pieces.upright >= pieces.mirrored ? pieces.upright : pieces.mirrored) -= level;
  const std::int64_t rest = count - level;
  pieces.upright -= rest / 2 + rest % 2;
  pieces.mirrored -= rest / 2;
  // The even split may ask more of one side than it has.
  if (pieces.upright < 0) pieces.mirrored += pieces.upright, pieces.upright = 0;
  if (pieces.mirrored < 0) pieces.upright += pieces.mirrored, pieces.mirrored = 0;
}

/// Adds the pieces that are missing for `kits` more kits. The pieces that are there are taken out of
/// `pieces`.
void add_missing(std::uint32_t part, const Share& share, std::int64_t kits, PieceCount& pieces,
                 std::vector<MissingPiece>& missing) {
  const auto short_of = [&](std::int64_t wanted, std::int64_t& there, std::optional<bool> mirrored) {
    const std::int64_t taken = std::min(wanted, there);
    there -= taken;
    if (wanted > taken) missing.push_back({part, wanted - taken, mirrored});
  };
  if (share.upright > 0) short_of(kits * share.upright, pieces.upright, false);
  if (share.mirrored > 0) short_of(kits * share.mirrored, pieces.mirrored, true);
  const std::int64_t either = kits * share.either, there = std::min(either, pieces.total());
  take_either(pieces, there);
  if (either > there) missing.push_back({part, either - there, std::nullopt});
}

/// Returns the area of the stock's defects within `material`, where each point counts once.
double lost_to_defects(const Stock& stock, const geom::GridRegion& material) {
  if (stock.defects.empty()) return 0;
  std::vector<geom::Region> defects;
  for (const Defect& defect : stock.defects) defects.push_back(geom::region_of_lines(defect.outline.polygon));
  const auto lost =
      geom::combine({geom::region_of_lines(material)}, defects, geom::BooleanOperation::intersect);
  return lost ? geom::area(lost->regions) : 0;
}

SheetUse use_of(const Document& document, Sheet sheet, const std::vector<const Placement*>& placements) {
  const Stock& stock = document.stocks[sheet.stock];
  SheetUse use;
  use.sheet = sheet;
  use.parts = placements.size();
  std::int64_t last = 0;
  std::vector<geom::GridRegion> taken;
  for (const Placement* placement : placements) {
    taken.push_back(placed_outline(document.parts[placement->part], *placement));
    use.parts_area += geom::area_mm2(taken.back());
    last = std::max(last, bounds(taken.back()).high.x);
  }
  for (const Defect& defect : stock.defects) taken.push_back(defect.outline.polygon);
  use.used_length_mm = geom::mm_from_grid(last);
  geom::GridRegion material = stock.outline.polygon;
  geom::GridBox within = bounds(material);
  if (stock.kind == StockKind::strip) {
    const geom::GridBox used{within.low, {std::max(last, within.low.x + 1), within.high.y}};
    material = rectangle(used);
    if (stock.open_length) within = used;
  }
  use.material_area = geom::area_mm2(material);
  use.defect_area = lost_to_defects(stock, material);
  use.remnant = free_rectangle(stock.outline.polygon, taken, within);
  return use;
}

/// A piece as it lies, without its name.
using Lying = std::tuple<std::uint32_t, std::int64_t, std::int64_t, bool, std::int64_t, std::int64_t>;

std::vector<Lying> lying_on(const std::vector<const Placement*>& placements) {
  std::vector<Lying> lying;
  for (const Placement* p : placements)
    lying.emplace_back(p->part, p->rotation.c, p->rotation.s, p->mirrored, p->at.x, p->at.y);
  std::sort(lying.begin(), lying.end());
  return lying;
}

}  // namespace

KitsMade kits_made(const Document& document, std::vector<PieceCount> placed) {
  KitsMade made{most_valuable_kits(document, placed), std::move(placed)};
  std::map<std::uint32_t, Share> taken;
  for (std::size_t k = 0; k < made.complete.size(); ++k)
    for (const KitPiece& piece : document.kits[k].pieces)
      taken[piece.part].add(piece.mirrored, made.complete[k] * piece.count);
  for (const auto& [part, share] : taken) {
    PieceCount& left = made.left[part];
    left.upright -= share.upright;
    left.mirrored -= share.mirrored;
    take_either(left, share.either);
  }
  return made;
}

KitsServed kits_served(const Document& document) {
  KitsServed served;
  served.placed.resize(document.parts.size());
  for (const Placement& placement : document.placements) {
    PieceCount& count = served.placed[placement.part];
    ++(placement.mirrored ? count.mirrored : count.upright);
  }
  KitsMade made = kits_made(document, served.placed);
  served.left = std::move(made.left);
  for (std::size_t kit = 0; kit < document.kits.size(); ++kit) {
    KitCount& count = served.kits.emplace_back(KitCount{made.complete[kit], {}});
    for (const auto& [part, share] : shares_of(document.kits[kit]))
      add_missing(part, share, document.kits[kit].demand - count.complete, served.left[part], count.missing);
  }
  return served;
}

Completeness completeness(const Document& document) {
  Completeness result;
  std::map<Sheet, std::vector<const Placement*>> sheets;
  for (const Placement& placement : document.placements)
    sheets[{placement.stock, placement.copy}].push_back(&placement);

  KitsServed served = kits_served(document);
  result.placed = std::move(served.placed);
  result.kits = std::move(served.kits);
  result.missing.resize(document.parts.size());
  result.surplus.resize(document.parts.size());
  for (const KitCount& kit : result.kits)
    for (const MissingPiece& piece : kit.missing) result.missing[piece.part] += piece.count;
  for (std::uint32_t part = 0; part < document.parts.size(); ++part) {
    const std::int64_t own = document.parts[part].demand, there = served.left[part].total();
    result.missing[part] += std::max<std::int64_t>(0, own - there);
    result.surplus[part] = std::max<std::int64_t>(0, there - own);
  }

  double parts_area = 0, material_area = 0;
  // Large orders have many sheets on which the same lies, and the rest of one takes milliseconds to find.
  std::map<std::pair<std::uint32_t, std::vector<Lying>>, SheetUse> known;
  for (const auto& [sheet, placements] : sheets) {
    if (sheet.copy < 0 || sheet.copy >= document.stocks[sheet.stock].count) continue;
    const auto [like, is_new] = known.try_emplace({sheet.stock, lying_on(placements)});
    if (is_new) like->second = use_of(document, sheet, placements);
    SheetUse& use = result.sheets.emplace_back(like->second);
    use.sheet = sheet;
    parts_area += use.parts_area;
    material_area += use.material_area;
    result.cost += document.stocks[sheet.stock].cost;
  }
  if (material_area > 0) result.density = parts_area / material_area;
  return result;
}

}  // namespace lekalo::layout
