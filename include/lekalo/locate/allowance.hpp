#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/locate/placement.hpp"

namespace lekalo::locate {

/// Measures of a placement that people read: allowance along the contour, deviation of probed points, and the
/// change against an earlier placement. Contours may have any shape, either direction, and hold millimetres;
/// points satisfy geom::is_exact. The placed part is taken at the doubles its vertices round to.
///
/// Distances are Euclidean, to the outline itself, within geom::kDistanceError * d of the exact ones, d
/// the largest coordinate difference involved; which side a point lies on is decided exactly. They are
/// measurements: what a placement guarantees is Placement::clearance (phi-function: distance to the *lines*
/// of the blank's edges, the same number inside a convex blank, of smaller size than the distance where the
/// part sticks out past a corner).

/// A point of the placed part's outline and the material over it.
struct AllowanceSample {
  geom::Point at;  ///< blank frame, mm
  /// The distance to the blank's outline, mm; negative where the part sticks out.
  double allowance = 0;
  /// The sample lies on the edge from this vertex of the part to the next.
  std::uint32_t part_edge = 0;
  /// The share of that edge before the sample, from 0 (its first vertex) to below 1.
  double along = 0;
};

/// A request for more samples than this is refused: 400 MB.
inline constexpr std::size_t kMaxAllowanceSamples = 10'000'000;

/// Returns the allowance at every vertex of the part and between them at equal distances of at most `step`
/// mm, in the part's order. A step of infinity gives the vertices alone. In a convex blank the least
/// allowance of the whole outline is then among them, because the distance to its outline is concave inside
/// it.
///
/// \pre part and blank have at least three points.
/// Errors: usage when step is not > 0 or asks for more than kMaxAllowanceSamples.
/// Cost: O(n log n + s log n) in practice, n blank edges, s samples.
[[nodiscard]] Result<std::vector<AllowanceSample>> contour_allowance(const geom::Ring& part,
                                                                     const geom::Ring& blank,
                                                                     const Placement& placement, double step);

/// Returns the signed distance of every probed point (blank frame) from the placed part's outline, mm, in the
/// order given. It is positive outside the part (material to remove), negative inside it (material is missing
/// there), 0 on it.
///
/// \pre part has at least three points.
/// Cost: O((n + m) log m) in practice, n points, m part edges: a million points against 60 edges in about
/// half a second.
[[nodiscard]] std::vector<double> deviations(const geom::Ring& probed, const geom::Ring& part,
                                             const Placement& placement);

/// The way from an earlier placement of a part to a new one.
struct PlacementShift {
  /// The shift of the part's origin, mm, new minus last.
  double dx = 0, dy = 0;
  double dtheta = 0;  ///< new minus last, radians, in (-pi, pi]
  /// The displacement of the vertex that moves most, mm; no point of the part moves more.
  double largest = 0;
  /// That vertex; of several the first.
  std::size_t vertex = 0;
};

/// \pre part has at least one point. Cost: O(m).
[[nodiscard]] PlacementShift placement_shift(const geom::Ring& part, const Placement& last,
                                             const Placement& now);

}  // namespace lekalo::locate
