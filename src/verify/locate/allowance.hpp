#pragma once

#include "outline.hpp"
#include "verify/number/exact.hpp"
#include "verify/number/interval.hpp"

namespace lekalo::verify {

/// A placement of the part: its point p goes to R(angle) p + shift.
struct Pose {
  Point shift;    ///< integer units
  Decimal angle;  ///< radians
};

/// Steps 3 and 4 of docs/design/verify.md: encloses the minimum allowance of the part at the pose, in integer
/// units.
///
/// In a convex blank that is the least signed distance of a part corner from the line of a blank edge,
/// positive on the left.
///
/// A blank that misses being convex (see Outline) has two cases. While the part surely lies inside, the
/// result is the distance between the two outlines, which stays true whatever the last digits do. When the
/// part may stick out, there is no one distance to speak of. The result then reaches from the allowance in
/// the hull with every edge moved in by its dent, which lies inside the blank, to the allowance in the hull,
/// which holds the blank.
///
/// Every pair is looked at in doubles first, and exact arithmetic decides between those that may be least.
/// Cost: (corners of the part) x (corners of the blank), about 1 ns each, and microseconds for each pair that
/// is nearly the least.
[[nodiscard]] Interval allowance(const Outline& blank, const Outline& part, const Pose& pose,
                                 Precision precision);

/// Encloses the signed distance of part point `v` at the pose from the line through `a` along `direction`, in
/// integer units. The blank's material is on the left of the line.
[[nodiscard]] Interval line_distance(const Point& v, const Point& a, const Point& direction, const Pose& pose,
                                     Precision precision);

/// Returns the number of bits that hold every product which the checker forms of such numbers, and 256 more.
[[nodiscard]] Precision working_precision(const Outline& blank, const Outline& part);

}  // namespace lekalo::verify
