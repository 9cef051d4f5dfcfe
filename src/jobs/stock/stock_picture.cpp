// Draws what is in stock.

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "jobs/document/picture_bytes.hpp"
#include "lekalo/draw/layout_picture.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/stock.hpp"

namespace lekalo::jobs {
namespace {

using geom::Int128;

/// Pieces side by side in rows, as a layout that can be drawn: each is a part called after its name, on one
/// sheet that is as large as they need.
layout::Document rack_of(const std::vector<const StockItem*>& items) {
  constexpr std::int64_t kApart = 100 * geom::kGridPerMm;
  layout::Document rack;
  Int128 area = 0;
  std::int64_t widest = 0;
  for (const StockItem* item : items) {
    const geom::GridBox box = geom::bounds(item->stock.outline.polygon);
    area += Int128{box.high.x - box.low.x + kApart} * (box.high.y - box.low.y + kApart);
    widest = std::max(widest, box.high.x - box.low.x);
  }
  // Rows about twice as long as all of them are high.
  std::int64_t row_length = widest;
  while (Int128{row_length} * row_length < 2 * area && row_length < geom::kGridLimit / 8)
    row_length += row_length / 8 + 1;
  geom::GridPoint next{0, 0};
  std::int64_t row_height = 0, length = 0;
  for (const StockItem* item : items) {
    const geom::GridBox box = geom::bounds(item->stock.outline.polygon);
    const std::int64_t width = box.high.x - box.low.x;
    if (next.x > 0 && next.x + width > row_length) next = {0, next.y + row_height + kApart}, row_height = 0;
    layout::Part part;
    part.id = name_of(*item);
    part.outline = {item->stock.outline.polygon, {}, 0};
    part.demand = 1;
    layout::Placement placement;
    placement.id = rack.next_id++;
    placement.part = static_cast<std::uint32_t>(rack.parts.size());
    placement.at = next - box.low;
    rack.parts.push_back(std::move(part));
    rack.placements.push_back(placement);
    row_height = std::max(row_height, box.high.y - box.low.y);
    length = std::max(length, next.x + width);
    next.x += width + kApart;
  }
  layout::Stock floor;
  floor.id = "stock";
  floor.outline.polygon = geom::rectangle({{0, 0}, {length, next.y + row_height}});
  rack.stocks.push_back(std::move(floor));
  return rack;
}

}  // namespace

Result<std::string> stock_picture(const StockBook& book, const std::string& title, PictureForm form) {
  std::vector<const StockItem*> items;
  std::vector<std::string> lines;
  for (const StockItem& item : book.items) {
    if (item.state == StockState::cut) continue;
    items.push_back(&item);
    lines.push_back(words_of(item));
  }
  if (items.empty())
    return failure(ErrorCode::bad_input, fmt::format("{}: nothing is in it that could be drawn", title));
  const layout::Document rack = rack_of(items);
  const layout::Completeness completeness = layout::completeness(rack);
  const std::vector<layout::Violation> none;
  return picture_bytes({io::as_utf8(title), rack, completeness, none, lines}, form);
}

}  // namespace lekalo::jobs
