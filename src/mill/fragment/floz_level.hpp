#pragma once

#include <optional>

#include "lekalo/mill/pocket.hpp"

namespace lekalo::mill {

/// The source's path over one fragment of the places where the tool's middle may be. It goes straight down at
/// the start, or without one at the peak of the fragment's FLOZ model, and then on a spiral perpendicular to
/// the gradient until it would leave the model or the fragment. Nothing is promised of coverage or
/// engagement: from a start off the peak, what is higher stays. As level_path it goes from Z 0 to
/// -options.depth. bad_input for a start without a step inside.
[[nodiscard]] Result<PocketPath> floz_level(const geom::Region& fragment, const PocketOptions& options,
                                            std::optional<geom::Point> start = {});

}  // namespace lekalo::mill
