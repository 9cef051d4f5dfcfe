#include "lekalo/verify/layout.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <ranges>
#include <tuple>

#include "layout_document.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

struct Placed {
  const WrittenPiece* piece = nullptr;
  const WrittenPart* part = nullptr;
  GridOutline outline;
};

struct Found {
  std::size_t stock;
  std::int64_t copy;
  std::uint64_t a;
  LayoutRule kind;
  std::uint64_t b;
  std::size_t feature;
  [[nodiscard]] auto key() const { return std::tuple{stock, copy, a, kind, b, feature}; }
};

/// Takes from and to as doubles: docs/design/layout-verify.md says in which order the written angles are
/// added and rounded.
bool turned_within(GridTurn turn, double from, double to) {
  return to - from >= 360 || lies_between(turn, turn_of_degrees(from), turn_of_degrees(to));
}

bool rotation_allowed(const WrittenPart& part, GridTurn turn) {
  return part.rotations.empty() ||
         std::any_of(part.rotations.begin(), part.rotations.end(),
                     [&](const WrittenAngles& range) { return turned_within(turn, range.from, range.to); });
}

bool grain_allowed(const WrittenPart& part, const WrittenStock& stock, const WrittenPiece& piece) {
  if (!part.grain || !stock.grain) return true;
  const double of_part = piece.mirrored ? 180.0 - part.grain->degrees : part.grain->degrees;
  const double middle = *stock.grain - of_part, opposite = middle + 180.0, most = part.grain->tolerance;
  return turned_within(piece.turn, middle - most, middle + most) ||
         turned_within(piece.turn, opposite - most, opposite + most);
}

/// Says whether at some point of both, the part demands more than the zone has: an area of the part demands
/// it there, or the part itself where no area is.
bool demands_more(const Placed& placed_part, const WrittenStockFeature& zone) {
  const WrittenPart& part = *placed_part.part;
  std::vector<GridOutline> areas;
  for (const WrittenArea& area : part.areas) {
    areas.push_back(placed_outline(area.outline, *placed_part.piece));
    if (area.quality > zone.grade &&
        have_common_disc({&placed_part.outline, &zone.outline, &areas.back()}, {}))
      return true;
  }
  if (part.quality <= zone.grade) return false;
  std::vector<const GridOutline*> excused;
  for (const GridOutline& area : areas) excused.push_back(&area);
  return have_common_disc({&placed_part.outline, &zone.outline}, excused);
}

/// Checks what lies on one copy of a stock.
class SheetChecker {
 public:
  explicit SheetChecker(const WrittenLayout& layout) : layout_(layout) {}

  std::vector<Found> check(const std::vector<const WrittenPiece*>& on_it) {
    std::vector<Placed> pieces;
    for (const WrittenPiece* piece : on_it) {
      const WrittenPart& part = layout_.parts[piece->part];
      pieces.push_back({piece, &part, placed_outline(part.outline, *piece)});
    }
    for (const Placed& piece : pieces) check_alone(piece);
    check_pairs(pieces);
    return std::move(found_);
  }

 private:
  void add(const Placed& piece, LayoutRule kind, std::uint64_t other = 0, std::size_t feature = 0) {
    found_.push_back({piece.piece->stock, piece.piece->copy, piece.piece->id, kind, other, feature});
  }

  void check_alone(const Placed& placed) {
    const WrittenPiece& piece = *placed.piece;
    const WrittenPart& part = *placed.part;
    const WrittenStock& stock = layout_.stocks[piece.stock];
    ask(1 + placed.outline.edges.size() / 4);
    if (!rotation_allowed(part, piece.turn)) add(placed, LayoutRule::rotation);
    if (piece.mirrored && !part.may_mirror) add(placed, LayoutRule::mirror);
    if (!grain_allowed(part, stock, piece)) add(placed, LayoutRule::grain);
    if (piece.copy >= stock.count) add(placed, LayoutRule::stock);
    if (have_common_disc({&placed.outline}, {&stock.outline}))
      add(placed, LayoutRule::outside);
    else if (edges_nearer_than(placed.outline, stock.outline, part.border_gap))
      add(placed, LayoutRule::border_gap);
    for (std::size_t i = 0; i < stock.defects.size(); ++i) {
      const WrittenStockFeature& defect = stock.defects[i];
      if (defect.grade <= part.tolerated_severity) continue;
      if (have_common_disc({&placed.outline, &defect.outline}, {}))
        add(placed, LayoutRule::defect, 0, i);
      else if (edges_nearer_than(placed.outline, defect.outline, part.defect_gap))
        add(placed, LayoutRule::defect_gap, 0, i);
    }
    for (std::size_t i = 0; i < stock.zones.size(); ++i)
      if (demands_more(placed, stock.zones[i])) add(placed, LayoutRule::quality, 0, i);
  }

