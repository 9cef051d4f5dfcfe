#pragma once

#include <vector>

#include "piece.hpp"

namespace lekalo::geom::detail {

/// A chain is thin when no disc of `radius` fits inside it. It is a closed chain of pieces that does not
/// cross itself and has its inside on the left. A yes is proved, up to `blur`, what the pieces may be off; a
/// no may be wrong.
///
/// A disc that fits can be moved until it touches the chain and then made smaller about the point where it
/// touches. So it is enough that no disc of just this radius that touches a piece from inside, or a corner
/// that points inwards, is free of all other pieces: the centres of such discs are a line or an arc, and
/// every other piece forbids intervals of it. Cost: O(n log n) for a thin chain.
[[nodiscard]] bool is_thin(const std::vector<Piece>& chain, double radius, double blur);

}  // namespace lekalo::geom::detail
