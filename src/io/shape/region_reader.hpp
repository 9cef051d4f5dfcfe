#pragma once

#include <string>
#include <vector>

#include "io/text/json_form.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::io::detail {

/// The finite point [x, y] under `key`, times `scale`.
[[nodiscard]] Result<geom::Point> read_point(JsonValue json, const std::string& where, const char* key,
                                             double scale);

/// The region of an object with "outer" and "holes" or "islands", coordinates times `scale`.
/// \param open  if given, gets the edges with `"open": true`, as they are written; else the word is refused
[[nodiscard]] Result<geom::Region> read_region(JsonValue json, const std::string& where, double scale,
                                               std::vector<geom::Edge>* open = nullptr);

/// The edges of a list that need not close, in mm.
[[nodiscard]] Result<geom::Contour> read_chain(JsonValue json, const std::string& where);

}  // namespace lekalo::io::detail
