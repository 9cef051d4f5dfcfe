#include "lekalo/layout/job.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "lekalo/base/limits.hpp"

namespace lekalo::layout {
namespace {

/// The new numbers of items by their old ones; empty where all keep theirs.
using Numbers = std::vector<std::uint32_t>;
constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();

template <class Item>
std::vector<ItemChange<Item>> reversed(const std::vector<ItemChange<Item>>& changes) {
  std::vector<ItemChange<Item>> back;
  for (const ItemChange<Item>& one : changes) back.push_back({one.index, one.after, one.before});
  return back;
}

template <class Item>
Numbers bring_in(std::vector<Item>& list, const std::vector<ItemChange<Item>>& changes) {
  std::vector<Item> all;
  Numbers numbers;
  bool same = true;
  auto next = changes.begin();
  for (std::size_t old = 0; old < list.size() || next != changes.end();) {
    const auto index = static_cast<std::uint32_t>(all.size());
    const ItemChange<Item>* const here = next != changes.end() && next->index == index ? &*next++ : nullptr;
    if (here != nullptr && !here->before) {
      all.push_back(*here->after);
      same = same && old == list.size();
      continue;
    }
    if (old == list.size()) break;
    numbers.push_back(index);
    if (here != nullptr && here->after)
      all.push_back(*here->after);
    else
      all.push_back(std::move(list[old]));
    ++old;
  }
  list = std::move(all);
  return same ? Numbers{} : numbers;
}

template <class Item>
Numbers take_out(std::vector<Item>& list, const std::vector<ItemChange<Item>>& changes) {
  Numbers numbers(list.size(), 0);
  for (const ItemChange<Item>& one : changes)
    if (!one.after) numbers[one.index] = kGone;
  std::uint32_t left = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (numbers[i] == kGone) continue;
    numbers[i] = left;
    if (left != i) list[left] = std::move(list[i]);
    ++left;
  }
  const bool same = left == list.size();
  list.resize(left);
  return same ? Numbers{} : numbers;
}

void renumber(std::vector<Kit>& kits, const Numbers& parts) {
  if (parts.empty()) return;
  for (Kit& kit : kits)
    for (KitPiece& piece : kit.pieces) piece.part = parts[piece.part];
}

void renumber(Document& document, const Numbers& parts, const Numbers& stocks) {
  if (parts.empty() && stocks.empty()) return;
  for (Placement& placement : document.placements) {
    if (!parts.empty()) placement.part = parts[placement.part];
    if (!stocks.empty()) placement.stock = stocks[placement.stock];
  }
  renumber(document.kits, parts);
}

template <class Item>
bool can_bring_in(const std::vector<Item>& list, const std::vector<ItemChange<Item>>& changes) {
  std::size_t size = list.size();
  for (const ItemChange<Item>& one : changes) size += one.before ? 0 : 1;
  std::set<std::string_view> ids;
  std::size_t old = 0;
  auto next = changes.begin();
  for (std::size_t index = 0; index < size; ++index) {
    const bool is_here = next != changes.end() && next->index == index;
    const ItemChange<Item>* const here = is_here ? &*next++ : nullptr;
    const bool comes = here != nullptr && !here->before;
    if (comes && !here->after) return false;
    if (!comes && (old == list.size() || (here != nullptr && !(*here->before == list[old])))) return false;
    if (here == nullptr || here->after)
      if (!ids.insert(here != nullptr ? here->after->id : list[old].id).second) return false;
    if (!comes) ++old;
  }
  return next == changes.end() && old == list.size();
}

/// The numbers of what goes, ascending.
template <class Item>
Numbers going(const std::vector<ItemChange<Item>>& changes) {
  Numbers numbers;
  for (const ItemChange<Item>& one : changes)
    if (!one.after) numbers.push_back(one.index);
  return numbers;
}

/// The value that all items have; nothing where they differ or have none.
template <class Item, class Value>
std::optional<Value> common(const std::vector<Item>& items, std::optional<Value> Item::*of) {
  if (items.empty()) return std::nullopt;
  const std::optional<Value>& first = items.front().*of;
  const bool all = std::all_of(items.begin(), items.end(), [&](const Item& one) { return one.*of == first; });
  return all ? first : std::nullopt;
}

/// The pieces that are wanted in all, at least 1 and no more than a count can be.
std::int64_t pieces_wanted(const Document& document, const std::vector<Part>& more) {
  std::int64_t pieces = 0;
  const auto add = [&](std::int64_t count) { pieces = std::min(limits::kMostCount, pieces + count); };
  for (const Part& part : document.parts) add(part.demand);
  for (const Part& part : more) add(part.demand);
  for (const Kit& kit : document.kits)
    for (const KitPiece& piece : kit.pieces) add(kit.demand * piece.count);
  return std::max<std::int64_t>(pieces, 1);
}

template <class Item>
Material common_material(const std::vector<Item>& items) {
  for (const Item& one : items)
    if (!(one.material == items.front().material)) return {};
  return items.empty() ? Material{} : items.front().material;
}

template <class Item>
std::vector<ItemChange<Item>> coming(const std::vector<Item>& there, std::vector<Item> items) {
  FreeIds ids;
  for (const Item& one : there) ids.keep(one.id);
  std::vector<ItemChange<Item>> changes;
  for (Item& one : items) {
    one.id = ids.take(one.id);
    changes.push_back(
        {static_cast<std::uint32_t>(there.size() + changes.size()), std::nullopt, std::move(one)});
  }
  return changes;
}

}  // namespace

