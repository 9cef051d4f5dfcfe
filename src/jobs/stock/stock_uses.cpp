// Finds the pieces of stock that a layout is cut from, and what is left of them.

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "lekalo/jobs/stock.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/material_words.hpp"

namespace lekalo::jobs {
namespace {

using layout::Material;
using layout::Stock;

/// Says whether pieces are the same but for their ids and costs.
bool same_piece(const Stock& a, const Stock& b) {
  return a.outline.polygon == b.outline.polygon && a.defects == b.defects && a.zones == b.zones;
}

/// Says whether something of this material may be cut from an item, which may say none.
bool serves(const Material& item, const Material& wanted) {
  return (item.name.empty() || item.name == wanted.name) &&
         (item.thickness == 0 || item.thickness == wanted.thickness);
}

const StockItem* item_of(const std::vector<StockItem>& items, std::int64_t id) {
  const auto found =
      std::find_if(items.begin(), items.end(), [id](const StockItem& one) { return one.id == id; });
  return found == items.end() ? nullptr : &*found;
}

/// The copies of each stock on which something lies.
std::map<std::uint32_t, std::set<std::int64_t>> copies_in_use(const layout::Document& document) {
  std::map<std::uint32_t, std::set<std::int64_t>> copies;
  for (const layout::Placement& placement : document.placements)
    copies[placement.stock].insert(placement.copy);
  return copies;
}

class UseFinder {
 public:
  UseFinder(const std::vector<StockItem>& items, const std::string& order) : items_(items), order_(order) {}

  Result<std::vector<StockUse>> find(const std::vector<LayoutToCut>& layouts) {
    for (std::size_t i = 0; i < layouts.size(); ++i) find_of(layouts[i], i);
    if (!faults_.empty()) return failure(ErrorCode::bad_input, faults_);
    return std::move(uses_);
  }

 private:
  void fault(const std::string& sentence) { faults_ += (faults_.empty() ? "" : "; ") + sentence; }

  void find_of(const LayoutToCut& layout, std::size_t number) {
    const layout::Document& document = layout.document;
    if (document.placements.empty())
      return fault(layout.name + ": nothing is placed, so there is nothing to cut");
    if (const std::size_t broken = layout::check(document).size(); broken > 0)
      return fault(
          fmt::format("{}: it breaks {} {}, which lekalo check names; a layout that is cut breaks none",
                      layout.name, broken, broken == 1 ? "rule" : "rules"));
    for (const auto& [stock, copies] : copies_in_use(document)) {
      const Stock& wanted = document.stocks[stock];
      std::size_t found = 0;
      for (const std::int64_t copy : copies) {
        const StockItem* const item = take(wanted);
        if (item == nullptr) {
          fault(fmt::format("{}: {}", layout.name, why_none(wanted, found, copies.size())));
          break;
        }
        ++found;
        uses_.push_back({number, wanted.id, copy, item->id});
      }
    }
  }

  /// An item for one copy, which is taken then; or nullptr.
  const StockItem* take(const Stock& wanted) {
    const StockItem* found = nullptr;
    for (const StockItem& item : items_) {
      if (!is_free(item) || taken_.contains(item.id) || !same_piece(item.stock, wanted) ||
          !serves(item.stock.material, wanted.material))
        continue;
      if (found == nullptr || name_of(item) == wanted.id) found = &item;
    }
    if (found != nullptr) taken_.insert(found->id);
    return found;
  }

  [[nodiscard]] bool is_free(const StockItem& item) const {
    return item.state == StockState::free || (item.state == StockState::allocated && item.order == order_);
  }

