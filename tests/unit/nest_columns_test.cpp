#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "lekalo/geom/grid.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/layout/job.hpp"
#include "lekalo/layout/workspace.hpp"
#include "lekalo/nest/nest.hpp"

// A run that is stopped before it has anything places what it can by boxes.

namespace lekalo::nest::nest_columns_test {
namespace {

using layout::Document;

layout::Part triangle(double width, double height, std::int64_t demand) {
  layout::Part part;
  part.id = "triangle";
  part.outline.polygon =
      *geom::make_grid_region({{{0, 0}, {geom::grid_from_mm(width), 0}, {0, geom::grid_from_mm(height)}}});
  part.demand = demand;
  return part;
}

/// Thirty triangles of 30 x 20 on sheets of 100 x 100 with gaps: three columns of four on each.
Document thirty_triangles() {
  Document document;
  document.parts.push_back(triangle(30, 20, 30));
  document.stocks.push_back(layout::sheet_of(geom::grid_from_mm(100), geom::grid_from_mm(100), 5));
  document.rules = {geom::grid_from_mm(2), geom::grid_from_mm(1), 0};
  return document;
}

Result<Nested> stopped_at_once(const Document& document) {
  const std::atomic<bool> stop{true};
  RunControl control;
  control.stop = &stop;
  return nest(document, {}, control);
}

std::int64_t on_copy(const Document& document, std::int64_t copy) {
  return std::count_if(document.placements.begin(), document.placements.end(),
                       [&](const layout::Placement& p) { return p.copy == copy; });
}

TEST(NestColumns, ARunThatIsStoppedAtOncePlacesAllByTheirBoxes) {
  const auto nested = stopped_at_once(thirty_triangles());
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_TRUE(nested->unplaced.empty());
  EXPECT_EQ(nested->document.placements.size(), 30u);
  EXPECT_TRUE(layout::check(nested->document).empty());
  for (const std::int64_t copy : {0, 1}) EXPECT_EQ(on_copy(nested->document, copy), 12);
  EXPECT_EQ(on_copy(nested->document, 2), 6);
}

TEST(NestColumns, SheetsOnWhichTheSameLiesAreEachCounted) {
  const auto nested = stopped_at_once(thirty_triangles());
  ASSERT_TRUE(nested);
  const auto sheets = layout::completeness(nested->document).sheets;
  ASSERT_EQ(sheets.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(sheets[k].sheet, (layout::Sheet{0, std::int64_t(k)}));
  EXPECT_EQ(sheets[0].remnant, sheets[1].remnant);
  EXPECT_EQ(sheets[0].parts, 12u);
  EXPECT_EQ(sheets[2].parts, 6u);
  EXPECT_NE(sheets[0].remnant, sheets[2].remnant);
}

TEST(NestColumns, WhatIsLockedStaysAndWhatFindsNoRoomIsToldAsNotTried) {
  Document document = thirty_triangles();
  document.stocks[0].count = 2;
  document.parts[0].demand = 31;  // with the locked one
  document.placements.push_back(
      {7, 0, 0, 0, {}, false, {geom::grid_from_mm(10), geom::grid_from_mm(10)}, true});
  document.next_id = 8;
  const auto nested = stopped_at_once(document);
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_TRUE(layout::check(nested->document).empty());
  EXPECT_EQ(nested->document.placements.front(), document.placements.front());
  // Beside the locked one there is room for one column more.
  EXPECT_EQ(on_copy(nested->document, 0), 1 + 4);
  EXPECT_EQ(on_copy(nested->document, 1), 12);
  ASSERT_EQ(nested->unplaced.size(), 1u);
  EXPECT_EQ(nested->unplaced[0], (Unplaced{0, 30 - 16, Reason::not_tried}));
}

TEST(NestColumns, ManyPiecesThatNoSheetHoldsKeepNoneFromItsPlace) {
  Document document = thirty_triangles();
  document.parts.insert(document.parts.begin(), triangle(300, 20, 2000));
  document.parts.insert(document.parts.begin(), triangle(20, 300, 2000));
  document.parts[0].id = "tall", document.parts[1].id = "wide";
  document.parts[1].rotations = {{0, 0}};
  document.parts[0].rotations = {{0, 0}};
  const auto nested = stopped_at_once(document);
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_EQ(nested->document.placements.size(), 30u);
  EXPECT_EQ(on_copy(nested->document, 0), 12);
  EXPECT_EQ(nested->unplaced.size(), 2u);
}

TEST(NestColumns, AnglesGrainAndDefectsHold) {
  Document document = thirty_triangles();
  document.parts[0].rotations = {{90, 90}};
  document.stocks[0].defects.push_back({"knot", 1, {}});
  document.stocks[0].defects[0].outline.polygon = geom::rectangle(
      {{geom::grid_from_mm(5), geom::grid_from_mm(5)}, {geom::grid_from_mm(8), geom::grid_from_mm(8)}});
  const auto nested = stopped_at_once(document);
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_TRUE(layout::check(nested->document).empty());
  EXPECT_GT(nested->document.placements.size(), 20u);
  for (const layout::Placement& p : nested->document.placements)
    EXPECT_EQ(p.rotation, geom::rotation_from_degrees(90));
}

TEST(NestColumns, OrdersOfKitsAndStockThatIsNoRectangleAreLeft) {
  Document document = thirty_triangles();
  document.stocks[0].outline.polygon = triangle(100, 100, 0).outline.polygon;
  const auto nested = stopped_at_once(document);
  ASSERT_TRUE(nested);
  EXPECT_TRUE(nested->document.placements.empty());
  document = thirty_triangles();
  document.kits.push_back({"pair", "", 1, 1, {{0, 2, {}}}});
  EXPECT_TRUE(stopped_at_once(document)->document.placements.empty());
}

}  // namespace
}  // namespace lekalo::nest::nest_columns_test
