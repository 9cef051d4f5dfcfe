#include "lekalo/layout/completeness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/layout_cases.hpp"

namespace lekalo::layout::layout_completeness_test {
namespace {

using cases::box_loop;
using cases::outline_of;

constexpr std::int64_t mm = geom::kGridPerMm;

/// Parts 0 and 1: squares of 10 and of 20, on a sheet of 200 x 100.
Document order() {
  Document document;
  for (const double size : {10.0, 20.0}) {
    Part part;
    part.id = "square " + std::to_string(static_cast<int>(size));
    part.outline = outline_of({box_loop(0, 0, size, size)});
    part.may_mirror = true;
    document.parts.push_back(part);
  }
  Stock stock;
  stock.id = "sheet";
  stock.count = 3;
  stock.cost = 7;
  stock.outline = outline_of({box_loop(0, 0, 200, 100)});
  document.stocks = {stock};
  return document;
}

void place(Document& document, std::uint32_t part, double x, double y, bool mirrored = false,
           std::int64_t copy = 0) {
  Placement placement;
  placement.id = document.next_id++;
  placement.part = part;
  placement.copy = copy;
  placement.mirrored = mirrored;
  placement.at = cases::grid_point(mirrored ? x + 10.0 * (part + 1) : x, y);
  document.placements.push_back(placement);
}
void place_many(Document& document, std::uint32_t part, int upright, int mirrored) {
  for (int i = 0; i < upright + mirrored; ++i) place(document, part, 0, 0, i >= upright);
}

Completeness of(const Document& document) { return completeness(Workspace(document)); }

Kit kit(std::int64_t demand, std::vector<KitPiece> pieces) {
  Kit result;
  result.id = "kit";
  result.demand = demand;
  result.pieces = std::move(pieces);
  return result;
}
const std::optional<bool> kUpright = false, kMirrored = true, kEither;

std::string text(const std::vector<MissingPiece>& missing) {
  std::string words;
  for (const MissingPiece& piece : missing)
    words += std::to_string(piece.count) + " of " + std::to_string(piece.part) +
             (piece.mirrored ? (*piece.mirrored ? " mirrored; " : " upright; ") : "; ");
  return words;
}

TEST(LayoutCompleteness, APairNeedsOneOfEachSide) {
  Document document = order();
  document.kits = {kit(3, {{0, 1, kUpright}, {0, 1, kMirrored}})};
  place_many(document, 0, 4, 1);
  const Completeness c = of(document);
  EXPECT_EQ(c.placed[0], (PieceCount{4, 1}));
  EXPECT_EQ(c.kits[0].complete, 1);
  EXPECT_EQ(text(c.kits[0].missing), "2 of 0 mirrored; ");
  EXPECT_EQ(c.missing[0], 2);
  EXPECT_EQ(c.surplus[0], 1);  // four upright, three wanted
  EXPECT_EQ(wanted(document, 0), 6);
}

TEST(LayoutCompleteness, EitherSideServesWhereNobodySays) {
  Document document = order();
  document.kits = {kit(2, {{0, 1, kUpright}, {0, 2, kEither}})};
  place_many(document, 0, 2, 4);
  EXPECT_EQ(of(document).kits[0].complete, 2);
  // Uneven sides: what may be either must not take the last upright ones.
  document.placements.clear();
  place_many(document, 0, 1, 5);
  Completeness c = of(document);
  EXPECT_EQ(c.kits[0].complete, 1);
  EXPECT_EQ(text(c.kits[0].missing), "1 of 0 upright; ");
  EXPECT_EQ(c.missing[0], 1);
  EXPECT_EQ(c.surplus[0], 1);
  document.placements.clear();
  place_many(document, 0, 6, 0);
  EXPECT_EQ(of(document).kits[0].complete, 2);
}

TEST(LayoutCompleteness, KitsThatShareAPartAreServedInTheirOrder) {
  Document document = order();
  document.kits = {kit(2, {{0, 2, kEither}}), kit(2, {{0, 1, kEither}, {1, 1, kEither}})};
  document.parts[0].demand = 1;
  place_many(document, 0, 5, 0);
  place_many(document, 1, 1, 0);
  Completeness c = of(document);
  EXPECT_EQ(c.kits[0].complete, 2);
  EXPECT_EQ(c.kits[1].complete, 1);
  EXPECT_EQ(text(c.kits[1].missing), "1 of 0; 1 of 1; ");
  EXPECT_EQ(c.missing[0], 2);  // one for the kit, one of its own
  EXPECT_EQ(c.missing[1], 1);
  EXPECT_EQ(c.surplus, (std::vector<std::int64_t>{0, 0}));
  // Pieces beyond all that is wanted are surplus.
  place_many(document, 0, 4, 0);
  c = of(document);
  EXPECT_EQ(text(c.kits[1].missing), "1 of 1; ");
  EXPECT_EQ(c.missing[0], 0);
  EXPECT_EQ(c.surplus[0], 2);  // nine placed; 4 + 2 + 1 are wanted
}

TEST(LayoutCompleteness, NothingWantedIsCompleteAndAllIsSurplus) {
  Document document = order();
  document.kits = {kit(0, {{0, 1, kEither}})};
  place_many(document, 0, 1, 1);
  const Completeness c = of(document);
  EXPECT_EQ(c.kits[0].complete, 0);
  EXPECT_TRUE(c.kits[0].missing.empty());
  EXPECT_EQ(c.surplus[0], 2);
}

TEST(LayoutCompleteness, SheetsInUseCountAloneAndTogether) {
  Document document = order();
  place(document, 0, 5, 5);
  place(document, 1, 50, 5);
  place(document, 1, 10, 10, false, 2);
  place(document, 1, 10, 10, false, 5);  // there is no such copy: the check says so, nothing is counted
  const Completeness c = of(document);
  ASSERT_EQ(c.sheets.size(), 2U);
  EXPECT_EQ(c.sheets[0].sheet, (Sheet{0, 0}));
  EXPECT_EQ(c.sheets[0].parts, 2U);
  EXPECT_EQ(c.sheets[0].parts_area, 500);
  EXPECT_EQ(c.sheets[0].material_area, 20000);
  EXPECT_EQ(c.sheets[0].used_length_mm, 70);
  EXPECT_EQ(c.sheets[0].density(), 0.025);
  EXPECT_EQ(c.sheets[1].sheet, (Sheet{0, 2}));
  EXPECT_EQ(c.density, 900.0 / 40000);
  EXPECT_EQ(c.cost, 14);
}

TEST(LayoutCompleteness, AStripCountsAsFarAsItIsUsed) {
  Document document = order();
  Stock& strip = document.stocks[0];
  strip.kind = StockKind::strip;
  strip.count = 1;
  for (const bool open : {true, false}) {
    strip.open_length = open;
    strip.outline = outline_of({box_loop(0, 0, open ? geom::mm_from_grid(kLongestStrip) : 500, 40)});
    document.placements.clear();
    place(document, 1, 30, 0);
    const Completeness c = of(document);
    EXPECT_EQ(c.sheets[0].used_length_mm, 50);
    EXPECT_EQ(c.sheets[0].material_area, 2000);
    EXPECT_EQ(c.sheets[0].density(), 0.2);
    // What is left lies within the length used where nobody says how long the strip is, else behind it.
    const geom::GridBox left = c.sheets[0].remnant;
    const geom::GridBox expected =
        open ? geom::GridBox{{0, 0}, {30 * mm, 40 * mm}} : geom::GridBox{{50 * mm, 0}, {500 * mm, 40 * mm}};
    EXPECT_TRUE(left.low == expected.low && left.high == expected.high)
        << left.low.x << " " << left.low.y << " " << left.high.x << " " << left.high.y;
  }
}

TEST(LayoutCompleteness, TheAreaOfDefectsCountsOnceAndOnlyInTheMaterial) {
  Document document = order();
  Stock& stock = document.stocks[0];
  stock.outline = outline_of({box_loop(0, 0, 200, 100), box_loop(150, 50, 160, 60)});
  stock.defects = {{"a", 1, outline_of({box_loop(20, 20, 40, 30)})},
                   {"b", 2, outline_of({box_loop(30, 20, 50, 30)})},     // 10 x 10 of both
                   {"c", 1, outline_of({box_loop(190, 90, 210, 110)})},  // a quarter of it in the sheet
                   {"d", 1, outline_of({box_loop(150, 50, 165, 60)})}};  // 5 x 10 beside the hole
  place(document, 0, 100, 0);
  const Completeness c = of(document);
  EXPECT_EQ(c.sheets[0].material_area, 19900);
  EXPECT_NEAR(c.sheets[0].defect_area, 300 + 100 + 50, 1e-6);
}

/// What a part, a defect, a hole and the border leave free.
TEST(LayoutCompleteness, TheRemnantIsFreeAndTouchesSomethingOnEverySide) {
  for (std::size_t i = 0; i < 40; ++i) {
    const Document document = cases::random_layout(5, i, 6);
    if (document.placements.empty()) continue;
    const Completeness c = of(document);
    for (const SheetUse& use : c.sheets) {
      if (use.remnant.low == use.remnant.high) continue;
      SCOPED_TRACE(i);
      const Stock& stock = document.stocks[use.sheet.stock];
      // As a part that needs nothing and keeps no gaps.
      const auto is_free = [&](geom::GridBox box) {
        Document with = document;
        with.rules = {};
        for (Part& part : with.parts) part.gap = part.border_gap = part.defect_gap = 0;
        Part part;
        part.id = "remnant";
        part.outline = outline_of({{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}});
        with.parts.push_back(part);
        Placement placement;
        placement.id = with.next_id++;
        placement.part = static_cast<std::uint32_t>(with.parts.size() - 1);
        placement.stock = use.sheet.stock;
        placement.copy = use.sheet.copy;
        const Workspace workspace(with);
        return workspace.is_clear(std::span(&placement, 1));
      };
      ASSERT_TRUE(is_free(use.remnant));
      // One step more on any side, and something is in the way.
      int closed = 0;
      for (int side = 0; side < 4; ++side) {
        geom::GridBox wider = use.remnant;
        (side == 0   ? wider.low.x
         : side == 1 ? wider.low.y
         : side == 2 ? wider.high.x
                     : wider.high.y) += side < 2 ? -1 : 1;
        // Of an open strip it ends where the length used ends.
        const bool at_end =
            side == 2 && stock.open_length && use.remnant.high.x >= geom::grid_from_mm(use.used_length_mm);
        closed += at_end || !is_free(wider) ? 1 : 0;
      }
      EXPECT_EQ(closed, 4);
    }
  }
}

}  // namespace
}  // namespace lekalo::layout::layout_completeness_test
