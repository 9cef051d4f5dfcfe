// Stock books as the checker judges them: each finding with a book that shows it, and one next to it.

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/jobs/stock.hpp"
#include "lekalo/layout/job.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/json_paths.hpp"
#include "support/layout_cases.hpp"
#include "support/marked_layouts.hpp"
#include "verify/claims/same_layout.hpp"

namespace lekalo::verify::verify_stock_test {
namespace {

using cases::box_loop;
using cases::Json;
using cases::outline_of;
using jobs::StockBook;
using jobs::StockItem;
using jobs::StockOrder;
using jobs::StockOrderState;
using jobs::StockState;

constexpr std::int64_t mm = geom::kGridPerMm;

layout::Stock sheet(double width, double height, const layout::Material& material, double cost) {
  layout::Stock stock = layout::sheet_of(geom::grid_from_mm(width), geom::grid_from_mm(height), 1);
  stock.id = "piece", stock.material = material, stock.cost = cost;
  return stock;
}

/// A layout with a square of so many mm in the corner of its last stock.
layout::Document square_on(std::vector<layout::Stock> stocks, double side, std::int64_t gap,
                           std::int64_t kerf) {
  layout::Document document;
  document.stocks = std::move(stocks);
  document.rules.gap = gap, document.rules.kerf = kerf;
  layout::Part part;
  part.id = "square", part.outline = outline_of({box_loop(0, 0, side, side)});
  document.parts = {part};
  layout::Placement placement;
  placement.id = document.next_id++;
  placement.stock = static_cast<std::uint32_t>(document.stocks.size() - 1);
  document.placements = {placement};
  return document;
}

StockOrder order_of(const std::string& id, StockOrderState state, const layout::RemnantRule& rule,
                    const layout::Document& document, std::int64_t item) {
  return {id, state, rule, {io::write_layout(document)}, {{0, document.stocks.back().id, 0, item}}};
}

void add_item(StockBook& book, layout::Stock stock, StockState state, const std::string& order) {
  StockItem item;
  item.id = static_cast<std::int64_t>(book.items.size()) + 1;
  item.state = state, item.order = order, item.stock = std::move(stock);
  item.stock.id = jobs::name_of(item);
  book.items.push_back(std::move(item));
}

void add_remnant(StockBook& book, std::int64_t from, geom::GridPoint at, geom::GridBox rectangle,
                 layout::Stock stock) {
  add_item(book, std::move(stock), StockState::free, "");
  StockItem& item = book.items.back();
  item.from = from, item.at = at, item.rectangle = rectangle;
  item.stock.id = jobs::name_of(item);
}

geom::GridBox box(double x0, double y0, double x1, double y1) {
  return {cases::grid_point(x0, y0), cases::grid_point(x1, y1)};
}

const layout::Material kSteel{"steel", 2 * mm}, kBirch{"birch", 0}, kThickBirch{"birch", 3 * mm};

/// Sheets S1 to S5 and S10; R6 and R7 side by side on S1, R8 by area on S3, R9 on R6.
StockBook honest_book() {
  StockBook book;
  book.rule = {100 * mm, 100 * mm, 0};
  layout::Stock first = sheet(300, 100, kSteel, 0.03);
  first.defects = {{"d1", 2, outline_of({box_loop(200, 20, 210, 30)})},
                   {"d2", 1, outline_of({box_loop(150, 40, 155, 45)})}};
  first.zones = {{"z1", 1, outline_of({box_loop(70, 10, 90, 30)})}};
  first.grain_degrees = 0;
  const layout::Stock steel = sheet(300, 100, kSteel, 0.03), other = [] {
    layout::Stock stock = sheet(50, 50, kSteel, 1);
    stock.id = "other";
    return stock;
  }();
  add_item(book, first, StockState::cut, "A1");
  add_item(book, steel, StockState::allocated, "A2");
  add_item(book, sheet(200, 100, kBirch, 0), StockState::cut, "B1");
  add_item(book, sheet(300, 100, {}, 0.03), StockState::cut, "C1");
  add_item(book, sheet(200, 100, kThickBirch, 0.02), StockState::free, "");
  layout::Stock sixth = sheet(118, 100, kSteel, 0.03 * 118 / 300), seventh = sheet(120, 100, kSteel, 0.012);
  sixth.grain_degrees = seventh.grain_degrees = 0;
  sixth.defects = {{"d2", 1, outline_of({box_loop(88, 40, 93, 45)})}};
  sixth.zones = {{"z1", 1, outline_of({box_loop(8, 10, 28, 30)})}};
  seventh.defects = {{"d1", 2, outline_of({box_loop(20, 20, 30, 30)})}};
  add_remnant(book, 1, {62 * mm, 0}, box(18, 0, 118, 100), sixth);
  add_remnant(book, 1, {180 * mm, 0}, box(0, 0, 120, 100), seventh);
  layout::Stock eighth = sheet(200, 100, kBirch, 0);
  eighth.outline =
      outline_of({{cases::grid_point(60, 0), cases::grid_point(200, 0), cases::grid_point(200, 100),
                   cases::grid_point(0, 100), cases::grid_point(0, 60), cases::grid_point(60, 60)}});
  add_remnant(book, 3, {0, 0}, box(0, 0, 0, 0), eighth);
  layout::Stock ninth = sheet(55, 100, kSteel, 0.0055);
  ninth.grain_degrees = 0;
  ninth.defects = {{"d2", 1, outline_of({box_loop(25, 40, 30, 45)})}};
  add_remnant(book, 6, {63 * mm, 0}, box(0, 0, 55, 100), ninth);
  add_item(book, sheet(1, 1, {"foil", 0}, 1), StockState::free, "");
  for (const std::size_t cut : {5, 8}) book.items[cut].state = StockState::cut;
  book.items[5].order = "D1", book.items[8].order = "E1";

  const layout::RemnantRule sides{100 * mm, 100 * mm, 0};
  book.orders = {order_of("A1", StockOrderState::cut, sides, square_on({first}, 60, 2 * mm, mm), 1),
                 order_of("A2", StockOrderState::allocated, {}, square_on({other, steel}, 60, 0, 0), 2),
                 order_of("B1", StockOrderState::cut, {0, 0, 16400},
                          square_on({sheet(200, 100, kThickBirch, 1)}, 60, 0, 0), 3),
                 order_of("C1", StockOrderState::cut, sides, square_on({steel}, 60, 0, 0), 4),
                 order_of("D1", StockOrderState::cut, {100 * mm, 55 * mm, 0},
                          square_on({book.items[5].stock}, 60, 0, 3 * mm), 6),
                 order_of("E1", StockOrderState::cut, sides, square_on({book.items[8].stock}, 20, 0, 0), 9),
                 {"X1", StockOrderState::cancelled, {}, {}, {}}};
  return book;
}

std::string judged(const std::string& bytes) {
  const auto report = verify_stock({"stock.json", bytes});
  if (!report) return report.error().message;
  std::string text;
  for (const std::string& finding : report->findings) text += finding + "\n";
  return text;
}
std::string judged(const StockBook& book) { return judged(jobs::stock_book_json(book)); }

TEST(VerifyStock, AnHonestBookIsTrue) {
  EXPECT_EQ(judged(honest_book()), "");
  EXPECT_EQ(judged(StockBook{{mm, mm, 0}, {}, {}}), "");
}

/// A change, and a part of what is said of it; nothing is said of a change that stays honest.
struct Changed {
  const char* what;
  std::function<void(StockBook&)> change;
  const char* said;
};

void expect_said(const char* what, const std::string& all, const std::string& said) {
  if (said.empty())
    EXPECT_EQ(all, "") << what;
  else
    EXPECT_NE(all.find(said), std::string::npos) << what << ": " << all;
}

layout::Outline box_outline(double x0, double y0, double x1, double y1) {
  return outline_of({box_loop(x0, y0, x1, y1)});
}
layout::Outline wide_outline(std::int64_t width) {
  layout::Outline outline;
  outline.polygon = geom::make_grid_region({{{0, 0}, {width, 0}, {width, 100 * mm}, {0, 100 * mm}}}).value();
  return outline;
}
/// R6 one step wider to the left, where the part's gap is, or to the right, where R7 is.
void widen(StockItem& item, std::int64_t to_left) {
  item.at.x -= to_left;
  item.stock.outline = wide_outline(118 * mm + 1);
}

TEST(VerifyStock, ARemnantIsWhatItsSheetLeft) {
  const char *const rule = ": it is smaller than remnant_min",
                    *const no_rectangle = "rectangle is no rectangle",
                    *const features = "its defects and zones are not those",
                    *const material = "of another material", *const near = "R6: it is nearer than the gap",
                    *const not_cut = "which was not cut";
  for (const Changed& c : std::vector<Changed>{
           {"to the left", [](StockBook& b) { widen(b.items[5], 1); }, near},
           {"to the right", [](StockBook& b) { widen(b.items[5], 0); }, "R6 and R7 overlap"},
           {"beyond", [](StockBook& b) { ++b.items[6].at.x; }, "R7: it reaches beyond S1"},
           {"kerf", [](StockBook& b) { --b.items[8].at.x; }, "R9: it is nearer than the gap"},
           {"over the part",
            [](StockBook& b) {
              b.items[5].at.x = 0;
              b.items[5].stock.outline = box_outline(0, 0, 118, 100);
            },
            near},
           {"in the part",
            [](StockBook& b) {
              b.items[5].at.x = 0;
              b.items[5].stock.outline = box_outline(20, 20, 30, 30);
            },
            near},
           {"of itself", [](StockBook& b) { b.items[5].from = 6; },
            "R6: it is a remnant of R6, which was not cut"},
           {"of a later one", [](StockBook& b) { b.items[5].from = 9; }, not_cut},
           {"of a free one", [](StockBook& b) { b.items[5].from = 5; }, not_cut},
           {"of an allocated one", [](StockBook& b) { b.items[5].from = 2; }, not_cut},
           {"lying",
            [](StockBook& b) {
              b.orders[0].rule = {100 * mm, 90 * mm, 0};
            },
            ""},
           {"standing",
            [](StockBook& b) {
              b.orders[0].rule = {90 * mm, 100 * mm, 0};
            },
            ""},
           {"taller",
            [](StockBook& b) {
              b.orders[0].rule = {90 * mm, 100 * mm + 1, 0};
            },
            rule},
           {"both too long",
            [](StockBook& b) {
              b.orders[0].rule = {100 * mm, 100 * mm + 1, 0};
            },
            rule},
           {"wider",
            [](StockBook& b) {
              b.orders[0].rule = {100 * mm + 1, 90 * mm, 0};
            },
            rule},
           {"exactly as it stands",
            [](StockBook& b) {
              b.orders[4].rule = {55 * mm, 100 * mm, 0};
            },
            ""},
           {"standing one step short",
            [](StockBook& b) {
              b.orders[4].rule = {100 * mm, 55 * mm + 1, 0};
            },
            rule},
           {"lying one step short",
            [](StockBook& b) {
              b.orders[4].rule = {55 * mm, 100 * mm + 1, 0};
            },
            rule},
           {"one step too high",
            [](StockBook& b) {
              b.orders[4].rule = {100 * mm + 1, 55 * mm, 0};
            },
            rule},
           {"one step too wide",
            [](StockBook& b) {
              b.orders[4].rule = {55 * mm + 1, 100 * mm, 0};
            },
            rule},
           {"smaller area", [](StockBook& b) { b.orders[2].rule.area_mm2 = 16399; }, ""},
           {"larger area", [](StockBook& b) { b.orders[2].rule.area_mm2 = 16401; }, rule},
           {"area of one",
            [](StockBook& b) {
              b.orders[0].rule = {0, 0, 1};
            },
            ""},
           {"flat, by sides", [](StockBook& b) { b.items[5].rectangle = box(18, 0, 18, 100); }, no_rectangle},
           {"low, by sides", [](StockBook& b) { b.items[5].rectangle = box(18, 5, 118, 5); }, no_rectangle},
           {"a point, by sides", [](StockBook& b) { b.items[5].rectangle = box(18, 5, 18, 5); },
            no_rectangle},
           {"flat, by area", [](StockBook& b) { b.items[7].rectangle = box(70, 0, 70, 50); }, no_rectangle},
           {"low, by area", [](StockBook& b) { b.items[7].rectangle = box(70, 5, 90, 5); }, no_rectangle},
           {"turned over", [](StockBook& b) { b.items[7].rectangle = box(90, 5, 70, 15); }, no_rectangle},
           {"upside down", [](StockBook& b) { b.items[7].rectangle = box(70, 15, 90, 5); }, no_rectangle},
           {"one in it, by area", [](StockBook& b) { b.items[7].rectangle = box(60, 0, 200, 100); }, ""},
           {"one beyond it", [](StockBook& b) { b.items[7].rectangle = box(59, 0, 200, 100); },
            "R8: rectangle does not lie in it"},
           {"material", [](StockBook& b) { b.items[6].stock.material.name = "iron"; }, material},
           {"kind", [](StockBook& b) { b.items[6].stock.kind = layout::StockKind::hide; }, material},
           {"grain", [](StockBook& b) { b.items[6].stock.grain_degrees = 1; }, material},
           {"no defect", [](StockBook& b) { b.items[6].stock.defects.clear(); }, features},
           {"no zone", [](StockBook& b) { b.items[5].stock.zones.clear(); }, features},
           {"severity", [](StockBook& b) { b.items[6].stock.defects[0].severity = 1; }, features},
           {"name of a defect", [](StockBook& b) { b.items[6].stock.defects[0].id = "d"; }, features},
           {"place of a defect",
            [](StockBook& b) { b.items[6].stock.defects[0].outline = box_outline(20, 21, 30, 31); },
            features},
           {"cost", [](StockBook& b) { b.items[6].stock.cost *= 1 + 1e-11; }, "R7: cost is "},
           {"cost of nothing", [](StockBook& b) { b.items[7].stock.cost = 1e-9; }, "R8: cost is "},
           {"rounded cost", [](StockBook& b) { b.items[6].stock.cost *= 1 + 1e-13; }, ""}}) {
    StockBook book = honest_book();
    c.change(book);
    expect_said(c.what, judged(book), c.said);
  }
}

void change_layout(StockOrder& order, const std::function<void(Json&)>& change) {
  Json layout = Json::parse(order.layouts[0]);
  change(layout);
  order.layouts[0] = layout.dump();
}

TEST(VerifyStock, AnOrderUsesTheItemsThatItSays) {
  const char *const no_stock = "is not the stock", *const thick = "order B1: S3 is not the stock piece";
  for (const Changed& c : std::vector<Changed>{
           {"another place",
            [](StockBook& b) { b.items[0].stock.defects[0].outline = box_outline(200, 21, 210, 31); },
            no_stock},
           {"another defect", [](StockBook& b) { b.items[0].stock.defects[0].id = "d"; }, no_stock},
           {"another severity", [](StockBook& b) { b.items[0].stock.defects[0].severity = 1; }, no_stock},
           {"another zone", [](StockBook& b) { b.items[0].stock.zones[0].quality = 2; }, no_stock},
           {"another size", [](StockBook& b) { b.items[1].stock.outline = box_outline(0, 0, 301, 100); },
            no_stock},
           {"another material", [](StockBook& b) { b.items[1].stock.material.name = "iron"; }, no_stock},
           {"another thickness", [](StockBook& b) { b.items[1].stock.material.thickness = mm; }, no_stock},
           {"no name", [](StockBook& b) { b.items[1].stock.material.name = ""; }, ""},
           {"no thickness", [](StockBook& b) { b.items[1].stock.material.thickness = 0; }, ""},
           {"no name and another thickness",
            [](StockBook& b) {
              b.items[1].stock.material = {"", mm};
            },
            no_stock},
           {"a strip", [](StockBook& b) { b.items[9].stock.kind = layout::StockKind::strip; },
            "S10: its stock is another piece"},
           {"another birch", [](StockBook& b) { b.items[2].stock.material.name = "oak"; }, thick},
           {"twice",
            [](StockBook& b) {
              b.orders[1].layouts.push_back(b.orders[1].layouts[0]);
              b.orders[1].uses.push_back({1, "piece", 0, 2});
            },
            "S2 is used twice, by order A2 and by order A2"},
           {"no layout", [](StockBook& b) { b.orders[1].layouts.clear(), b.orders[1].uses.clear(); },
            "order A2: it is allocated and has 0 layouts"},
           {"a layout of what was cancelled",
            [](StockBook& b) { b.orders[1].state = StockOrderState::cancelled; },
            "order A2: it is cancelled and has 1 layouts"},
           {"nothing there", [](StockBook& b) { b.orders[1].uses[0].copy = 1; },
            "order A2: nothing lies on piece #2, which S2 is said to be"},
           {"nobody is it", [](StockBook& b) { b.orders[1].uses.clear(); },
            "order A2: no item is said to be piece #1"},
           {"a broken layout",
            [](StockBook& b) {
              layout::Document document =
                  square_on({sheet(50, 50, kSteel, 1), sheet(300, 100, kSteel, 0.03)}, 60, 0, 0);
              document.stocks[0].id = "other";
              document.placements[0].at.x = 240 * mm + 1;
              b.orders[1].layouts = {io::write_layout(document)};
            },
            "order A2: "}}) {
    StockBook book = honest_book();
    c.change(book);
    expect_said(c.what, judged(book), c.said);
  }
}

struct Written {
  const char* path;
  Json value;
  const char* said;
};

TEST(VerifyStock, WhatIsWrittenIsReadAndCompared) {
  const Json honest = Json::parse(jobs::stock_book_json(honest_book()));
  const char *const no_steps = "no whole number of steps", *const no_size = "is no size and no area",
                    *const other_piece = "its stock is another piece",
                    *const other_id = "its id is not that of such",
                    *const no_state = "is not what such an order says",
                    *const no_place = "has a place in no sheet";
  const Json rule{{"width", 100}, {"height", 100}};
  for (const Written& w :
       std::vector<Written>{{"/inputs", Json::array({"a"}), "a stock is made of no other file"},
                            {"/remnant_min/width", 0, no_size},
                            {"/remnant_min/height", 0, no_size},
                            {"/remnant_min/width", 0x1p-20, ""},
                            {"/remnant_min/height", 0x1p-20, ""},
                            {"/remnant_min/width", 0x1p-21, no_steps},
                            {"/remnant_min/width", 1e9, no_steps},
                            {"/remnant_min", {{"area_mm2", 0}}, no_size},
                            {"/remnant_min", {{"area_mm2", 1}}, ""},
                            {"/remnant_min", {{"area_mm2", 1}, {"width", 1}}, "is not one of such a report"},
                            {"/items/0/at", {0, 0}, no_place},
                            {"/items/0/rectangle", {0, 0, 1, 1}, no_place},
                            {"/items/0/cost", 0.04, "S1: its cost is not that of its stock"},
                            {"/items/0/area_mm2", 30001, "S1: area_mm2 is 30001 and is to be 30000"},
                            {"/items/9/id", "S1", "has the id of another item"},
                            {"/items/9/id", "S11", other_piece},
                            {"/items/9/id", "R10", other_id},
                            {"/items/9/id", "", ": its id is not that of such"},
                            {"/items/5/id", "S6", other_id},
                            {"/items/9/stock/count", 2, other_piece},
                            {"/items/9/state", "allocated", "S10: state is allocated and is to be free"},
                            {"/items/9/order", "A1", "S10: order is not the one that uses it"},
                            {"/items/0/order", nullptr, "S1: order is not the one that uses it"},
                            {"/items/0/order", "A2", "S1: order is not the one that uses it"},
                            {"/items/0/state", "free", "S1: state is free and is to be cut"},
                            {"/items/5/from", "S99", "R6: it is a remnant of S99, which was not cut"},
                            {"/orders/0/id", "", "orders[0].id is empty"},
                            {"/orders/0/id", "A2", "has the id of another order"},
                            {"/orders/0/state", "gone", no_state},
                            {"/orders/1/state", "gone", no_state},
                            {"/orders/1/remnant_min", rule, no_state},
                            {"/orders/6/remnant_min", rule, no_state},
                            {"/orders/1/layouts/0/sheets/0/item", "S99", "order A2: there is no item S99"},
                            {"/orders/1/layouts/0/sheets/0/stock", "other", "nothing lies on other #1"},
                            {"/sums", Json::array(), "sums has 0 items and is to have "}}) {
    Json changed = honest;
    changed.at(w.path) = w.value;
    expect_said(w.path, judged(changed.dump()), w.said);
  }
}

TEST(VerifyStock, EveryFieldOfItsOwnCounts) {
  const Json honest = Json::parse(jobs::stock_book_json(honest_book()));
  const auto is_free = [](const std::string& path) {
    // Stocks and layouts are judged as layouts, and a rule for what is cut next may be any; nothing names an
    // order that was cancelled. A lower corner that moves inward leaves a smaller rectangle, which may still
    // be large enough.
    return cases::one_of(path, {"/stock/", "/layout/"}) || path.starts_with("/remnant_min/") ||
           path == "/items/8/rectangle/0" || path == "/orders/6/id" ||
           cases::one_of(path, {"/orders/0/remnant_min/"});
  };
  std::size_t changes = 0;
  cases::each_path(honest, "", [&](const std::string& path) {
    if (is_free(path) || path == "/generator" || path.starts_with("/format")) return;
    Json changed = honest;
    Json& value = changed.at(path);
    if (value.is_object() || value.is_array())
      value = nullptr;
    else if (cases::is_number(value))
      value = value.get<double>() + 1;
    else
      value = "another";
    EXPECT_NE(judged(changed.dump()), "") << path << " is " << value;
    ++changes;
  });
  EXPECT_GT(changes, 50u);
  // Each of all the corners and sums, which lists alone are walked by their ends.
  for (std::size_t i : {5, 6})
    for (std::size_t k = 0; k < 4; ++k) {
      Json changed = honest;
      Json& value = changed["items"][i]["rectangle"][k];
      value = value.get<double>() + (k < 2 ? 21 : 1);
      EXPECT_NE(judged(changed.dump()), "") << i << ' ' << k;
    }
  for (std::size_t i = 0; i < honest["sums"].size(); ++i)
    for (const std::string& key : honest["sums"][i].keys()) {
      Json changed = honest;
      Json& value = changed["sums"][i][key];
      value = cases::is_number(value) ? Json(value.get<double>() + 1)
              : key == "thickness"    ? Json(9)
                                      : Json("x");
      EXPECT_NE(judged(changed.dump()), "") << i << ' ' << key;
    }
}

TEST(VerifyStock, WhatCannotBeReadIsSaidOfTheFirstFault) {
  Json one = Json::parse(jobs::stock_book_json(StockBook{{mm, mm, 0}, {}, {}}));
  one["items"].push_back({{"id", "S1"},
                          {"state", "free"},
                          {"order", nullptr},
                          {"from", nullptr},
                          {"at", nullptr},
                          {"rectangle", nullptr},
                          {"area_mm2", 1},
                          {"cost", 1}});
  expect_said("no stock", judged(one.dump()), "an item has not one stock");
  // A layout that reads well does not take back what was said of the one before it.
  StockBook book = honest_book();
  change_layout(book.orders[1], [](Json& layout) { layout["units"] = "inch"; });
  book.orders[1].layouts.push_back(honest_book().orders[1].layouts[0]);
  expect_said("units", judged(book), "orders[1].layouts[0]");
  book = honest_book();
  for (const std::size_t i : {0, 1})
    change_layout(book.orders[i], [](Json& layout) { layout["units"] = "inch"; });
  expect_said("two faults", judged(book), "orders[0].layouts[0]");
}

TEST(VerifyStock, APartThatDiffersFromItsLayoutIsNamed) {
  Json honest = cases::empty_layout();
  cases::add_marked_plate(honest, "plate");
  const auto differ = [&](const std::function<void(Json&)>& change) {
    Json layout = honest;
    change(layout["parts"][0]);
    const auto a = read_layout({"a", layout.dump()}), b = read_layout({"b", honest.dump()});
    EXPECT_TRUE(a.has_value() && b.has_value());
    return a && b ? differences(*a, *b) : std::vector<std::string>{};
  };
  const std::vector<std::string> named{"part \"plate\" is not that of the layout it was made from"};
  EXPECT_TRUE(differ([](Json&) {}).empty());
  EXPECT_EQ(differ([](Json& part) { part["marks"].erase(0); }), named);
  EXPECT_EQ(differ([](Json& part) { part["texts"].erase(0); }), named);
  EXPECT_EQ(differ([](Json& part) { part["rotations"] = Json::array({90}); }), named);
  EXPECT_EQ(differ([](Json& part) { part["mirror"] = false; }), named);
}

}  // namespace
}  // namespace lekalo::verify::verify_stock_test
