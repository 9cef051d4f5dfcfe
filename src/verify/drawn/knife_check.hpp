#pragma once

#include <vector>

#include "drawn_file.hpp"
#include "lekalo/verify/claims.hpp"

namespace lekalo::verify {

/// Holds what the pen of CUT does with a knife against the contours of parts: the tip is nowhere farther from
/// them than the tolerance, and they are nowhere farther from where it was. A drag knife makes one stroke for
/// each contour; its tip is followed by the law of a blade that trails behind its axis. A tangential knife is
/// lifted at every corner that is sharper than its words say.
///
/// \param strokes  in the order of the plot
/// Cost: O(length / tolerance) where a blade turns, and a logarithm.
void check_knife(const std::vector<const DrawnLine*>& strokes, const std::vector<const DrawnLine*>& contours,
                 const KnifeWords& words, ClaimReport& report);

}  // namespace lekalo::verify
