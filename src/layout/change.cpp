// Carries changes out and takes them back, and makes those that lead from one document to another.

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

#include "lekalo/layout/command.hpp"

namespace lekalo::layout {
namespace {

std::uint64_t id_of(const PlacementChange& change) {
  return change.after ? change.after->id : change.before->id;
}

void set_placements(Workspace& workspace, const Change& change,
                    std::optional<Placement> PlacementChange::*to) {
  for (const PlacementChange& one : change.placements)
    if (one.*to)
      workspace.set(*(one.*to));
    else
      workspace.erase(id_of(one));
}

/// The list that has what goes and what comes, of two lists in which items are known by their ids.
template <class Item>
struct Merged {
  std::vector<ItemChange<Item>> changes;  ///< of what goes and what comes alone
  std::vector<std::uint32_t> from, to;    ///< the numbers of both lists' items in it
  /// The numbers in `from` and in `to` of those that stay.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stay;
};

/// Those that stay are in one order in both lists.
template <class Item>
Merged<Item> merged(const std::vector<Item>& from, const std::vector<Item>& to) {
  std::map<std::string_view, std::uint32_t> places;
  for (std::uint32_t i = 0; i < from.size(); ++i) places.emplace(from[i].id, i);
  Merged<Item> all;
  std::uint32_t old = 0, size = 0;
  const auto goes_up_to = [&](std::uint32_t place) {
    for (; old < place; ++old) {
      all.from.push_back(size);
      all.changes.push_back({size++, from[old], std::nullopt});
    }
  };
  for (std::uint32_t i = 0; i < to.size(); ++i) {
    const auto known = places.find(to[i].id);
    const bool stays = known != places.end() && known->second >= old;
    if (stays) {
      goes_up_to(known->second);
      all.stay.push_back({old++, i});
      all.from.push_back(size);
      all.to.push_back(size++);
    } else {
      all.to.push_back(size);
      all.changes.push_back({size++, std::nullopt, to[i]});
    }
  }
  goes_up_to(static_cast<std::uint32_t>(from.size()));
  return all;
}

template <class Item>
void add_change(std::vector<ItemChange<Item>>& changes, ItemChange<Item> one) {
  const auto at =
      std::lower_bound(changes.begin(), changes.end(), one.index,
                       [](const ItemChange<Item>& a, std::uint32_t index) { return a.index < index; });
  changes.insert(at, std::move(one));
}

Placement numbered(Placement placement, const std::vector<std::uint32_t>& parts,
                   const std::vector<std::uint32_t>& stocks) {
  placement.part = parts[placement.part];
  placement.stock = stocks[placement.stock];
  return placement;
}

std::vector<Kit> numbered(std::vector<Kit> kits, const std::vector<std::uint32_t>& parts) {
  for (Kit& kit : kits)
    for (KitPiece& piece : kit.pieces) piece.part = parts[piece.part];
  return kits;
}

bool same_but_features(const Stock& a, const Stock& b) {
  return a.id == b.id && a.name == b.name && a.kind == b.kind && a.count == b.count && a.cost == b.cost &&
         a.open_length == b.open_length && a.grain_degrees == b.grain_degrees && a.outline == b.outline;
}

/// The numbers of a list `then`, with what a change brings into it, in a list `now`, with the same.
template <class Item>
class Renumbering {
 public:
  Renumbering(const char* what, const std::vector<Item>& then, const std::vector<Item>& now,
              const std::vector<ItemChange<Item>>& changes)
      : what_(what) {
    std::map<std::string_view, std::uint32_t> places;
    for (std::uint32_t i = 0; i < now.size(); ++i) places.emplace(now[i].id, i);
    // An item that comes stands behind the one that it stood behind then, as far as that one is still there.
    std::vector<std::vector<std::size_t>> behind(now.size() + 1);
    std::size_t anchor = 0, old = 0;
    auto next = changes.begin();
    while (old < then.size() || next != changes.end()) {
      const bool is_here = next != changes.end() && next->index == items_.size();
      if (is_here && !next->before) {
        behind[anchor].push_back(items_.size());
        items_.push_back({&next++->after->id, kNowhere, nullptr, nullptr});
        continue;
      }
      if (is_here) ++next;
      if (old == then.size()) break;
      const auto known = places.find(then[old].id);
      const bool there = known != places.end();
      items_.push_back({&then[old].id, there ? known->second : kNowhere, &then[old],
                        there ? &now[known->second] : nullptr});
      if (there) anchor = known->second + 1;
      ++old;
    }
    std::vector<std::uint32_t> numbers(now.size());
    std::uint32_t size = 0;
    for (std::size_t i = 0; i <= now.size(); ++i) {
      for (const std::size_t come : behind[i]) items_[come].number = size++;
      if (i < now.size()) numbers[i] = size++;
    }
    for (Item_& one : items_)
      if (one.now != nullptr) one.number = numbers[one.number];
  }

