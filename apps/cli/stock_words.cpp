#include "stock_words.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "lekalo/layout/material_words.hpp"

namespace lekalo::cli {

std::string item_text(const jobs::StockItem& item) { return "  " + jobs::words_of(item) + '\n'; }

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
