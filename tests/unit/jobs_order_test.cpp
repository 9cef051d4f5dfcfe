#include <gtest/gtest.h>

#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/jobs/nest.hpp"
#include "lekalo/jobs/order.hpp"

namespace lekalo::jobs::jobs_order_test {
namespace {

File drawing(const char* name, const char* shapes) {
  return {name, std::string("<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' "
                            "viewBox='0 0 100 100'>") +
                    shapes + "</svg>"};
}
const File kPlate = drawing("shop/plate.svg", "<rect width='80' height='40'/>");
const File kTwo = drawing("two.svg", "<path d='M0 0H9V9Z'/><path d='M20 0H29V8Z'/>");

Order order_of_plates() {
  Order order;
  order.parts.push_back({kPlate, 3, {}, {}, false, std::nullopt, 0});
  order.stocks.push_back({SheetSize{200, 100}, {}, std::nullopt});
  return order;
}

TEST(JobsOrder, PartsAreCalledAfterTheirFilesAndOutlinesAreCounted) {
  Order order = order_of_plates();
  order.parts.push_back({kTwo, 2, {}, {{0, 0}}, true, layout::Grain{90, 0}, 7});
  order.parts.push_back({kPlate, 1, "lid", {}, false, std::nullopt, 0});
  const auto made = open_order(order);
  ASSERT_TRUE(made) << made.error().message;
  const auto& parts = made->document.parts;
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[0].id, "plate");
  EXPECT_EQ(parts[0].demand, 3);
  EXPECT_TRUE(parts[0].rotations.empty());
  EXPECT_EQ(parts[1].id, "two");
  EXPECT_EQ(parts[2].id, "two-2");
  EXPECT_EQ(parts[2].demand, 2);
  EXPECT_TRUE(parts[2].may_mirror);
  EXPECT_EQ(parts[2].grain, (layout::Grain{90, 0}));
  EXPECT_EQ(parts[2].priority, 7);
  EXPECT_EQ(parts[3].id, "lid");
  EXPECT_TRUE(io::read_layout(layout_bytes(*made), "made"));
}

TEST(JobsOrder, TheInputsAreTheFilesAndTheirDigests) {
  const auto made = open_order(order_of_plates());
  ASSERT_TRUE(made);
  ASSERT_EQ(made->inputs.size(), 1u);
  EXPECT_EQ(made->inputs[0].role, "part");
  EXPECT_EQ(made->inputs[0].name, kPlate.name);
  EXPECT_EQ(made->inputs[0].sha256, io::sha256(kPlate.bytes));
}

TEST(JobsOrder, SheetsWithoutANumberAreAsManyAsThePieces) {
  const auto made = open_order(order_of_plates());
  ASSERT_TRUE(made);
  EXPECT_EQ(made->document.stocks.at(0).count, 3);
  EXPECT_EQ(made->document.stocks[0].id, "200x100");
}

TEST(JobsOrder, StripsAndDrawnSheetsAreStockToo) {
  Order order = order_of_plates();
  order.stocks = {{SheetSize{0, 500}, {}, std::nullopt}, {std::nullopt, kTwo, 4}};
  order.grain_degrees = 90;
  const auto made = open_order(order);
  ASSERT_TRUE(made) << made.error().message;
  const auto& stocks = made->document.stocks;
  ASSERT_EQ(stocks.size(), 3u);
  EXPECT_EQ(stocks[0].kind, layout::StockKind::strip);
  EXPECT_TRUE(stocks[0].open_length);
  EXPECT_EQ(stocks[1].id, "two");
  EXPECT_EQ(stocks[2].id, "two-2");
  EXPECT_EQ(stocks[2].count, 4);
  EXPECT_EQ(stocks[2].grain_degrees, 90.0);
}

TEST(JobsOrder, AGapBelowTheKerfIsRaisedToItAndTold) {
  Order order = order_of_plates();
  order.gap_mm = 0.1;
  order.kerf_mm = 0.25;
  order.border_mm = 10;
  const auto made = open_order(order);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->document.rules.gap, geom::grid_from_mm_up(0.25));
  EXPECT_EQ(made->document.rules.border_gap, geom::grid_from_mm_up(10));
  EXPECT_EQ(made->document.rules.kerf, geom::grid_from_mm_up(0.25)) << "it was forgotten";
  ASSERT_EQ(made->notices.size(), 1u);
  EXPECT_NE(made->notices[0].find("raised to 0.25 mm"), std::string::npos);
  order.gap_mm = 0.3;
  EXPECT_TRUE(open_order(order)->notices.empty());
}

TEST(JobsOrder, WhatIsMissingIsAWrongUse) {
  const auto made = open_order({});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::usage);
  EXPECT_NE(made.error().message.find("no part is ordered, and there is no sheet"), std::string::npos);
}

TEST(JobsOrder, EveryFileThatCannotBeReadIsTold) {
  Order order = order_of_plates();
  order.parts.push_back({{"a.dxf", "nonsense"}, 1, {}, {}, false, std::nullopt, 0});
  order.stocks.push_back({std::nullopt, {"hide.svg", "<svg"}, 1});
  const auto made = open_order(order);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::bad_input);
  EXPECT_NE(made.error().message.find("a.dxf"), std::string::npos);
  EXPECT_NE(made.error().message.find("hide.svg"), std::string::npos);
}

TEST(JobsOrder, ALayoutIsNoPart) {
  const auto layout = open_order(order_of_plates());
  Order order = order_of_plates();
  order.parts.push_back({{"old.json", layout_bytes(*layout)}, 1, {}, {}, false, std::nullopt, 0});
  const auto made = open_order(order);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("old.json: is a layout or a job already"), std::string::npos);
}

TEST(JobsOrder, ItsLayoutIsNestedAndChecked) {
  Order order = order_of_plates();
  order.gap_mm = 4;
  const auto made = open_order(order);
  RunControl control;
  control.work_limit = 1;
  const auto nested = nest(made->document, {}, control);
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_TRUE(nested->unplaced.empty());
  EXPECT_EQ(nested->document.placements.size(), 3u);
}

}  // namespace
}  // namespace lekalo::jobs::jobs_order_test
