#pragma once

#include <cstddef>

#include "lekalo/field/grid.hpp"
#include "lekalo/mill/pocket.hpp"

namespace lekalo::mill {

/// The source's function of the pockets on a grid: the FLOZ models of the convex fragments joined by
/// R-disjunctions (their borders stay visible), or with options.whole one model of all. 0 on the outlines,
/// positive inside. The grid has `nodes` nodes along its longer side, and a margin of a twentieth.
/// Errors are those of ContourModel and convex_fragments.
/// \pre options.method is one of the source's, nodes > 1
[[nodiscard]] Result<field::FieldGrid> floz_field(const std::vector<geom::Region>& pockets,
                                                  const PocketOptions& options, std::size_t nodes);

}  // namespace lekalo::mill
