#include <gtest/gtest.h>

#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/jobs/material.hpp"
#include "lekalo/jobs/nest.hpp"
#include "lekalo/jobs/order.hpp"
#include "lekalo/jobs/order_words.hpp"

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

layout::Material of(const char* name, double mm) { return {name, mm > 0 ? geom::grid_from_mm(mm) : 0}; }

/// Plates of three materials, of which one is there in two thicknesses, and a sheet of each.
Order order_of_materials() {
  Order order;
  for (const layout::Material& material : {of("steel", 2), of("birch", 9), of("steel", 3), of("steel", 2)}) {
    order.parts.push_back({kPlate, 2, {}, {}, false, std::nullopt, 0, material});
    order.stocks.push_back({SheetSize{200, 100}, {}, std::nullopt, material});
  }
  order.stocks.pop_back();
  order.parts[2].purpose = {"Orlova", "2026-12-01", "order 7"};
  return order;
}

TEST(JobsOrder, EachMaterialAndThicknessIsALayout) {
  const auto made = open_orders(order_of_materials());
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->size(), 3u);
  const char* const words[] = {"steel-2", "birch-9", "steel-3"};
  const char* const names[] = {"steel, 2 mm", "birch, 9 mm", "steel, 3 mm"};
  for (std::size_t i = 0; i < 3; ++i) {
    const MaterialLayout& one = (*made)[i];
    const layout::Document& document = one.layout.document;
    EXPECT_EQ(one.file_word, words[i]);
    EXPECT_EQ(document.name, names[i]);
    EXPECT_EQ(document.parts.size(), i == 0 ? 2u : 1u);
    EXPECT_EQ(one.layout.inputs.size(), document.parts.size());
    ASSERT_EQ(document.stocks.size(), 1u);
    EXPECT_EQ(document.stocks[0].material, one.material);
    EXPECT_EQ(document.stocks[0].count, i == 0 ? 4 : 2) << "one for every piece of its own";
    for (const layout::Part& part : document.parts) EXPECT_EQ(part.material, one.material);
    EXPECT_TRUE(one.layout.notices.empty());
    const auto back = io::read_layout(layout_bytes(one.layout), "made");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->document, document);
  }
  EXPECT_EQ((*made)[0].layout.document.parts[1].id, "plate-2");
  EXPECT_EQ((*made)[2].layout.document.parts[0].id, "plate") << "names are those of one layout";
  EXPECT_EQ((*made)[2].layout.document.parts[0].purpose,
            (layout::Purpose{"Orlova", "2026-12-01", "order 7"}));
}

TEST(JobsOrder, WhatIsSaidOfOneMaterialCountsForAll) {
  Order order = order_of_plates();
  const std::string plain = layout_bytes(open_orders(order)->front().layout);
  order.parts[0].material = of("steel", 0);
  order.parts.push_back({kTwo, 1, {}, {}, false, std::nullopt, 0});
  order.stocks[0].material = of("", 2);
  const auto made = open_orders(order);
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->size(), 1u);
  EXPECT_EQ(made->front().material, of("steel", 2));
  EXPECT_EQ(made->front().file_word, "");
  EXPECT_EQ(made->front().layout.document.name, "");
  for (const layout::Part& part : made->front().layout.document.parts)
    EXPECT_EQ(part.material, of("steel", 2));
  EXPECT_EQ(made->front().layout.document.stocks[0].material, of("steel", 2));
  EXPECT_EQ(plain.find("material"), std::string::npos);
}

TEST(JobsOrder, AThicknessOfOneMaterialIsNotThatOfAnother) {
  Order order = order_of_plates();
  order.parts[0].material = of("steel", 0);
  order.parts.push_back({kTwo, 1, {}, {}, false, std::nullopt, 0, of("birch", 9)});
  order.stocks[0].material = of("steel", 0);
  order.stocks.push_back({SheetSize{200, 100}, {}, std::nullopt, of("birch", 0)});
  const auto made = open_orders(order);
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->size(), 2u);
  EXPECT_EQ(made->front().material, of("steel", 0));
  EXPECT_EQ(made->back().material, of("birch", 9));
  EXPECT_EQ(made->back().layout.document.stocks[0].material, of("birch", 9));
}

TEST(JobsOrder, PartsWithoutAStockOfTheirMaterialAreToldWithTheirRow) {
  Order order = order_of_materials();
  order.parts[2].said_in = "o.csv: line 4";
  order.stocks[2].material = of("steel", 2.5);
  const auto made = open_orders(order);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::bad_input);
  EXPECT_EQ(made.error().message,
            "o.csv: line 4: there is no sheet of steel, 3 mm; say it behind a sheet, as in 3000x1500@steel:3 "
            "(there are sheets of: steel, 2 mm; birch, 9 mm; steel, 2.5 mm)");
  order = order_of_materials();
  order.parts[1].material = {};
  const auto unsaid = open_orders(order);
  ASSERT_FALSE(unsaid);
  EXPECT_NE(
      unsaid.error().message.find("shop/plate.svg: there is no sheet of no material; say what it is of"),
      std::string::npos)
      << unsaid.error().message;
}

