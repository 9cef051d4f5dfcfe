#pragma once

#include <cstdint>
#include <optional>

#include "placed_solid.hpp"

namespace lekalo::verify {

/// A triangle on which a surface goes through itself, and where.
struct SelfCrossing {
  Near3 place{};
  std::uint32_t triangle{};
};

/// How a closed surface goes through itself.
struct SelfCrossings {
  /// One where an edge runs through another triangle's inside, exactly.
  std::optional<SelfCrossing> first;
  /// One where inside changes sides: at two places of one sheet of the surface balls as thick as `depth`
  /// touch it from both sides and nothing else, and inside is before it at the one and behind it at the
  /// other.
  std::optional<SelfCrossing> changing;
  double depth = 0;      ///< mm
  bool complete = true;  ///< all triangles that can meet were looked at
};

/// Whatever is inside by the odd count, no body has its material now before and now behind one sheet of its
/// surface. Sheets that are nowhere `depth` apart, as where facets fold by a rounding, hide nothing.
/// \pre the mesh is closed
[[nodiscard]] SelfCrossings self_crossings(const PlacedSolid& body);

}  // namespace lekalo::verify
