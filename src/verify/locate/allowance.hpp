#pragma once

#include "outline.hpp"
#include "verify/number/exact.hpp"
#include "verify/number/interval.hpp"

namespace lekalo::verify {

/// Part point p goes to R(angle) p + shift.
struct Pose {
  Point shift;    ///< integer units
  Decimal angle;  ///< radians
};

/// Encloses the minimum allowance of the part at the pose, integer units.
///
/// Convex blank: the least signed distance of a part corner from the line of a blank edge, left positive.
///
/// Blank that misses being convex (see Outline): while the part surely lies inside, the distance between the
/// two outlines, which is what remains true whatever the last digits do. When the part may stick out, there
/// is no one distance to speak of; the result then reaches from the allowance in the hull with every edge
/// moved in by its dent, which lies inside the blank, to the allowance in the hull, which holds the blank.
///
/// Every pair is looked at in doubles first; exact arithmetic decides between those that may be least.
/// Cost: (corners of the part) x (corners of the blank), about 1 ns each, and microseconds for each
/// near-minimal.
[[nodiscard]] Interval allowance(const Outline& blank, const Outline& part, const Pose& pose,
                                 Precision precision);

/// Encloses the signed distance of part point `v` at the pose from the line through `a` along `direction`
/// (the blank's material on its left), integer units.
[[nodiscard]] Interval line_distance(const Point& v, const Point& a, const Point& direction, const Pose& pose,
                                     Precision precision);

/// Bits that hold every product the checker forms of such numbers, and 256 beyond.
[[nodiscard]] Precision working_precision(const Outline& blank, const Outline& part);

}  // namespace lekalo::verify
