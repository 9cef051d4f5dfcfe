#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::io::detail {

/// What the readers of the JSON forms of shapes share. `where` begins every message.

using Json = nlohmann::json;

[[nodiscard]] tl::unexpected<Error> refuse(const std::string& where, const std::string& why);

/// Parses JSON in which no object says a key twice (the standard leaves open which one counts).
[[nodiscard]] Result<Json> parse_json(std::string_view bytes, const std::string& name);

/// Refuses values that are not objects, and words nobody here knows.
[[nodiscard]] Result<void> expect_object(const Json& json, const std::string& where,
                                         std::initializer_list<std::string_view> known);

/// The unit that the member "units" says, or else the user, or else millimetres.
[[nodiscard]] Result<LengthUnit> unit_of(const Json& json, const std::string& name,
                                         std::optional<LengthUnit> said);

/// The finite point [x, y] under `key`, times `scale`.
[[nodiscard]] Result<geom::Point> read_point(const Json& json, const std::string& where, const char* key,
                                             double scale);

/// The region of an object with "outer" and "holes" or "islands", coordinates times `scale`.
/// \param open  if given, gets the edges with `"open": true`, as they are written; else the word is refused
[[nodiscard]] Result<geom::Region> read_region(const Json& json, const std::string& where, double scale,
                                               std::vector<geom::Edge>* open = nullptr);

}  // namespace lekalo::io::detail
