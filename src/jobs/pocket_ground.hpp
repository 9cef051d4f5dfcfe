#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/jobs/pocket.hpp"

namespace lekalo::jobs {

/// The same pockets for the path maker and for the checker.
struct PocketGround {
  /// The pockets, and what the tool stands on beyond their open edges.
  std::vector<geom::Region> extended;
  std::string document;  ///< region JSON of the pockets as drawn with their open edges, for the checker
};

/// Finds islands and open edges by the layers of the outline's edges. bad_input for a layer with no edge on
/// it, and for an island that lies in no pocket.
[[nodiscard]] Result<PocketGround> pocket_ground(const PocketOutline& outline, const PocketOptions& options);

}  // namespace lekalo::jobs
