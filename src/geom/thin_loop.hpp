#pragma once

#include <vector>

#include "piece.hpp"

namespace lekalo::geom::detail {

/// Says whether no disc of `radius` fits inside a closed chain of pieces that does not cross itself and has
/// its inside on the left. A yes is proved, up to `blur`, by which the pieces may be off; a no may be wrong.
///
/// A disc that fits can be moved until it touches the chain and then made smaller about the point where it
/// touches. So it is enough to look at discs of just this radius that touch a piece from inside, or a corner
/// that points inwards: none of them may be free of all other pieces. Their centres are a line or an arc, and
/// every other piece forbids intervals of it. Cost: O(n log n) for a thin chain.
[[nodiscard]] bool is_thin(const std::vector<Piece>& chain, double radius, double blur);

}  // namespace lekalo::geom::detail