JobChange reversed(const JobChange& change) {
  JobChange back{reversed(change.parts), reversed(change.stocks), std::nullopt, reversed(change.kits)};
  if (change.rules) back.rules = RulesChange{change.rules->after, change.rules->before};
  return back;
}

void bring_in(Document& document, const JobChange& change) {
  const Numbers parts = bring_in(document.parts, change.parts);
  renumber(document, parts, bring_in(document.stocks, change.stocks));
  bring_in(document.kits, change.kits);
  if (change.rules) document.rules = change.rules->after;
}

void take_out(Document& document, const JobChange& change) {
  take_out(document.kits, change.kits);
  const Numbers parts = take_out(document.parts, change.parts);
  renumber(document, parts, take_out(document.stocks, change.stocks));
}

std::vector<Kit> kits_beside(const Document& document, const JobChange& change) {
  std::vector<Kit> kits = document.kits;
  Numbers parts;
  auto next = change.parts.begin();
  for (std::uint32_t index = 0; parts.size() < document.parts.size(); ++index) {
    const bool is_here = next != change.parts.end() && next->index == index;
    if (!is_here || next->before) parts.push_back(index);
    if (is_here) ++next;
  }
  renumber(kits, parts);
  return kits;
}

bool can_bring_in(const Document& document, const JobChange& change) {
  if (!can_bring_in(document.parts, change.parts) || !can_bring_in(document.stocks, change.stocks) ||
      (change.rules && !(change.rules->before == document.rules)))
    return false;
  if (change.kits.empty()) return true;
  const auto comes = [](const ItemChange<Part>& one) { return !one.before; };
  const std::size_t parts = document.parts.size() + static_cast<std::size_t>(std::count_if(
                                                        change.parts.begin(), change.parts.end(), comes));
  const auto names_parts = [&](const ItemChange<Kit>& one) {
    return !one.after || std::all_of(one.after->pieces.begin(), one.after->pieces.end(),
                                     [&](const KitPiece& piece) { return piece.part < parts; });
  };
  return std::all_of(change.kits.begin(), change.kits.end(), names_parts) &&
         can_bring_in(kits_beside(document, change), change.kits);
}

bool can_take_out(const Document& document, const JobChange& change) {
  const Numbers parts = going(change.parts), stocks = going(change.stocks);
  const auto goes = [](const Numbers& numbers, std::uint32_t number) {
    return std::binary_search(numbers.begin(), numbers.end(), number);
  };
  if (parts.empty() && stocks.empty()) return true;
  for (const Placement& placement : document.placements)
    if (goes(parts, placement.part) || goes(stocks, placement.stock)) return false;
  const Numbers kits = going(change.kits);
  for (std::uint32_t i = 0; i < document.kits.size(); ++i)
    for (const KitPiece& piece : document.kits[i].pieces)
      if (goes(parts, piece.part) && !goes(kits, i)) return false;
  return true;
}

JobChange added(const Document& document, Additions additions) {
  const std::int64_t enough = pieces_wanted(document, additions.parts);
  const auto part_grain = common(document.parts, &Part::grain);
  const auto stock_grain = common(document.stocks, &Stock::grain_degrees);
  const Material part_material = common_material(document.parts),
                 stock_material = common_material(document.stocks);
  for (Part& part : additions.parts) {
    if (!part.grain) part.grain = part_grain;
    if (!part.material.is_said()) part.material = part_material;
  }
  for (Stock& stock : additions.stocks) {
    if (stock.count == 0) stock.count = enough;
    if (!stock.grain_degrees) stock.grain_degrees = stock_grain;
    if (!stock.material.is_said()) stock.material = stock_material;
  }
  return {coming(document.parts, std::move(additions.parts)),
          coming(document.stocks, std::move(additions.stocks)), std::nullopt};
}

std::string FreeIds::take(const std::string& wanted) {
  std::string id = wanted;
  std::size_t& last = last_of_[wanted];
  if (last == 0) last = 1;
  while (!taken_.insert(id).second) id = fmt::format("{}-{}", wanted, ++last);
  return id;
}

Stock sheet_of(std::int64_t width, std::int64_t height, std::int64_t count) {
  Stock stock;
  stock.id = fmt::format("{:g}x{:g}", geom::mm_from_grid(width), geom::mm_from_grid(height));
  stock.count = count;
  stock.outline.polygon = geom::rectangle({{0, 0}, {width, height}});
  stock.cost = geom::area_mm2(stock.outline.polygon) * 1e-6;
  return stock;
}

Stock strip_of(std::int64_t width) {
  Stock stock;
  stock.id = fmt::format("strip-{:g}", geom::mm_from_grid(width));
  stock.kind = StockKind::strip;
  stock.open_length = true;
  stock.outline.polygon = geom::rectangle({{0, 0}, {kLongestStrip, width}});
  return stock;
}

}  // namespace lekalo::layout
