#pragma once

#include "lekalo/mill/pocket.hpp"

namespace lekalo::mill {

/// The source's path over one fragment of the places where the tool's middle may be: straight down at the
/// peak of its FLOZ model, and a spiral perpendicular to the gradient until it would leave the model or the
/// fragment. Nothing is said of coverage or engagement. As level_path from Z 0 to -options.depth.
[[nodiscard]] Result<PocketPath> floz_level(const geom::Region& fragment, const PocketOptions& options);

}  // namespace lekalo::mill
