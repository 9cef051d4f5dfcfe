#pragma once

#include <variant>
#include <vector>

#include "lekalo/geom/point.hpp"
#include "lekalo/locate/convex.hpp"
#include "lekalo/locate/region.hpp"

namespace lekalo::locate {

/// Why no placement has more clearance, of convex outlines: intervals of the angle, in ascending order, that
/// cover the window, each with three contacts that bound the clearance over it.
struct AngleProof {
  std::vector<CertificateInterval> intervals;  ///< none: nothing is proved, or the proof is kept elsewhere
};

/// The same of regions: subdivisions of boxes of poses whose leaves are bounded by pairs of balls.
struct PoseProof {
  geom::Point pivot;             ///< part coordinates
  std::vector<CoverTree> trees;  ///< none: nothing is proved, or the proof is kept elsewhere
};

/// The kind says which search a placement comes from, also where the proof itself is not there.
using Proof = std::variant<AngleProof, PoseProof>;

}  // namespace lekalo::locate
