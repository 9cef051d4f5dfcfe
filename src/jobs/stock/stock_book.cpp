// Everything that a stock file holds, as a document and as sums.

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "jobs/document/report_document.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/io/text/json_writer.hpp"
#include "lekalo/jobs/stock.hpp"

namespace lekalo::jobs {
namespace {

using geom::Int128;

/// Whole areas in half square steps, so that sums are exact.
struct WholeSums {
  layout::Material material;
  Int128 added = 0, free = 0, allocated = 0, parts = 0, cut = 0, remnants = 0;
};

double mm2_of(Int128 twice_steps) { return static_cast<double>(twice_steps) * 0x1p-41; }

/// The area of the parts on each item that was cut.
std::map<std::int64_t, Int128> parts_by_item(const StockBook& book) {
  std::map<std::int64_t, Int128> parts;
  for (const StockOrder& order : book.orders) {
    if (order.state != StockOrderState::cut) continue;
    for (std::size_t i = 0; i < order.layouts.size(); ++i) {
      const auto file = io::read_layout(order.layouts[i], order.id);
      if (!file) continue;  // the checker says so
      const layout::Document& document = file->document;
      std::map<std::pair<std::string, std::int64_t>, std::int64_t> items;
      for (const StockUse& use : order.uses)
        if (use.layout == i) items[{use.stock, use.copy}] = use.item;
      for (const layout::Placement& placement : document.placements)
        parts[items[{document.stocks[placement.stock].id, placement.copy}]] +=
            geom::twice_area(layout::placed_outline(document.parts[placement.part], placement));
    }
  }
  return parts;
}

std::optional<std::string_view> said(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional<std::string_view>(text);
}

void write_rule(io::JsonWriter& json, const layout::RemnantRule& rule) {
  if (rule.area_mm2 > 0)
    json.object({{"area_mm2", rule.area_mm2}});
  else
    json.object({{"width", geom::mm_from_grid(rule.width)}, {"height", geom::mm_from_grid(rule.height)}});
}

void write_item(io::JsonWriter& json, const StockItem& item, const StockItem* from) {
  json.begin_object().fields(
      {{"id", name_of(item)}, {"state", name_of(item.state)}, {"order", said(item.order)}});
  json.key("from");
  if (from != nullptr) {
    const geom::Point at = geom::mm_from_grid(item.at), low = geom::mm_from_grid(item.rectangle.low),
                      high = geom::mm_from_grid(item.rectangle.high);
    json.value(name_of(*from)).key("at").list({at.x, at.y});
    json.key("rectangle").list({low.x, low.y, high.x, high.y});
  } else {
    json.value(nullptr).fields({{"at", nullptr}, {"rectangle", nullptr}});
  }
  json.field("area_mm2", geom::area_mm2(item.stock.outline.polygon)).field("cost", item.stock.cost);
  json.key("stock").raw() += io::stock_json(item.stock);
  json.end();
}

void write_order(io::JsonWriter& json, const StockOrder& order,
                 const std::map<std::int64_t, std::string>& names) {
  json.begin_object().fields({{"id", order.id}, {"state", name_of(order.state)}});
  json.key("remnant_min");
  order.state == StockOrderState::cut ? write_rule(json, order.rule) : void(json.value(nullptr));
  json.key("layouts").begin_list();
  for (std::size_t i = 0; i < order.layouts.size(); ++i) {
    json.begin_object().key("sheets").begin_list();
    for (const StockUse& use : order.uses)
      if (use.layout == i)
        json.object({{"stock", use.stock}, {"copy", use.copy}, {"item", names.at(use.item)}});
    json.end().key("layout").raw() +=
        std::string_view(order.layouts[i]).substr(0, order.layouts[i].find_last_not_of('\n') + 1);
    json.end();
  }
  json.end().end();
}

}  // namespace

std::vector<StockSums> sums_of(const StockBook& book) {
  const std::map<std::int64_t, Int128> parts = parts_by_item(book);
  std::vector<WholeSums> whole;
  for (const StockItem& item : book.items) {
    auto sums = std::find_if(whole.begin(), whole.end(),
                             [&](const WholeSums& one) { return one.material == item.stock.material; });
    if (sums == whole.end()) sums = whole.insert(sums, WholeSums{item.stock.material});
    const Int128 area = geom::twice_area(item.stock.outline.polygon);
    if (item.from == 0) sums->added += area;
    if (item.from != 0) sums->remnants += area;
    if (item.state == StockState::free) sums->free += area;
    if (item.state == StockState::allocated) sums->allocated += area;
    if (item.state != StockState::cut) continue;
    sums->cut += area;
    if (const auto found = parts.find(item.id); found != parts.end()) sums->parts += found->second;
  }
  std::vector<StockSums> all;
  for (const WholeSums& one : whole)
    all.push_back({one.material, mm2_of(one.added), mm2_of(one.free), mm2_of(one.allocated),
                   mm2_of(one.parts), mm2_of(one.cut - one.parts - one.remnants)});
  return all;
}

std::string stock_book_json(const StockBook& book) {
  std::map<std::int64_t, const StockItem*> items;
  std::map<std::int64_t, std::string> names;
  for (const StockItem& item : book.items) items[item.id] = &item, names[item.id] = name_of(item);
  io::JsonWriter json = begin_document("lekalo-stock");
  json.field("units", "mm").key("inputs").begin_list().end().key("remnant_min");
  write_rule(json, book.rule);
  json.key("items").begin_list();
  for (const StockItem& item : book.items)
    write_item(json, item, item.from == 0 ? nullptr : items.at(item.from));
  json.end().key("orders").begin_list();
  for (const StockOrder& order : book.orders) write_order(json, order, names);
  json.end().key("sums").begin_list();
  for (const StockSums& sums : sums_of(book)) {
    std::optional<double> thickness;
    if (sums.material.thickness != 0) thickness = geom::mm_from_grid(sums.material.thickness);
    json.object({{"material", said(sums.material.name)},
                 {"thickness", thickness},
                 {"added_mm2", sums.added},
                 {"free_mm2", sums.free},
                 {"allocated_mm2", sums.allocated},
                 {"parts_mm2", sums.parts},
                 {"lost_mm2", sums.lost}});
  }
  json.end();
  return end_document(json);
}

Result<verify::ClaimReport> check_book(const StockBook& book, const std::string& name) {
  const std::string bytes = stock_book_json(book);
  return verify::verify_stock({name, bytes});
}

}  // namespace lekalo::jobs