  /// Gives a number its new value.
  [[nodiscard]] Result<void> operator()(std::uint32_t& number) const {
    if (items_[number].number == kNowhere)
      return failure(ErrorCode::refuted,
                     fmt::format("{} '{}' is not there any more", what_, *items_[number].id));
    number = items_[number].number;
    return {};
  }
  [[nodiscard]] Result<void> operator()(std::vector<ItemChange<Item>>& changes) const {
    for (ItemChange<Item>& one : changes) LEKALO_CHECK((*this)(one.index));
    std::sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
    return {};
  }
  /// Says whether an item has the outline that it had then; true for what comes.
  [[nodiscard]] bool same_shape(std::uint32_t number) const {
    const Item_& one = items_[number];
    return one.now == nullptr || one.now->outline == one.then->outline;
  }
  [[nodiscard]] const std::string& id(std::uint32_t number) const { return *items_[number].id; }

 private:
  static constexpr std::uint32_t kNowhere = 0xffffffffU;
  struct Item_ {
    const std::string* id;
    std::uint32_t number;
    const Item *then, *now;
  };
  const char* what_;
  std::vector<Item_> items_;
};

}  // namespace

void carry_out(Workspace& workspace, const Change& change) {
  if (!change.job.is_nothing()) {
    // Numbers and gaps are others now, so all scenes are made anew.
    Document document = workspace.document();
    carry_out(document, change);
    workspace = Workspace(std::move(document));
    return;
  }
  set_placements(workspace, change, &PlacementChange::after);
  for (const FeatureChange& one : change.features)
    if (one.after)
      workspace.set_feature(one.stock, one.index, *one.after);
    else
      workspace.erase_feature(one.stock, one.before->kind, one.before->id);
  workspace.set_next_id(change.next_id_after);
}

void take_back(Workspace& workspace, const Change& change) {
  if (!change.job.is_nothing()) return carry_out(workspace, reversed(change, change.next_id_before));
  for (auto one = change.features.rbegin(); one != change.features.rend(); ++one)
    if (one->before)
      workspace.set_feature(one->stock, one->index, *one->before);
    else
      workspace.erase_feature(one->stock, one->after->kind, one->after->id);
  set_placements(workspace, change, &PlacementChange::before);
  workspace.set_next_id(change.next_id_before);
}

void carry_out(Document& document, const Change& change) {
  bring_in(document, change.job);
  auto& placements = document.placements;
  const auto before_id = [](const Placement& p, std::uint64_t id) { return p.id < id; };
  for (const PlacementChange& one : change.placements) {
    const std::uint64_t id = id_of(one);
    const auto at = std::lower_bound(placements.begin(), placements.end(), id, before_id);
    const bool there = at != placements.end() && at->id == id;
    if (one.after && there) *at = *one.after;
    if (one.after && !there) placements.insert(at, *one.after);
    if (!one.after && there) placements.erase(at);
  }
  for (const FeatureChange& one : change.features) {
    Stock& stock = document.stocks[one.stock];
    if (one.after)
      put_feature(stock, one.index, *one.after);
    else if (const auto at = find_feature(stock, one.before->kind, one.before->id))
      take_feature(stock, one.before->kind, *at);
  }
  take_out(document, change.job);
  document.next_id = change.next_id_after;
}

Change reversed(const Change& change, std::uint64_t next_id) {
  Change back;
  back.next_id_before = back.next_id_after = next_id;
  for (const PlacementChange& one : change.placements) back.placements.push_back({one.after, one.before});
  for (auto one = change.features.rbegin(); one != change.features.rend(); ++one)
    back.features.push_back({one->stock, one->index, one->after, one->before});
  back.job = reversed(change.job);
  return back;
}

Change difference(const Document& from, const Document& to) {
  Merged<Part> parts = merged(from.parts, to.parts);
  Merged<Stock> stocks = merged(from.stocks, to.stocks);
  const std::vector<Kit> kits_before = numbered(from.kits, parts.from),
                         kits_after = numbered(to.kits, parts.to);
  Merged<Kit> kits = merged(kits_before, kits_after);
  Change change;
  change.next_id_before = from.next_id;
  change.next_id_after = to.next_id;
  for (const auto& [old, now] : parts.stay)
    if (!(from.parts[old] == to.parts[now]))
      add_change(parts.changes, {parts.from[old], from.parts[old], to.parts[now]});
  for (const auto& [old, now] : kits.stay)
    if (!(kits_before[old] == kits_after[now]))
      add_change(kits.changes, {kits.from[old], kits_before[old], kits_after[now]});
  Document drawn_before, drawn_after;  // the stocks of which the features alone may differ
  std::vector<std::uint32_t> drawn;    // their numbers
  for (const auto& [old, now] : stocks.stay) {
    const Stock &before = from.stocks[old], &after = to.stocks[now];
    if (same_but_features(before, after)) {
      drawn_before.stocks.push_back(before);
      drawn_after.stocks.push_back(after);
      drawn.push_back(stocks.from[old]);
    } else {
      add_change(stocks.changes, {stocks.from[old], before, after});
    }
  }
  change.features = feature_difference(drawn_before, drawn_after);
  for (FeatureChange& one : change.features) one.stock = drawn[one.stock];
  std::size_t i = 0, k = 0;
  while (i < from.placements.size() || k < to.placements.size()) {
    const bool has_old = k == to.placements.size() ||
                         (i < from.placements.size() && from.placements[i].id <= to.placements[k].id);
    const bool has_new = i == from.placements.size() ||
                         (k < to.placements.size() && to.placements[k].id <= from.placements[i].id);
    PlacementChange one;
    if (has_old) one.before = numbered(from.placements[i++], parts.from, stocks.from);
    if (has_new) one.after = numbered(to.placements[k++], parts.to, stocks.to);
    if (one.before != one.after) change.placements.push_back(std::move(one));
  }
  change.job.parts = std::move(parts.changes);
  change.job.stocks = std::move(stocks.changes);
  change.job.kits = std::move(kits.changes);
  if (!(from.rules == to.rules)) change.job.rules = RulesChange{from.rules, to.rules};
  return change;
}

Result<Change> renumbered(Change change, const Document& then, const Document& now) {
  const JobChange job = change.job;  // the numberings keep pointers into it
  const Renumbering<Part> parts("part", then.parts, now.parts, job.parts);
  const Renumbering<Stock> stocks("stock", then.stocks, now.stocks, job.stocks);
  const Renumbering<Kit> kits("kit", then.kits, now.kits, job.kits);
  for (PlacementChange& one : change.placements)
    for (std::optional<Placement>* const placement : {&one.before, &one.after}) {
      if (!*placement) continue;
      if (!parts.same_shape((*placement)->part))
        return failure(ErrorCode::refuted,
                       fmt::format("part '{}' is another one now", parts.id((*placement)->part)));
      LEKALO_CHECK(parts((*placement)->part));
      LEKALO_CHECK(stocks((*placement)->stock));
    }
  for (FeatureChange& one : change.features) LEKALO_CHECK(stocks(one.stock));
  for (ItemChange<Kit>& one : change.job.kits)
    for (std::optional<Kit>* const kit : {&one.before, &one.after}) {
      if (!*kit) continue;
      for (KitPiece& piece : (*kit)->pieces) LEKALO_CHECK(parts(piece.part));
    }
  LEKALO_CHECK(parts(change.job.parts));
  LEKALO_CHECK(stocks(change.job.stocks));
  LEKALO_CHECK(kits(change.job.kits));
  return change;
}

}  // namespace lekalo::layout
