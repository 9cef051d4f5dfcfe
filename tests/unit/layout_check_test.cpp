// layout::check, kind by kind.

#include "lekalo/layout/check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace lekalo::layout::layout_check_test {
namespace {

using geom::GridPoint;
using geom::GridRegion;

constexpr std::int64_t mm = geom::kGridPerMm;

std::vector<GridPoint> box(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) {
  return {{x0 * mm, y0 * mm}, {x1 * mm, y0 * mm}, {x1 * mm, y1 * mm}, {x0 * mm, y1 * mm}};
}
Outline outline(std::vector<std::vector<GridPoint>> loops) {
  return {geom::make_grid_region(std::move(loops)).value(), {}, 0};
}

Part part(std::string id, Outline shape) {
  Part result;
  result.id = std::move(id);
  result.outline = std::move(shape);
  return result;
}

/// A sheet 100 x 80 with a hole (70, 50) to (90, 70); part 0 is 10 x 10, part 1 a frame 20 x 20 with a room
/// 10 x 10.
Document sheet() {
  Document document;
  Stock stock;
  stock.id = "sheet";
  stock.count = 2;
  stock.outline = outline({box(0, 0, 100, 80), box(70, 50, 90, 70)});
  document.stocks = {stock};
  document.parts = {part("square", outline({box(0, 0, 10, 10)})),
                    part("frame", outline({box(0, 0, 20, 20), box(5, 5, 15, 15)}))};
  return document;
}

Placement& place(Document& document, std::uint32_t which, std::int64_t x, std::int64_t y,
                 double degrees = 0) {
  Placement placement;
  placement.id = document.next_id++;
  placement.part = which;
  placement.rotation = geom::rotation_from_degrees(degrees);
  placement.at = {x, y};
  document.placements.push_back(placement);
  return document.placements.back();
}

std::vector<std::string> names(const std::vector<Violation>& violations) {
  std::vector<std::string> result;
  for (const Violation& v : violations)
    result.push_back(std::string(name_of(v.kind)) + " " + std::to_string(v.a) + " " + std::to_string(v.b));
  return result;
}
using Names = std::vector<std::string>;

TEST(LayoutCheck, TouchingIsAllowedAndOneStepMoreIsNot) {
  Document document = sheet();
  place(document, 0, 0, 0);
  place(document, 0, 10 * mm, 0);
  place(document, 0, 20 * mm, 10 * mm, 90);  // lies at (10, 10) to (20, 20)
  EXPECT_EQ(names(check(document)), Names{});
  document.placements[1].at.x -= 1;
  const auto violations = check(document);
  ASSERT_EQ(names(violations), Names{"overlap 1 2"});
  EXPECT_NEAR(violations[0].amount_mm, geom::kGridStep, 3 * geom::kGridStep);
  EXPECT_EQ(violations[0].direction, (geom::Point{-1, 0}));
  EXPECT_NEAR(violations[0].at.x, 10, 1e-5);
  // On another copy there is nothing to overlap.
  document.placements[1].copy = 1;
  EXPECT_EQ(names(check(document)), Names{});
}

TEST(LayoutCheck, GapsCountExactlyAlsoInsideHoles) {
  Document document = sheet();
  document.rules.gap = 2 * mm + mm / 2;
  place(document, 1, 10 * mm, 10 * mm);
  place(document, 0, 15 * mm, 15 * mm);  // fills the room of the frame
  auto violations = check(document);
  ASSERT_EQ(names(violations), Names{"gap 1 2"});
  EXPECT_EQ(violations[0].amount_mm, 2.5);
  document.placements[1].at.x = 30 * mm + 2 * mm + mm / 2;
  EXPECT_EQ(names(check(document)), Names{});
  document.placements[1].at.x -= 1;
  violations = check(document);
  ASSERT_EQ(names(violations), Names{"gap 1 2"});
  EXPECT_EQ(violations[0].amount_mm, geom::kGridStep);
  EXPECT_EQ(violations[0].direction, (geom::Point{-1, 0}));
  // The larger of both parts' gaps counts, and a part's own replaces the rule's.
  document.parts[1].gap = 0;
  EXPECT_EQ(names(check(document)), Names{"gap 1 2"});
  document.parts[0].gap = 0;
  EXPECT_EQ(names(check(document)), Names{});
}

TEST(LayoutCheck, BordersAndHolesOfTheStock) {
  Document document = sheet();
  place(document, 0, 90 * mm, 70 * mm);  // in the corner of the sheet, touching the hole's corner
  EXPECT_EQ(names(check(document)), Names{});
  document.placements[0].at = {91 * mm, 72 * mm};
  auto violations = check(document);
  ASSERT_EQ(names(violations), Names{"outside 1 0"});
  EXPECT_NEAR(violations[0].amount_mm, std::sqrt(5.0), 1e-4);
  EXPECT_NEAR(violations[0].direction.y, -2 / std::sqrt(5.0), 1e-4);
  document.placements[0].at = {69 * mm, 30 * mm};
  EXPECT_EQ(names(check(document)), Names{});
  document.placements[0].at = {75 * mm, 55 * mm};  // in the hole
  violations = check(document);
  ASSERT_EQ(names(violations), Names{"outside 1 0"});
  EXPECT_NEAR(violations[0].amount_mm, 15, 1e-4);
  document.rules.border_gap = 3 * mm;
  document.placements[0].at = {60 * mm, 67 * mm};
  EXPECT_EQ(names(check(document)), Names{"border-gap 1 0"});
  document.placements[0].at = {57 * mm, 67 * mm};
  EXPECT_EQ(names(check(document)), Names{});
  document.placements[0].at.y += 1;
  violations = check(document);
  ASSERT_EQ(names(violations), Names{"border-gap 1 0"});
  EXPECT_EQ(violations[0].amount_mm, geom::kGridStep);
  EXPECT_EQ(violations[0].direction, (geom::Point{0, -1}));
  document.parts[0].border_gap = 0;
  EXPECT_EQ(names(check(document)), Names{});
  // Larger than the sheet: no shift, but how far it sticks out.
  document.parts.push_back(part("long", outline({box(0, 0, 130, 5)})));
  place(document, 2, -10 * mm, 0);
  document.rules.border_gap = 0;
  violations = check(document);
  ASSERT_EQ(names(violations), Names{"outside 2 0"});
  EXPECT_EQ(violations[0].amount_mm, 20);
  EXPECT_EQ(violations[0].direction, geom::Point{});
}

TEST(LayoutCheck, DefectsBySeverity) {
  Document document = sheet();
  Defect scratch{"scratch", 1, outline({box(12, 2, 14, 8)})}, hole{"cut", 3, outline({box(20, 20, 25, 25)})};
  document.stocks[0].defects = {scratch, hole};
  place(document, 0, 8 * mm, 0);
  place(document, 0, 25 * mm, 18 * mm);
  auto violations = check(document);
  ASSERT_EQ(names(violations), Names{"defect 1 0"});
  EXPECT_NEAR(violations[0].amount_mm, 6, 1e-5);
  document.rules.defect_gap = mm;
  violations = check(document);
  ASSERT_EQ(names(violations), (Names{"defect 1 0", "defect-gap 2 0"}));
  EXPECT_EQ(violations[1].feature, 1U);
  EXPECT_EQ(violations[1].amount_mm, 1);
  document.parts[0].tolerated_severity = 1;
  EXPECT_EQ(names(check(document)), Names{"defect-gap 2 0"});
  document.parts[0].tolerated_severity = 3;
  EXPECT_EQ(names(check(document)), Names{});
}

TEST(LayoutCheck, QualityOfZonesAndAreas) {
  Document document = sheet();
  document.stocks[0].zones = {{"belly", 2, outline({box(0, 0, 30, 30)})},
                              {"neck", 1, outline({box(0, 0, 10, 30)})}};
  Part& frame = document.parts[1];
  place(document, 1, 20 * mm, 0);  // (20, 0) to (40, 20), half in the belly
  EXPECT_EQ(names(check(document)), Names{});
  frame.quality = 3;
  EXPECT_EQ(names(check(document)), Names{"quality 1 0"});
  document.placements[0].at.x = 30 * mm;
  EXPECT_EQ(names(check(document)), Names{});
  document.placements[0].at.x -= 1;
  EXPECT_EQ(names(check(document)), Names{"quality 1 0"});
  // An area that demands less takes the demand back where it covers all that lies in the zone.
  document.placements[0].at.x = 20 * mm;
  frame.areas = {{2, outline({box(0, 0, 10, 20)})}};
  EXPECT_EQ(names(check(document)), Names{});
  document.placements[0].at.x -= 1;
  EXPECT_EQ(names(check(document)), Names{"quality 1 0"});
  document.placements[0].at.x += 1;
  // Two areas side by side serve as one; a step between them does not.
  frame.areas = {{2, outline({box(0, 0, 10, 7)})}, {1, outline({box(0, 7, 10, 20)})}};
  EXPECT_EQ(names(check(document)), Names{});
  frame.areas[1].outline =
      outline({{{0, 7 * mm + 1}, {10 * mm, 7 * mm + 1}, {10 * mm, 20 * mm}, {0, 20 * mm}}});
  EXPECT_EQ(names(check(document)), Names{"quality 1 0"});
  // What the step leaves open lies in the room of the frame: no material, no demand.
  frame.areas = {{2, outline({box(0, 0, 10, 20), box(6, 7, 9, 8)})}};
  EXPECT_EQ(names(check(document)), Names{});
  // Of areas that overlap the highest demand counts.
  frame.areas = {{2, outline({box(0, 0, 20, 20)})}, {9, outline({box(1, 1, 3, 3)})}};
  EXPECT_EQ(names(check(document)), Names{"quality 1 0"});
  // An area's demand counts within the part only: in the room there is nothing to be bad.
  frame.areas = {{2, outline({box(0, 0, 20, 20)})}, {9, outline({box(6, 6, 14, 14)})}};
  EXPECT_EQ(names(check(document)), Names{});
  frame.quality = 0;
  frame.areas = {{9, outline({box(4, 6, 14, 14)})}};
  EXPECT_EQ(names(check(document)), Names{"quality 1 0"});
  // Turned, the area turns with the part.
  document.placements[0].rotation = geom::rotation_from_degrees(180);
  document.placements[0].at = {40 * mm, 20 * mm};
  EXPECT_EQ(names(check(document)), Names{});
  document.placements[0].rotation = geom::rotation_from_degrees(0);
  document.placements[0].at = {0, 0};
  EXPECT_EQ(names(check(document)), (Names{"quality 1 0", "quality 1 0"}));
}

TEST(LayoutCheck, RotationMirrorGrainAndStock) {
  Document document = sheet();
  document.parts[0].rotations = {{0, 0}, {80, 100}};
  place(document, 0, 20 * mm, 20 * mm, 100);
  EXPECT_EQ(names(check(document)), Names{});
  document.placements[0].rotation.s -= 1;
  EXPECT_EQ(names(check(document)), Names{"rotation 1 0"});
  document.placements[0].rotation = geom::rotation_from_degrees(0);
  document.placements[0].mirrored = true;
  EXPECT_EQ(names(check(document)), Names{"mirror 1 0"});
  document.parts[0].may_mirror = true;
  document.parts[0].grain = Grain{30, 5};
  document.stocks[0].grain_degrees = 150;
  EXPECT_EQ(names(check(document)), Names{});  // mirrored, 30 is 150
  document.placements[0].mirrored = false;
  EXPECT_EQ(names(check(document)), Names{"grain 1 0"});
  document.parts[0].rotations.clear();
  document.placements[0].rotation = geom::rotation_from_degrees(-55);  // 30 - 55 = -25, and 150 - 180 = -30
  EXPECT_EQ(names(check(document)), Names{});
  document.placements[0].rotation = geom::rotation_from_degrees(-54.9999999);
  EXPECT_EQ(names(check(document)), Names{"grain 1 0"});
  document.parts[0].grain.reset();
  document.placements[0].copy = 2;
  EXPECT_EQ(names(check(document)), Names{"stock 1 0"});
  document.placements[0].copy = -1;
  EXPECT_EQ(names(check(document)), Names{"stock 1 0"});
}

TEST(LayoutCheck, OrderIsByStockCopyAndIds) {
  Document document = sheet();
  document.stocks.push_back(document.stocks[0]);
  place(document, 0, 0, 0).stock = 1;
  place(document, 0, 5 * mm, 0).stock = 1;
  place(document, 0, 0, 0).copy = 1;
  place(document, 0, 5 * mm, 0).copy = 1;
  place(document, 0, 0, 0);
  place(document, 0, 5 * mm, 5 * mm);
  place(document, 0, -5 * mm, 0);
  EXPECT_EQ(names(check(document)),
            (Names{"overlap 5 6", "overlap 5 7", "outside 7 0", "overlap 3 4", "overlap 1 2"}));
  EXPECT_EQ(names(check(Document{})), Names{});
}

}  // namespace
}  // namespace lekalo::layout::layout_check_test
