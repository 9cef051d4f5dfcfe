// Remnants of random sheets: rectangles, hides, and remnants of remnants, with parts anywhere on them.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/layout/remnant_outline.hpp"
#include "lekalo/phi/outline_relation.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::layout::stock_remnants_test {
namespace {

using cases::box_loop;
using cases::grid_point;
using cases::outline_of;

constexpr std::int64_t mm = geom::kGridPerMm;

Document sheet_of_outline(std::vector<geom::GridPoint> loop) {
  Document document;
  Stock stock;
  stock.id = "sheet";
  stock.cost = 8;
  stock.outline = outline_of({std::move(loop)});
  document.stocks = {stock};
  return document;
}

void lay(Document& document, std::vector<geom::GridPoint> loop) {
  Part part;
  part.id = "part " + std::to_string(document.parts.size());
  part.outline = outline_of({std::move(loop)});
  Placement placement;
  placement.id = document.next_id++;
  placement.part = static_cast<std::uint32_t>(document.parts.size());
  document.parts.push_back(part);
  document.placements.push_back(placement);
}

std::vector<Remnant> left_of(const Document& document, const RemnantRule& rule) {
  return remnants_of(document, 0, 0, rule);
}

constexpr RemnantRule kSmall{50 * mm, 50 * mm, 0};

TEST(StockRemnants, BeyondAFullColumnOneStraightCutIsMade) {
  Document document = sheet_of_outline(box_loop(0, 0, 300, 100));
  document.rules.gap = 4 * mm;
  lay(document, box_loop(2, 2, 80, 98));
  const auto left = left_of(document, kSmall);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].outline, outline_of({box_loop(84, 0, 300, 100)}).polygon);
  EXPECT_EQ(left[0].rectangle, geom::bounds(left[0].outline));
}

TEST(StockRemnants, AWideArmStaysAndANarrowOneGoes) {
  for (const double high : {40.0, 60.0}) {
    Document document = sheet_of_outline(box_loop(0, 0, 300, 100));
    lay(document, box_loop(0, 0, 80, high));
    const auto left = left_of(document, kSmall);
    ASSERT_EQ(left.size(), 1u);
    // 60 mm are left above the lower part, which holds a remnant of its own, and 40 above the higher one.
    EXPECT_EQ(left[0].outline.points.size(), high == 40 ? 6u : 4u);
  }
}

TEST(StockRemnants, TheCutBeginsAtTheCornerWhereThePartsLie) {
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {220.0, 0.0}, {0.0, 60.0}, {220.0, 60.0}}) {
    Document document = sheet_of_outline(box_loop(0, 0, 300, 120));
    lay(document, box_loop(x, y, x + 80, y + 60));
    const auto left = left_of(document, kSmall);
    ASSERT_EQ(left.size(), 1u) << x << ' ' << y;
    EXPECT_EQ(geom::area_mm2(left[0].outline), 300 * 120 - 80 * 60) << x << ' ' << y;
  }
}

TEST(StockRemnants, NothingIsKeptThatIsSmallerThanTheRule) {
  Document document = sheet_of_outline(box_loop(0, 0, 300, 100));
  lay(document, box_loop(0, 0, 251, 100));
  EXPECT_TRUE(left_of(document, kSmall).empty());
  EXPECT_EQ(left_of(document, {49 * mm, 100 * mm, 0}).size(), 1u);
  EXPECT_EQ(left_of(document, {100 * mm, 49 * mm, 0}).size(), 1u);
  EXPECT_TRUE(left_of(document, {0, 0, 4901}).empty());
  EXPECT_EQ(left_of(document, {0, 0, 4900}).size(), 1u);
}

TEST(StockRemnants, TheKerfCountsWhereTheGapIsSmallerAndThePartsOwnGapWhereItIsLarger) {
  Document document = sheet_of_outline(box_loop(0, 0, 300, 100));
  lay(document, box_loop(0, 0, 80, 100));
  document.rules = {1 * mm, 0, 0, 3 * mm};
  EXPECT_EQ(geom::bounds(left_of(document, kSmall)[0].outline).low.x, 83 * mm);
  document.parts[0].gap = 10 * mm;
  EXPECT_EQ(geom::bounds(left_of(document, kSmall)[0].outline).low.x, 90 * mm);
}

