#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "refusal.hpp"

namespace lekalo::io::detail {

/// What the readers of the JSON forms of shapes share. `where` begins every message.

using Json = nlohmann::json;

/// Parses JSON in which no object says a key twice (the standard leaves open which one counts).
[[nodiscard]] Result<Json> parse_json(std::string_view bytes, const std::string& name);

/// Refuses values that are not objects, and words nobody here knows.
[[nodiscard]] Result<void> expect_object(const Json& json, const std::string& where,
                                         std::initializer_list<std::string_view> known);

/// The unit that the member "units" says, or else the user, or else millimetres.
[[nodiscard]] Result<LengthUnit> unit_of(const Json& json, const std::string& name,
                                         std::optional<LengthUnit> said);

}  // namespace lekalo::io::detail
