#pragma once

#include <string>
#include <utility>
#include <vector>

#include "support/json.hpp"

namespace lekalo::cases {

/// Layouts as files say them, put together by hand.

using Points = std::vector<std::pair<double, double>>;

inline Json loop_json(const Points& points) {
  Json list = Json::array();
  for (const auto& [x, y] : points) list.push_back({x, y});
  return list;
}
inline Json outline_json(const Points& outer, const std::vector<Points>& holes = {}) {
  Json polygon{{"outer", loop_json(outer)}};
  if (!holes.empty()) polygon["holes"] = Json::array();
  for (const Points& hole : holes) polygon["holes"].push_back(loop_json(hole));
  return {{"polygon", polygon}};
}
inline Points rectangle(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

/// A sheet "s" of 100 x 100, no parts, nothing placed.
inline Json empty_layout() {
  return {
      {"format", "lekalo-layout/1"},
      {"units", "mm"},
      {"stocks", {{{"id", "s"}, {"kind", "sheet"}, {"outline", outline_json(rectangle(0, 0, 100, 100))}}}},
      {"parts", Json::array()},
      {"placements", Json::array()}};
}
inline Json& add_part(Json& layout, const std::string& id, const Json& outline) {
  layout["parts"].push_back({{"id", id}, {"outline", outline}});
  return layout["parts"].back();
}
inline Json& place(Json& layout, const std::string& part, double x, double y, double degrees = 0) {
  layout["placements"].push_back(
      {{"part", part}, {"stock", "s"}, {"rotation_deg", degrees}, {"x", x}, {"y", y}});
  return layout["placements"].back();
}

}  // namespace lekalo::cases