TEST(StockRemnants, WhatIsWrongWithTheSheetGoesWithTheRemnantItLiesIn) {
  Document document = sheet_of_outline(box_loop(0, 0, 300, 100));
  Stock& sheet = document.stocks[0];
  sheet.material = {"steel", 2 * mm};
  sheet.grain_degrees = 90;
  sheet.defects = {{"near", 1, outline_of({box_loop(20, 20, 30, 30)})},
                   {"far", 2, outline_of({box_loop(200, 20, 210, 30)})}};
  sheet.zones = {{"edge", 3, outline_of({box_loop(90, 0, 110, 100)})}};
  lay(document, box_loop(0, 0, 100, 100));
  const auto left = left_of(document, kSmall);
  ASSERT_EQ(left.size(), 1u);
  const Stock remnant = stock_of(sheet, left[0]);
  EXPECT_EQ(remnant.material, sheet.material);
  EXPECT_EQ(remnant.grain_degrees, sheet.grain_degrees);
  EXPECT_DOUBLE_EQ(remnant.cost, 8 * 2. / 3);
  EXPECT_EQ(geom::bounds(remnant.outline.polygon), (geom::GridBox{{0, 0}, {200 * mm, 100 * mm}}));
  ASSERT_EQ(remnant.defects.size(), 1u);
  EXPECT_EQ(remnant.defects[0].id, "far");
  EXPECT_EQ(remnant.defects[0].outline.polygon, outline_of({box_loop(100, 20, 110, 30)}).polygon);
  ASSERT_EQ(remnant.zones.size(), 1u);
  EXPECT_EQ(remnant.zones[0].outline.polygon, outline_of({box_loop(-10, 0, 10, 100)}).polygon);
}

/// A sheet or a hide with some parts in it, which lie as chance has it and may lie over each other: the laws
/// below hold all the same.
Document random_cut(Random& random) {
  const bool hide = random.below(2) == 0;
  Document document = sheet_of_outline(hide ? cases::star(random, {500, 400}, 200, 400, 5 + random.below(30))
                                            : box_loop(0, 0, 1000, 800));
  document.rules.gap = geom::grid_from_mm_up(random.uniform(0, 8));
  document.rules.kerf = geom::grid_from_mm_up(random.uniform(0, 3));
  for (std::size_t i = 0, count = 1 + random.below(12); i < count; ++i) {
    const double x = random.uniform(50, 500);
    lay(document, cases::star(random, {x, random.uniform(50, 700)}, 10, 60, 3 + random.below(9)));
  }
  return document;
}

RemnantRule random_rule(Random& random) {
  if (random.below(3) == 0) return {0, 0, static_cast<std::int64_t>(500 + random.below(80'000))};
  const double width = random.uniform(20, 300);
  return {geom::grid_from_mm_up(width), geom::grid_from_mm_up(random.uniform(20, 300)), 0};
}

bool keeps_rule(const Remnant& remnant, const RemnantRule& rule) {
  if (rule.area_mm2 > 0) return geom::area_mm2(remnant.outline) >= static_cast<double>(rule.area_mm2);
  const geom::GridPoint size = remnant.rectangle.high - remnant.rectangle.low;
  return (size.x >= rule.width && size.y >= rule.height) || (size.x >= rule.height && size.y >= rule.width);
}

void expect_laws(const Document& document, const std::vector<Remnant>& left, const RemnantRule& rule,
                 const std::string& name) {
  const geom::GridRegion& sheet = document.stocks[0].outline.polygon;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const geom::GridRegion& outline = left[i].outline;
    EXPECT_TRUE(phi::lies_within(sheet, outline)) << name;
    EXPECT_TRUE(keeps_rule(left[i], rule)) << name;
    if (left[i].rectangle.low != left[i].rectangle.high) {
      EXPECT_TRUE(phi::lies_within(outline, geom::rectangle(left[i].rectangle))) << name;
    }
    for (const Placement& placement : document.placements) {
      const Part& part = document.parts[placement.part];
      const geom::GridRegion lying = placed_outline(part, placement);
      EXPECT_FALSE(phi::interiors_meet(outline, lying)) << name;
      EXPECT_FALSE(phi::edges_nearer_than(outline, lying, remnant_gap(document, part))) << name;
    }
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(phi::interiors_meet(outline, left[k].outline)) << name;
  }
}

TEST(StockRemnants, RandomOnesLieInTheirSheetClearOfPartsAndSoDoTheirs) {
  std::size_t kept = 0, of_remnants = 0;
  for (std::size_t index = 0; index < cases::case_count(150); ++index) {
    const std::string name = "seed " + std::to_string(cases::seed()) + " index " + std::to_string(index);
    Random random(cases::seed(), 500 + index);
    const Document document = random_cut(random);
    const RemnantRule rule = random_rule(random);
    const auto left = left_of(document, rule);
    expect_laws(document, left, rule, name);
    kept += left.size();
    if (left.empty()) continue;
    Document next = document;
    next.stocks[0] = stock_of(document.stocks[0], left[0]);
    next.parts.clear();
    next.placements.clear();
    const geom::Point size = geom::mm_from_grid(geom::bounds(next.stocks[0].outline.polygon).high);
    lay(next, box_loop(0, 0, size.x / 3, size.y / 3));
    const auto again = left_of(next, rule);
    expect_laws(next, again, rule, name + ", of a remnant");
    of_remnants += again.size();
  }
  EXPECT_GT(kept, 0u);
  EXPECT_GT(of_remnants, 0u);
}

}  // namespace
}  // namespace lekalo::layout::stock_remnants_test