TEST(JobsOrder, StockThatNoPartIsCutFromIsTold) {
  Order order = order_of_materials();
  order.stocks.push_back({SheetSize{50, 50}, {}, std::nullopt, of("brass", 0.8)});
  order.stocks.push_back({SheetSize{50, 50}, {}, std::nullopt});
  const auto made = open_orders(order);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->front().layout.notices,
            (std::vector<std::string>{"nothing is cut from the sheet of brass, 0.8 mm",
                                      "nothing is cut from the sheet that says no material"}));
}

TEST(JobsOrder, TheLongestNameOfAMaterialGivesALayoutThatIsRead) {
  Order order = order_of_materials();
  order.parts.pop_back();
  order.parts[0].material.name = order.stocks[0].material.name = std::string(1000, 'm');
  const auto made = open_orders(order);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_TRUE(io::read_layout(layout_bytes(made->front().layout), "made"));
}

TEST(JobsOrder, SeveralMaterialsAreNotOneLayout) {
  const auto made = open_order(order_of_materials());
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("the order is of 3 materials"), std::string::npos)
      << made.error().message;
}

TEST(JobsOrder, MorePiecesThanAPartMayBeWantedAreTold) {
  Order order = order_of_plates();
  order.parts[0].file = drawing("pair.svg", "<path d='M0 0H9V9Z'/><path d='M20 0H29V9Z'/>");
  order.parts[0].quantity = 1'000'000'000;
  order.parts[0].said_in = "o.csv: line 2";
  const auto made = open_order(order);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("o.csv: line 2: pair.svg has an outline 2 times"), std::string::npos)
      << made.error().message;
  order.parts[0].quantity = 500'000'000;
  const auto most = open_order(order);
  ASSERT_TRUE(most) << most.error().message;
  EXPECT_EQ(most->document.parts.at(0).demand, 1'000'000'000);
}

TEST(JobsOrder, WordsForFilesAreSafeAndEachItsOwn) {
  EXPECT_EQ(
      file_words({of("St 37/2", 2),
                  of("st 37-2", 2),
                  of("..", 0),
                  of("\xD0\xB4\xD1\x83\xD0\xB1", 19),
                  of("/", 0),
                  of("", 0.8),
                  {},
                  of("St-37", 2.2),
                  of(std::string(300, 'a').c_str(), 1)}),
      (std::vector<std::string>{"St-37-2-2", "st-37-2-2-2", "..", "\xD0\xB4\xD1\x83\xD0\xB1-19", "material",
                                "0.8", "no-material", "St-37-2.2", std::string(80, 'a') + "-1"}));
  EXPECT_EQ(path_with("a.b/out.json", "steel-2"), "a.b/out-steel-2.json");
  EXPECT_EQ(path_with("a.b/out", "steel-2"), "a.b/out-steel-2");
  EXPECT_EQ(path_with(".out", "steel-2"), ".out-steel-2");
  EXPECT_EQ(path_with("out.json", ""), "out.json");
  EXPECT_EQ(path_with("", "steel-2"), "");
}

TEST(JobsOrder, AWordHasItsNumberAndItsMaterialInEitherOrder) {
  for (const char* word : {"3000x1500=5@steel:2", "3000x1500@steel:2=5"}) {
    const auto read = ordered_word(word);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->word, "3000x1500");
    EXPECT_EQ(read->count, 5);
    EXPECT_EQ(read->material, of("steel", 2));
  }
  struct Case {
    const char *word, *left;
    layout::Material material;
  };
  for (const Case& one : {Case{"side.dxf@EN 10025:S235:1/16in", "side.dxf", of("EN 10025:S235", 1.5875)},
                          {"hide.dxf@leather", "hide.dxf", of("leather", 0)},
                          {"1500@:3mm", "1500", of("", 3)},
                          {"a@b.dxf", "a@b.dxf", {}},
                          {"a@b.JSON", "a@b.JSON", {}},
                          {"a@b.dxf@felt", "a@b.dxf", of("felt", 0)},
                          {"parts@home/*@", "parts@home/*", {}}}) {
    const auto read = ordered_word(one.word);
    ASSERT_TRUE(read) << one.word << read.error().message;
    EXPECT_EQ(read->word, one.left);
    EXPECT_EQ(read->material, one.material) << one.word;
    EXPECT_FALSE(read->count);
  }
  for (const char* wrong : {"3000x1500@steel:", "3000x1500@steel:thick", "3000x1500@steel:0",
                            "3000x1500=0@steel", "3000x1500@steel:2=0"})
    EXPECT_FALSE(ordered_word(wrong)) << wrong;
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
