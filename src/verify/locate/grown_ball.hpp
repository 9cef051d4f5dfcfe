#pragma once

#include <vector>

#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// How large a ball about c lies in the part grown by `growth`: up to `wanted`, never more than the truth.
///
/// A point q of the ball that is not in the grown part lies beyond a side, on a straight line from c. The
/// side itself is grown by its own number; what else covers q is what the sides beside it are grown by, which
/// is more where those have a larger one. So a stretch of a side whose own growth is not enough is looked at
/// in pieces: each with all that lies beyond it within the ball in reach of one side's growth.
///
/// \param growth  of each side; negative: a rim of that width along it is taken off
/// \pre c is surely in the part
[[nodiscard]] double grown_ball(const Shape& part, const std::vector<double>& growth, const Vec& c,
                                double wanted);

}  // namespace lekalo::verify
