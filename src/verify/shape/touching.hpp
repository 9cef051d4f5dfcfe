#pragma once

#include "shape.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {

/// An exact placement without rotation: x is mirrored if asked for, then the part is shifted.
struct ExactShift {
  Decimal x, y;
  bool mirrored = false;
};

struct Touch {
  /// True when the part surely lies in the blank.
  bool inside = false;
  /// True when it also touches the blank's outline, so that its clearance is exactly 0. Says nothing of a
  /// part that is not inside.
  bool touches = false;
};

/// Step 9 of docs/design/verify.md: says whether a part that touches its blank's outline surely lies in the
/// blank all the same, so that its clearance is 0 and not less. Enclosures cannot tell that from sticking out
/// by next to nothing. So sides that touch are computed with fractions of the written decimals, and only
/// those that do not touch with enclosures.
///
/// The answer is no when the part does not lie in the blank, and also when that is not shown: where an arc
/// touches whose ends do not lie on one circle about its centre exactly, or where points next to a stretch in
/// common are too near to others.
/// \pre shapes without a fault (fault_of), as written
///
/// This is why it is enough. Sides are cut wherever they touch, and two sides that cross inside both mean a
/// no. Then (1) every stretch of the part's outline lies inside the blank, or on the blank's outline with
/// both materials on the same hand, so the blank's material surrounds it on the part's side; (2) no stretch
/// of the blank's outline lies inside the part. By (2) each connected piece of the part's inside lies in the
/// blank or outside it altogether, and by (1) it lies in the blank next to its outline.
[[nodiscard]] Touch touches_from_inside(const Shape& part, const Shape& blank, const ExactShift& shift);

}  // namespace lekalo::verify
