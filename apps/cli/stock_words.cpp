#include "stock_words.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/layout/material_words.hpp"

namespace lekalo::cli {

std::string item_text(const jobs::StockItem& item) {
  const geom::GridBox box = geom::bounds(item.stock.outline.polygon);
  const geom::Point size = geom::mm_from_grid(box.high - box.low);
  std::string text = fmt::format("  {:<6} {:g} x {:g} mm, {:.4f} m2, {}, cost {:g}", name_of(item), size.x,
                                 size.y, geom::area_mm2(item.stock.outline.polygon) * 1e-6,
                                 layout::words_of(item.stock.material), item.stock.cost);
  if (item.state == jobs::StockState::allocated) text += ", allocated to order " + item.order;
  return text + '\n';
}

std::string sums_text(const std::vector<jobs::StockSums>& sums) {
  std::string text;
  for (const jobs::StockSums& one : sums)
    text += fmt::format("{}: {:.4f} m2 came; {:.4f} free, {:.4f} allocated, {:.4f} in parts, {:.4f} lost\n",
                        layout::words_of(one.material), one.added * 1e-6, one.free * 1e-6,
                        one.allocated * 1e-6, one.parts * 1e-6, one.lost * 1e-6);
  return text;
}

std::string allocated_text(const jobs::StockOrder& order, const std::vector<jobs::StockItem>& items) {
  std::string text;
  for (const jobs::StockUse& use : order.uses) {
    const auto item = std::find_if(items.begin(), items.end(),
                                   [&](const jobs::StockItem& one) { return one.id == use.item; });
    if (item == items.end()) continue;
    const std::string name = name_of(*item);
    text += (text.empty() ? "" : ", ") + name;
    if (name != use.stock || use.copy != 0) text += fmt::format(" ({} #{})", use.stock, use.copy + 1);
  }
  return fmt::format("order {}: allocated {}\n", order.id, text);
}

}  // namespace lekalo::cli
