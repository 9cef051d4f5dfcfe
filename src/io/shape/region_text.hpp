#pragma once

#include <string>

#include "lekalo/geom/region.hpp"

namespace lekalo::io::detail {

/// An edge of the JSON form of regions, on one line; numbers are the shortest decimals of their doubles.
[[nodiscard]] std::string edge_text(const geom::Edge& edge);
/// A region, on one line.
[[nodiscard]] std::string region_text(const geom::Region& region);

}  // namespace lekalo::io::detail
