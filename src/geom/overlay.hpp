#pragma once

#include "arrangement.hpp"
#include "lekalo/geom/boolean.hpp"
#include "planar_map.hpp"

namespace lekalo::geom::detail {

/// Returns the regions of all points whose winding numbers `keep` accepts; it must refuse all zeros. The
/// promises of boolean.hpp about results, errors and failure hold.
[[nodiscard]] Result<BooleanResult> overlay(const Outlines& outlines, KeepRule keep,
                                            double operand_error = 0);

}  // namespace lekalo::geom::detail
