#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/solid/mesh.hpp"

namespace lekalo::solid {

/// A closed surface through points that were measured on a body. It is a guess of how the body looks between
/// them, made to have small triangles; what it proves is said elsewhere (locate/guaranteed_solid.hpp).

struct PointSurfaceOptions {
  /// A ball of this radius that rolls over the points from outside does not fall through between them, mm,
  /// > 0. Gaps that it does not pass are bridged.
  double ball = 0;
  /// The level on which the body stands, mm: it is closed there by a flat floor, and points below are left
  /// out. Without it the points have to be all around.
  std::optional<double> floor = {};
  /// About the length of the edges, mm, > 0, but a third of the ball's radius at most; without it as fine as
  /// the points allow, and 300,000 triangles.
  std::optional<double> step = {};
};

struct PointSurface {
  /// Closed: every edge belongs to an even number of triangles. Corners are points given, but for those on
  /// the floor and off its rim, which lie exactly on its level.
  Mesh mesh;
  double step = 0;        ///< the side of the cells that were used, mm
  std::size_t below = 0;  ///< so many points lay below the floor
  /// False where the ball falls in between the points, so that hardly anything is inside.
  bool encloses = false;
};

/// Makes a surface (docs/design/solid.md has the method). Deterministic.
/// Fails with bad_input for less than four points and where they are spread too far for the cells; with usage
/// for numbers out of range. Cost: O(n log n) for n points, and the cells of a grid, at most 40 million of 9
/// bytes.
/// \param progress  in units of a hundredth of the whole; may be empty
[[nodiscard]] Result<PointSurface> surface_through(const std::vector<Vector>& points,
                                                   const PointSurfaceOptions& options,
                                                   const ProgressListener& progress = {});

/// The points, by their numbers, that have no other within a distance, mm. Cost: O(n log n) where no place
/// has very many points.
[[nodiscard]] std::vector<std::uint32_t> lonely_points(const std::vector<Vector>& points, double distance);

}  // namespace lekalo::solid
