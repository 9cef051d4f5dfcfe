#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace lekalo::cases {

/// Layouts as files say them, put together by hand.

using LayoutJson = nlohmann::ordered_json;
using Points = std::vector<std::pair<double, double>>;

inline LayoutJson loop_json(const Points& points) {
  LayoutJson list = LayoutJson::array();
  for (const auto& [x, y] : points) list.push_back({x, y});
  return list;
}
inline LayoutJson outline_json(const Points& outer, const std::vector<Points>& holes = {}) {
  LayoutJson polygon{{"outer", loop_json(outer)}};
  if (!holes.empty()) polygon["holes"] = LayoutJson::array();
  for (const Points& hole : holes) polygon["holes"].push_back(loop_json(hole));
  return {{"polygon", polygon}};
}
inline Points rectangle(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

/// A sheet "s" of 100 x 100, no parts, nothing placed.
inline LayoutJson empty_layout() {
  return {
      {"format", "lekalo-layout/1"},
      {"units", "mm"},
      {"stocks", {{{"id", "s"}, {"kind", "sheet"}, {"outline", outline_json(rectangle(0, 0, 100, 100))}}}},
      {"parts", LayoutJson::array()},
      {"placements", LayoutJson::array()}};
}
inline LayoutJson& add_part(LayoutJson& layout, const std::string& id, const LayoutJson& outline) {
  layout["parts"].push_back({{"id", id}, {"outline", outline}});
  return layout["parts"].back();
}
inline LayoutJson& place(LayoutJson& layout, const std::string& part, double x, double y,
                         double degrees = 0) {
  layout["placements"].push_back(
      {{"part", part}, {"stock", "s"}, {"rotation_deg", degrees}, {"x", x}, {"y", y}});
  return layout["placements"].back();
}

}  // namespace lekalo::cases
