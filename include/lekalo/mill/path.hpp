#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::mill {

/// One motion of the tool's tip. It begins where the motion before it ended.
struct PathMove {
  enum class Kind : std::uint8_t {
    rapid,   ///< above the stock
    plunge,  ///< straight down
    entry,   ///< down into material, on a helix or a ramp, and along the floor it left
    cut,
    slot,  ///< a cut in full material, where there is no room for anything else
    link,  ///< at depth, through what is cut already
    lead   ///< on to a wall or off it
  };
  Kind kind = Kind::cut;
  geom::Point to;
  /// The depth at the end of the motion. An arc that changes it is a piece of a helix.
  double z = 0;
  geom::EdgeKind shape = geom::EdgeKind::line;
  /// The centre of an arc, whose distances from both ends agree within 1e-6 mm. An arc is at most one full
  /// turn, and one that ends where it begins is a full turn.
  geom::Point centre = {};
  /// The feed of this motion, mm/min; 0 for the usual one of its kind.
  double feed = 0;
};

/// Motions in their order. The first is a rapid one, so that it may begin anywhere.
struct PocketPath {
  std::vector<PathMove> moves;
  /// The number of curves of equal arrival that were cut.
  std::size_t fronts = 0;
};

/// Returns the arc of a move that begins at `from`.
/// \pre its shape is no line
[[nodiscard]] inline geom::Edge arc_of(const PathMove& move, geom::Point from) {
  return {move.shape, from, move.to, move.centre};
}

}  // namespace lekalo::mill
