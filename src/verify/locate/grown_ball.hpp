#pragma once

#include <vector>

#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// Returns how large a ball about c lies in the part grown by `growth`: up to `wanted`, and never more than
/// the truth.
///
/// A point q of the ball that is not in the grown part lies beyond a side, on a straight line from c. That
/// side is grown by its own number. The sides beside it cover q as well, and cover more where they are grown
/// by more. So a stretch of a side whose own growth is not enough is looked at in pieces. For each piece, one
/// side's growth must reach all that lies beyond it within the ball.
///
/// \param growth  by how much each side is grown; where it is negative, a rim of that width is taken off
/// along the side
/// \pre c is surely in the part
[[nodiscard]] double grown_ball(const Shape& part, const std::vector<double>& growth, const Vec& c,
                                double wanted);

}  // namespace lekalo::verify
