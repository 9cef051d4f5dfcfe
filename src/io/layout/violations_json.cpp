#include "lekalo/io/layout/layout_messages.hpp"
#include "lekalo/io/text/json_writer.hpp"

namespace lekalo::io {

void write_violations(JsonWriter& json, const layout::Document& document,
                      const std::vector<layout::Violation>& violations) {
  json.list(violations, [&](const layout::Violation& v) {
    json.begin_object().fields({{"kind", name_of(v.kind)}, {"a", v.a}});
    v.b == 0 ? json.field("b", nullptr) : json.field("b", v.b);
    json.fields({{"stock", document.stocks[v.stock].id}, {"copy", v.copy}});
    if (const std::string feature = feature_id(document, v); !feature.empty()) json.field("feature", feature);
    json.field("amount_mm", v.amount_mm);
    json.key("at").list({v.at.x, v.at.y});
    json.key("direction");
    if (v.direction == geom::Point{})
      json.value(nullptr);
    else
      json.list({v.direction.x, v.direction.y});
    json.end();
  });
}

std::string violations_json(const layout::Document& document,
                            const std::vector<layout::Violation>& violations) {
  JsonWriter json(JsonLayout::compact);
  write_violations(json, document, violations);
  return json.take();
}

}  // namespace lekalo::io
