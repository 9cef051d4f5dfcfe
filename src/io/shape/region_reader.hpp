#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/json_form.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::io::detail {

/// The finite point [x, y] under `key`, times `scale`.
[[nodiscard]] Result<geom::Point> read_point(const Json& json, const std::string& where, const char* key,
                                             double scale);

/// The region of an object with "outer" and "holes" or "islands", coordinates times `scale`.
/// \param open  if given, gets the edges with `"open": true`, as they are written; else the word is refused
[[nodiscard]] Result<geom::Region> read_region(const Json& json, const std::string& where, double scale,
                                               std::vector<geom::Edge>* open = nullptr);

}  // namespace lekalo::io::detail
