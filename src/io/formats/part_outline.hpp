#pragma once

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::io {

struct PartOutline {
  layout::Outline outline;
  /// mm: outline and region lie within this of each other, both ways; 0 where the curves were kept.
  double loss = 0;
};

/// Returns a region as the outline of a part. Where chords beside its arcs meet although the arcs do not,
/// they are made finer. Where that does not help either, as at a crack that closes along a tangent, the part
/// becomes lines, with whatever is too narrow for the grid of layouts filled.
/// Fails as grid_region_of_curves where that would move the outline further than `most_loss`, mm.
[[nodiscard]] Result<PartOutline> outline_of_part(const geom::Region& region, double chord_tolerance,
                                                  double most_loss);

}  // namespace lekalo::io
