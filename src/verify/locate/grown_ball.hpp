#pragma once

#include <vector>

#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// Returns the radius, up to `wanted`, of a ball about c that surely lies in the grown part, and minus
/// infinity where c itself does not surely lie in it. The grown part holds the part's material, without a rim
/// along each side whose growth is negative, and all points that are no further from a side than its growth.
/// The radius may be too small, never too large.
///
/// The area that a side grows to ends in parallels of the side and in half circles about its ends. These, the
/// rims' parallels, and sides that do not grow hold the grown part's outline. So the ball is as large as the
/// least distance of a piece of them that is not covered: one that does not surely lie within another side's
/// growth, nor in the material. The nearest piece is looked at first, and halved where it is not covered.
[[nodiscard]] double grown_ball(const Shape& part, const std::vector<double>& growth, const Vec& c,
                                double wanted);

/// Returns a number that the distance of a point from the part less its rims, what lies within -growth of a
/// side with a negative one, does not exceed. Where there is a rim about the point it is that distance but
/// for rounding. It is infinite where there is no point of the part beside its rims, or none was found.
[[nodiscard]] double off_rims(const Shape& part, const std::vector<double>& growth, const Vec& p);

}  // namespace lekalo::verify
