#pragma once

#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {

/// Places of the tool's middle.
struct Places {
  explicit Places(std::vector<geom::Region> given) : regions(std::move(given)), index(regions) {}
  std::vector<geom::Region> regions;
  geom::RegionIndex index;  ///< of them
};

/// One piece of the places where the tool's middle may be, divided as step 1 of docs/design/pocket.md says.
/// Fronts go through the fields, which keep a strip off the walls and are rounded in corners; loops go
/// through corridors, which are too narrow to be fields.
struct Piece {
  double tool_radius = 0;  ///< mm
  double strip = 0;        ///< mm between the fields and the walls
  Places allowed;          ///< all of it
  Places fields;           ///< near lines and arcs for short edges: not exact
  Places narrow;           ///< corridors, and some of what they lead to
};

/// Divides a piece by at most four offsets and three Booleans. Errors: as geom::offset and geom::combine.
/// \param allowed  where the tool's middle may be: one piece
/// \param cleared  where other tools have been; the fields hold it
[[nodiscard]] Result<Piece> find_fields(const geom::Region& allowed, double tool_radius,
                                        const std::vector<geom::Region>& cleared);

}  // namespace lekalo::mill
