#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "contour_ring.hpp"
#include "lekalo/verify/claims.hpp"

namespace lekalo::verify {

/// A stretch of a contour that is cut down to the bottom, without its lead.
struct ContourStretch {
  std::size_t line = 0;
  Strokes edges;
};

/// A joint between the ends of two stretches: the rectangle from the middle of the kerf out into the sheet,
/// as wide as the joint and half a kerf and the joint's width deep.
struct FoundJoint {
  std::size_t line = 0;  ///< of the stretch before it
  std::array<Place, 4> corners;
};

/// The joints of a contour, and what is wrong with them.
struct FoundJoints {
  std::vector<FoundJoint> joints;
  std::vector<std::string> findings;
};

/// Joins each stretch to the one whose beginning is nearest to its end: there has to be a joint of the stated
/// width, and each stretch has to follow one other. All of the contour has to be cut but for the joints,
/// which is looked at every millimetre. \param name   of the contour, for messages \param slack  what a cut
/// may be off half a kerf from the contour
[[nodiscard]] FoundJoints joints_of_contour(const std::vector<ContourStretch>& stretches,
                                            const ContourRing& contour, bool is_hole, const std::string& name,
                                            const ProfileWords& words, double slack);

/// True when no kerf along this piece, nor the disc of a pierce there, enters the joint.
[[nodiscard]] bool leaves_joint(const Stroke& piece, double radius, const FoundJoint& joint);

}  // namespace lekalo::verify
