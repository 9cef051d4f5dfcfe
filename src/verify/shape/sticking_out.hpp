#pragma once

#include <limits>

#include "shape.hpp"

namespace lekalo::verify {

/// Encloses how far a placed part sticks out of its blank: the largest distance from the blank's outline of a
/// point of the part that is not in the blank, or 0 when there is none. The ends of the result are about
/// `tolerance` apart, or farther where 20,000 pieces, or looks at 4 million sides, do not suffice. The
/// search ends early once the part surely sticks out by more than `enough`, and then the high end is a rough
/// one.
///
/// The largest distance is found on the part's outline, or inside it where the distance has a local maximum.
/// There the nearest points of the blank are not all to one side. So the outline is bisected, each piece
/// bounded by its largest distance from any one side of the blank, and the inside is searched by squares that
/// may hold such a maximum.
[[nodiscard]] Span sticking_out(const Shape& placed_part, const Shape& blank, double tolerance,
                                double enough = std::numeric_limits<double>::infinity());

}  // namespace lekalo::verify
