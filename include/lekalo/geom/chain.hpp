#pragma once

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

/// Checks edges in a row that need not close, as make_region does but for the area: each begins where the one
/// before ends, and a full circle is alone. Fails likewise, with "edge" and its number. Cost: O(edges).
[[nodiscard]] Result<Contour> make_chain(Contour edges);

}  // namespace lekalo::geom