  /// \param found, needed  copies of this stock
  [[nodiscard]] std::string why_none(const Stock& wanted, std::size_t found, std::size_t needed) const {
    const StockItem *gone = nullptr, *other = nullptr;
    for (const StockItem& item : items_) {
      if (!same_piece(item.stock, wanted)) continue;
      if (!serves(item.stock.material, wanted.material))
        other = other == nullptr ? &item : other;
      else if (!is_free(item) &&
               (gone == nullptr || name_of(item) == wanted.id || item.state == StockState::allocated))
        gone = &item;
    }
    if (gone != nullptr || found > 0) {
      std::string sentence = fmt::format("it needs {} of its stock {}, and {} {} free", needed, wanted.id,
                                         found, found == 1 ? "is" : "are");
      if (gone != nullptr)
        sentence += fmt::format("; {} is {} order {}", name_of(*gone),
                                gone->state == StockState::cut ? "cut for" : "allocated to", gone->order);
      return sentence;
    }
    if (other != nullptr)
      return fmt::format(
          "its stock {} is of {}, and the pieces of this outline are of another material: {} of {}",
          wanted.id, layout::words_of(wanted.material), name_of(*other),
          layout::words_of(other->stock.material));
    return fmt::format("its stock {} is no piece of this stock file; lekalo stock add adds it", wanted.id);
  }

  const std::vector<StockItem>& items_;
  const std::string& order_;
  std::set<std::int64_t> taken_;
  std::vector<StockUse> uses_;
  std::string faults_;
};

}  // namespace

Result<std::vector<StockUse>> uses_of(const std::vector<LayoutToCut>& layouts,
                                      const std::vector<StockItem>& items, const std::string& order) {
  return UseFinder(items, order).find(layouts);
}

std::vector<Stock> offered_stock(const std::vector<StockItem>& items) {
  std::vector<Stock> remnants, sheets;
  std::vector<const StockItem*> by_size;
  for (const StockItem& item : items)
    if (item.state == StockState::free && item.from != 0) by_size.push_back(&item);
  const auto area = [](const StockItem* item) { return geom::twice_area(item->stock.outline.polygon); };
  std::stable_sort(by_size.begin(), by_size.end(),
                   [&](const StockItem* a, const StockItem* b) { return area(a) > area(b); });
  std::map<std::pair<std::string, std::int64_t>, std::size_t> of_material;
  for (const StockItem* item : by_size) {
    const Material& material = item->stock.material;
    if (of_material[{material.name, material.thickness}]++ >= kMostOffered) continue;
    Stock& stock = remnants.emplace_back(item->stock);
    stock.id = name_of(*item);
    stock.cost *= kRemnantCostShare;
  }
  for (const StockItem& item : items) {
    if (item.state != StockState::free || item.from != 0) continue;
    const auto alike = std::find_if(sheets.begin(), sheets.end(), [&](const Stock& one) {
      return same_piece(one, item.stock) && one.material == item.stock.material &&
             one.cost == item.stock.cost && one.grain_degrees == item.stock.grain_degrees;
    });
    if (alike != sheets.end()) {
      ++alike->count;
      continue;
    }
    sheets.push_back(item.stock);
    sheets.back().id = name_of(item);
  }
  remnants.insert(remnants.end(), sheets.begin(), sheets.end());
  return remnants;
}

std::vector<StockItem> remnants_left(const std::vector<LayoutToCut>& layouts,
                                     const std::vector<StockUse>& uses, const std::vector<StockItem>& items,
                                     const layout::RemnantRule& rule) {
  std::vector<StockItem> left;
  for (const StockUse& use : uses) {
    const layout::Document& document = layouts[use.layout].document;
    const auto stock = std::find_if(document.stocks.begin(), document.stocks.end(),
                                    [&](const Stock& one) { return one.id == use.stock; });
    const auto number = static_cast<std::uint32_t>(stock - document.stocks.begin());
    for (const layout::Remnant& remnant : layout::remnants_of(document, number, use.copy, rule)) {
      StockItem item;
      item.from = use.item;
      item.at = geom::bounds(remnant.outline).low;
      item.rectangle = geom::moved(remnant.rectangle, -item.at);
      item.stock = layout::stock_of(item_of(items, use.item)->stock, remnant);
      left.push_back(std::move(item));
    }
  }
  return left;
}

}  // namespace lekalo::jobs
