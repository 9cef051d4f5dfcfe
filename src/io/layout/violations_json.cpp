#include <nlohmann/json.hpp>

#include "lekalo/io/layout/layout_messages.hpp"

namespace lekalo::io {
using Json = nlohmann::ordered_json;

std::string violations_json(const layout::Document& document,
                            const std::vector<layout::Violation>& violations) {
  Json list = Json::array();
  for (const layout::Violation& v : violations) {
    Json one{{"kind", name_of(v.kind)},
             {"a", v.a},
             {"b", v.b == 0 ? Json(nullptr) : Json(v.b)},
             {"stock", document.stocks[v.stock].id},
             {"copy", v.copy}};
    if (const std::string feature = feature_id(document, v); !feature.empty()) one["feature"] = feature;
    one["amount_mm"] = v.amount_mm;
    one["at"] = {v.at.x, v.at.y};
    one["direction"] = v.direction == geom::Point{} ? Json(nullptr) : Json{v.direction.x, v.direction.y};
    list.push_back(std::move(one));
  }
  return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lekalo::io
