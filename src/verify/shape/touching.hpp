#pragma once

#include "shape.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {

/// A placement without rotation: x is mirrored if asked for, then the part is shifted. Exact.
struct ExactShift {
  Decimal x, y;
  bool mirrored = false;
};

struct Touch {
  bool inside = false;   ///< the part surely lies in the blank
  bool touches = false;  ///< and touches its outline: its clearance is 0 exactly
};

/// The answer says whether a part that touches its blank's outline surely lies in the blank all the same: its
/// clearance is 0 then, not less. Enclosures cannot tell that from sticking out by next to nothing, so what
/// touches is computed with fractions of the written decimals, and only what does not touch with enclosures.
///
/// Not inside when it does not lie there, and when that is not shown: where an arc touches whose ends do not
/// lie on one circle about its centre exactly, or where points next to a stretch in common are too near to
/// others. \pre shapes without a fault (fault_of), as written
///
/// Why that is enough. Sides are cut wherever they touch; two that cross inside both refuse. Then (1) every
/// stretch of the part's outline lies inside the blank, or on the blank's outline with both materials on the
/// same hand, so the blank's material surrounds it on the part's side; (2) no stretch of the blank's outline
/// lies inside the part. By (2) each connected piece of the part's inside lies in the blank or outside it
/// altogether; by (1) next to its outline it lies in the blank.
[[nodiscard]] Touch touches_from_inside(const Shape& part, const Shape& blank, const ExactShift& shift);

}  // namespace lekalo::verify