  /// Checks every two parts of one sheet whose boxes come within their gap.
  void check_pairs(std::vector<Placed>& pieces) {
    std::ranges::sort(pieces, {}, [](const Placed& p) {
      return std::pair{p.outline.box.low_x, p.piece->id};
    });
    const auto gap = [](const Placed& piece) { return piece.part->gap; };
    const std::int64_t largest = gap(*std::ranges::max_element(pieces, {}, gap));
    std::vector<const Placed*> active;
    for (const Placed& piece : pieces) {
      ask(1 + active.size());
      std::erase_if(active, [&](const Placed* other) {
        return other->outline.box.high_x + largest < piece.outline.box.low_x;
      });
      for (const Placed* other : active) check_pair(piece, *other);
      active.push_back(&piece);
    }
  }

  void check_pair(const Placed& p, const Placed& q) {
    const auto [a, b] = std::minmax(
        {&p, &q}, [](const Placed* one, const Placed* other) { return one->piece->id < other->piece->id; });
    if (have_common_disc({&a->outline, &b->outline}, {}))
      add(*a, LayoutRule::overlap, b->piece->id);
    else if (edges_nearer_than(a->outline, b->outline, std::max(a->part->gap, b->part->gap)))
      add(*a, LayoutRule::gap, b->piece->id);
  }

  const WrittenLayout& layout_;
  std::vector<Found> found_;
};

/// Sheets have nothing to do with each other, so two of them are looked at at a time.
std::vector<Found> found_on_sheets(const WrittenLayout& layout) {
  std::map<std::pair<std::size_t, std::int64_t>, std::vector<const WrittenPiece*>> by_sheet;
  for (const WrittenPiece& piece : layout.placements) by_sheet[{piece.stock, piece.copy}].push_back(&piece);
  std::vector<std::vector<const WrittenPiece*>> sheets;
  for (auto& [sheet, pieces] : by_sheet) sheets.push_back(std::move(pieces));
  std::vector<std::vector<Found>> found(sheets.size());
  share_out(sheets.size(), kUsualThreads,
            [&](std::size_t i) { found[i] = SheetChecker(layout).check(sheets[i]); });
  std::vector<Found> all;
  for (const std::vector<Found>& one : found) all.insert(all.end(), one.begin(), one.end());
  std::ranges::sort(all, {}, &Found::key);
  return all;
}

}  // namespace

GridOutline placed_outline(const GridOutline& outline, const WrittenPiece& piece) {
  GridOutline result;
  result.edges.reserve(outline.edges.size());
  for (const GridEdge& edge : outline.edges) {
    const GridPoint from = placed(edge.from, piece.turn, piece.mirrored, piece.at),
                    to = placed(edge.to, piece.turn, piece.mirrored, piece.at);
    result.edges.push_back(piece.mirrored ? GridEdge{to, from} : GridEdge{from, to});
    if (result.edges.size() == 1) result.box = {from.x, from.y, from.x, from.y};
    result.box = {std::min(result.box.low_x, from.x), std::min(result.box.low_y, from.y),
                  std::max(result.box.high_x, from.x), std::max(result.box.high_y, from.y)};
  }
  return result;
}

std::string_view name_of(LayoutRule rule) noexcept {
  constexpr std::array<std::string_view, 11> kNames{"overlap", "gap",        "outside", "border-gap",
                                                    "defect",  "defect-gap", "quality", "rotation",
                                                    "mirror",  "grain",      "stock"};
  return kNames[static_cast<std::size_t>(rule)];
}

Result<LayoutVerdict> verify_layout(const Document& document) {
  LEKALO_TRY(const auto layout, read_layout(document));
  LayoutVerdict verdict;
  verdict.placements = layout.placements.size();
  for (const Found& found : found_on_sheets(layout)) {
    const WrittenStock& stock = layout.stocks[found.stock];
    LayoutViolation violation{found.kind, found.a, found.b, stock.id, found.copy, {}};
    if (found.kind == LayoutRule::quality) violation.feature = stock.zones[found.feature].id;
    if (found.kind == LayoutRule::defect || found.kind == LayoutRule::defect_gap)
      violation.feature = stock.defects[found.feature].id;
    verdict.violations.push_back(std::move(violation));
  }
  return verdict;
}

}  // namespace lekalo::verify
