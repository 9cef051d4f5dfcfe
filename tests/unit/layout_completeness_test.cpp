#include "lekalo/layout/completeness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "lekalo/phi/outline_relation.hpp"
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

Completeness of(const Document& document) { return completeness(document); }

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

/// Cells asked one by one, by the relations of whole outlines.
double largest_rectangle_of_cells(const Document& document, const SheetUse& use) {
  const Stock& stock = document.stocks[use.sheet.stock];
  geom::GridBox within = geom::bounds(stock.outline.polygon);
  if (stock.open_length) within.high.x = geom::grid_from_mm(use.used_length_mm);
  std::vector<geom::GridRegion> taken;
  for (const Placement& p : document.placements)
    if (p.stock == use.sheet.stock && p.copy == use.sheet.copy)
      taken.push_back(placed_outline(document.parts[p.part], p));
  for (const Defect& defect : stock.defects) taken.push_back(defect.outline.polygon);
  const std::int64_t width = within.high.x - within.low.x, height = within.high.y - within.low.y;
  const std::int64_t cell = std::max(width, height) / 192 + 1;
  std::vector<std::int64_t> free_below(static_cast<std::size_t>(width / cell), 0);
  double most = 0;
  for (std::int64_t y = 0; y < height / cell; ++y) {
    for (std::int64_t x = 0; x < width / cell; ++x) {
      const geom::GridPoint low = within.low + geom::GridPoint{x * cell, y * cell};
      const geom::GridRegion square = geom::rectangle({low, low + geom::GridPoint{cell, cell}});
      std::int64_t& below = free_below[static_cast<std::size_t>(x)];
      const bool is_free = phi::lies_within(stock.outline.polygon, square) &&
                           std::none_of(taken.begin(), taken.end(), [&](const geom::GridRegion& one) {
                             return phi::interiors_meet(one, square);
                           });
      below = is_free ? below + 1 : 0;
    }
    for (std::size_t x = 0; x < free_below.size(); ++x) {
      std::int64_t least = free_below[x];
      for (std::size_t from = x + 1; from-- > 0 && least > 0;) {
        least = std::min(least, free_below[from]);
        const double area = static_cast<double>(least) * static_cast<double>(x + 1 - from);
        most = std::max(most, area * geom::mm_from_grid(cell) * geom::mm_from_grid(cell));
      }
    }
  }
  return most;
}

/// The raster is filled in edge by edge.
TEST(LayoutCompleteness, TheRemnantIsNoSmallerThanAnyRectangleOfFreeCells) {
  int known = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const Document document = cases::random_layout(9, i, 6);
    const Completeness c = of(document);
    for (const SheetUse& use : c.sheets) {
      SCOPED_TRACE(i);
      const geom::Point size = geom::mm_from_grid(use.remnant.high - use.remnant.low);
      const double cells = largest_rectangle_of_cells(document, use);
      EXPECT_GE(size.x * size.y, cells);
      known += cells > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(known, 5);
}

/// Four outlines of 4,000 corners each cost a look at each corner and each cell, and not one for both.
TEST(LayoutCompleteness, TheRemnantBesideLongOutlinesTakesStepsForTheirCornersAndForItsCells) {
  Document document = order();
  std::vector<geom::GridPoint> loop;
  for (int k = 0; k < 2000; ++k) loop.push_back({k * mm / 50, k % 2 * mm / 100});
  for (int k = 2000; k > 0; --k) loop.push_back({k * mm / 50, 40 * mm + k % 2 * mm / 100});
  document.parts[0].outline = outline_of({loop});
  for (const double x : {0.0, 50.0, 100.0, 150.0}) place(document, 0, x, 10);
  RunControl control;
  control.work_limit = 250'000;
  EXPECT_TRUE(stoppable(control, [&] { return of(document); }));
}

/// Sides that run along the lines between cells take none of them.
TEST(LayoutCompleteness, TheRemnantBesideSidesOnTheRasterReachesThem) {
  Document document = order();
  // A length of one step less than 192 cells of a whole number of steps.
  const std::int64_t cell = 1'000'003;
  Stock& stock = document.stocks[0];
  stock.outline.polygon = geom::rectangle({{0, 0}, {192 * cell - 1, 96 * cell}});
  document.parts[0].outline.polygon = geom::rectangle({{0, 0}, {64 * cell, 48 * cell}});
  place(document, 0, 0, 0);
  const Completeness c = of(document);
  EXPECT_EQ(c.sheets[0].remnant, (geom::GridBox{{64 * cell, 0}, {192 * cell - 1, 96 * cell}}));
}

}  // namespace
}  // namespace lekalo::layout::layout_completeness_test
