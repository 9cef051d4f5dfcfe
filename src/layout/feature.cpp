#include "lekalo/layout/feature.hpp"

#include <algorithm>
#include <map>

namespace lekalo::layout {
namespace {

Feature feature_of(const Defect& defect) {
  return {FeatureKind::defect, defect.id, defect.severity, defect.outline};
}
Feature feature_of(const QualityZone& zone) {
  return {FeatureKind::zone, zone.id, zone.quality, zone.outline};
}
void become(Defect& defect, const Feature& feature) { defect = {feature.id, feature.grade, feature.outline}; }
void become(QualityZone& zone, const Feature& feature) {
  zone = {feature.id, feature.grade, feature.outline};
}

template <class List>
std::optional<std::uint32_t> place_in(const List& list, std::string_view id) noexcept {
  const auto at = std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.id == id; });
  if (at == list.end()) return std::nullopt;
  return static_cast<std::uint32_t>(at - list.begin());
}

template <class List>
FeaturePlace put_in(List& list, std::uint32_t index, const Feature& feature) {
  const auto known = place_in(list, feature.id);
  const auto at = known.value_or(std::min(index, static_cast<std::uint32_t>(list.size())));
  if (!known) list.emplace(list.begin() + at);
  become(list[at], feature);
  return {at, !known};
}

/// Adds the changes from one list of features to another. Features that stay keep their order; where somebody
/// has put them in another order, none counts as staying.
template <class List>
void add_differences(std::uint32_t stock, const List& from, const List& to, std::vector<FeatureChange>& all) {
  if (from == to) return;
  std::map<std::string_view, std::uint32_t> places;
  for (std::uint32_t i = 0; i < from.size(); ++i) places.emplace(from[i].id, i);
  std::vector<bool> stays(from.size(), false);
  bool in_order = true;
  std::uint32_t next = 0;
  for (const auto& one : to) {
    const auto known = places.find(one.id);
    if (known == places.end()) continue;
    in_order = in_order && known->second >= next;
    next = known->second + 1;
    stays[known->second] = true;
  }
  for (std::uint32_t i = static_cast<std::uint32_t>(from.size()); i-- > 0;)
    if (!in_order || !stays[i]) all.push_back({stock, i, feature_of(from[i]), std::nullopt});
  for (std::uint32_t i = 0; i < to.size(); ++i) {
    const auto known = places.find(to[i].id);
    if (!in_order || known == places.end())
      all.push_back({stock, i, std::nullopt, feature_of(to[i])});
    else if (!(from[known->second] == to[i]))
      all.push_back({stock, i, feature_of(from[known->second]), feature_of(to[i])});
  }
}

}  // namespace

std::string_view name_of(FeatureKind kind) noexcept {
  return kind == FeatureKind::defect ? "defect" : "zone";
}

std::size_t feature_count(const Stock& stock, FeatureKind kind) noexcept {
  return kind == FeatureKind::defect ? stock.defects.size() : stock.zones.size();
}

Feature feature_at(const Stock& stock, FeatureKind kind, std::uint32_t index) {
  return kind == FeatureKind::defect ? feature_of(stock.defects[index]) : feature_of(stock.zones[index]);
}

std::optional<std::uint32_t> find_feature(const Stock& stock, FeatureKind kind,
                                          std::string_view id) noexcept {
  return kind == FeatureKind::defect ? place_in(stock.defects, id) : place_in(stock.zones, id);
}

FeaturePlace put_feature(Stock& stock, std::uint32_t index, const Feature& feature) {
  return feature.kind == FeatureKind::defect ? put_in(stock.defects, index, feature)
                                             : put_in(stock.zones, index, feature);
}

void take_feature(Stock& stock, FeatureKind kind, std::uint32_t index) {
  if (kind == FeatureKind::defect)
    stock.defects.erase(stock.defects.begin() + index);
  else
    stock.zones.erase(stock.zones.begin() + index);
}

std::vector<FeatureChange> feature_difference(const Document& from, const Document& to) {
  std::vector<FeatureChange> all;
  for (std::uint32_t i = 0; i < from.stocks.size(); ++i) {
    add_differences(i, from.stocks[i].defects, to.stocks[i].defects, all);
    add_differences(i, from.stocks[i].zones, to.stocks[i].zones, all);
  }
  return all;
}

}  // namespace lekalo::layout
