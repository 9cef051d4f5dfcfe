#pragma once

#include "lekalo/base/error.hpp"
#include "lekalo/locate/solid.hpp"

namespace lekalo::locate {

/// Methods for solids that are kept for comparison; neither proves anything. Both stay in the window, and
/// what they find is measured like any placement, however bad it is. docs/design/reference-methods.md.

/// Point-to-plane least squares from the start: points spread evenly over the part's surface against the
/// plane of the blank's triangle that is nearest to each, small steps until they no longer help. The
/// criterion does not see on which side of the surface a point lies.
///
/// Refuses what place_solid refuses. Deterministic; single-threaded. A unit of work is one step. Source: Chen
/// and Medioni 1992 (distance to the tangent plane).
[[nodiscard]] Result<SolidPlacement> place_solid_icp(const SolidProblem& problem,
                                                     const SolidOptions& options);

/// The centres of volume are brought together, and the axes of inertia: of the four ways to do that, each
/// moved to the nearest pose of the window, the one is kept that has most clearance, or sticks out least.
///
/// Refuses what place_solid refuses, and with bad_input a solid without a volume. Deterministic. A unit of
/// work is one way.
[[nodiscard]] Result<SolidPlacement> place_solid_axes(const SolidProblem& problem,
                                                      const SolidOptions& options);

}  // namespace lekalo::locate
