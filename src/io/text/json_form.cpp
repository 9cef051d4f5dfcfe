#include "json_form.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "decimal.hpp"
#include "lekalo/base/joined_text.hpp"

namespace lekalo::io::detail {

const char* json_word(JsonKind kind) noexcept {
  switch (kind) {
    case JsonKind::null:
      return "null";
    case JsonKind::boolean:
      return "boolean";
    case JsonKind::integer:
    case JsonKind::number:
      return "number";
    case JsonKind::text:
      return "string";
    case JsonKind::list:
      return "array";
    case JsonKind::object:
      return "object";
  }
  return "?";
}

Result<void> expect_object(JsonValue json, const std::string& where,
                           std::initializer_list<std::string_view> known) {
  if (json.kind() != JsonKind::object)
    return refuse(where, fmt::format("an object is needed, not {}", json_word(json.kind())));
  for (const JsonValue item : json) {
    if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
    return refuse(where,
                  fmt::format("unknown word \"{}\"; known here: {}", item.key(), joined_text(known, ", ")));
  }
  return {};
}

std::optional<geom::Point> two_numbers(JsonValue json) {
  if (json.kind() != JsonKind::list || json.size() != 2) return std::nullopt;
  auto item = json.begin();
  const JsonValue x = *item, y = *++item;
  if (!x.is_number() || !y.is_number()) return std::nullopt;
  return geom::Point{x.number(), y.number()};
}

Result<LengthUnit> unit_of(JsonValue json, const std::string& name, std::optional<LengthUnit> said) {
  const auto units = json.find("units");
  if (!units) return said.value_or(LengthUnit::millimetre);
  if (units->kind() != JsonKind::text)  // not printed: it may be brackets a hundred deep
    return refuse(name, fmt::format("\"units\" is of type {}; \"mm\" and \"inch\" are known",
                                    json_word(units->kind())));
  if (units->text() != "mm" && units->text() != "inch")
    return refuse(name,
                  fmt::format("\"units\" is {}; \"mm\" and \"inch\" are known", excerpt(units->text())));
  const LengthUnit unit = units->text() == "mm" ? LengthUnit::millimetre : LengthUnit::inch;
  if (said && *said != unit)
    return refuse(name, fmt::format("the file says \"units\": \"{}\", which contradicts the unit asked for",
                                    units->text()));
  return unit;
}

}  // namespace lekalo::io::detail
