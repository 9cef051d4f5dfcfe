#pragma once

#include <variant>
#include <vector>

#include "lekalo/geom/point.hpp"
#include "lekalo/locate/convex.hpp"
#include "lekalo/locate/region.hpp"

namespace lekalo::locate {

/// The reason why no placement of convex outlines has more clearance: intervals of the angle, in ascending
/// order, that cover the window, each with three contacts that bound the clearance over it.
struct AngleProof {
  /// Empty when nothing is proved, or when the proof is kept elsewhere.
  std::vector<CertificateInterval> intervals;
};

/// The reason for regions: subdivisions of boxes of poses whose leaves are bounded by pairs of balls.
struct PoseProof {
  geom::Point pivot;  ///< part coordinates
  /// Empty when nothing is proved, or when the proof is kept elsewhere.
  std::vector<CoverTree> trees;
  /// The other reason: the part has the outline of the blank.
  OwnOutline own_outline = OwnOutline::no;
};

/// The kind says from which search a placement comes, also where the proof itself is not there.
using Proof = std::variant<AngleProof, PoseProof>;

}  // namespace lekalo::locate
