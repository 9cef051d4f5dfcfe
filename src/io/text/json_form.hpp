#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "json_tree.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/point.hpp"
#include "refusal.hpp"

namespace lekalo::io::detail {

/// Steps that the readers of regions, trees of shapes and features share. They leave at the first fault, and
/// `where` begins its sentence; readers of whole documents use JsonReader, which knows paths.

/// JSON's own word for a kind of value, for messages: "array".
[[nodiscard]] const char* json_word(JsonKind kind) noexcept;

/// Refuses values that are not objects, and words nobody here knows.
[[nodiscard]] Result<void> expect_object(JsonValue json, const std::string& where,
                                         std::initializer_list<std::string_view> known);

/// The value as a point [x, y]; nothing where it is no list of two numbers.
[[nodiscard]] std::optional<geom::Point> two_numbers(JsonValue json);

/// The unit that the member "units" says, or else the user, or else millimetres.
[[nodiscard]] Result<LengthUnit> unit_of(JsonValue json, const std::string& name,
                                         std::optional<LengthUnit> said);

}  // namespace lekalo::io::detail
