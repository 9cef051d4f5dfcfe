#include "json_form.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "decimal.hpp"

namespace lekalo::io::detail {

Result<void> expect_object(const Json& json, const std::string& where,
                           std::initializer_list<std::string_view> known) {
  if (!json.is_object()) return refuse(where, fmt::format("an object is needed, not {}", json.type_name()));
  for (const auto& item : json.items()) {
    if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
    return refuse(where,
                  fmt::format("unknown word \"{}\"; known here: {}", item.key(), fmt::join(known, ", ")));
  }
  return {};
}

Result<LengthUnit> unit_of(const Json& json, const std::string& name, std::optional<LengthUnit> said) {
  if (!json.contains("units")) return said.value_or(LengthUnit::millimetre);
  const Json& units = json["units"];
  if (!units.is_string())  // not printed: it may be brackets a million deep
    return refuse(name,
                  fmt::format("\"units\" is of type {}; \"mm\" and \"inch\" are known", units.type_name()));
  if (units != "mm" && units != "inch") {
    return refuse(name, fmt::format("\"units\" is {}; \"mm\" and \"inch\" are known",
                                    excerpt(units.get_ref<const std::string&>())));
  }
  const LengthUnit unit = units == "mm" ? LengthUnit::millimetre : LengthUnit::inch;
  if (said && *said != unit) {
    return refuse(
        name, fmt::format("the file says \"units\": {}, which contradicts the unit asked for", units.dump()));
  }
  return unit;
}

}  // namespace lekalo::io::detail
