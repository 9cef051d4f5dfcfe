#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/locate/placement.hpp"

namespace lekalo::locate {

/// Methods kept for comparison; neither proves anything. Their clearance is recomputed at the final pose and
/// rounded down like ours, however bad it is.

enum class StartRule {
  random,          ///< the source's: position in the blank and angle in the window at random
  centroids,       ///< perimeter centroids aligned, angle at random
  principal_axes,  ///< centroids and principal axes of inertia of the outlines aligned (two angles)
};

struct IpoptOptions {
  int starts = 10;
  std::uint64_t seed = 0;
  StartRule start_rule = StartRule::random;
  AngleWindow window;
  RunControl run;  ///< one unit of work is one start
};

struct ReferenceResult {
  Placement best;
  int starts_done = 0;        ///< feasible starts that were optimised
  int starts_rejected = 0;    ///< draws whose homothety coefficient stayed below 1
  std::uint64_t iterations = 0;
  bool found = false;         ///< false: no feasible start; `best` is then the least bad pose seen
};

/// The source's three stages: feasible starts by maximising the homothety coefficient lambda ((8)-(10) of the
/// article), a local maximum of phi from each by IPOPT ((5)-(7)), the best of them.
/// ErrorCode::environment when built without IPOPT.
[[nodiscard]] Result<ReferenceResult> locate_ipopt(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank,
                                                   const IpoptOptions& options);

struct IcpOptions {
  AngleWindow window;            ///< the start angle is the window's middle, or `start.theta`
  Placement start;               ///< used when `has_start`
  bool has_start = false;        ///< else perimeter centroids and principal axes are aligned
  int max_iterations = 100;
};

/// Point-to-line least squares: blank outline points against the nearest line of the part's outline, iterated.
/// What the trade uses, and what may cut into the part.
[[nodiscard]] Result<ReferenceResult> locate_icp(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank,
                                                 const IcpOptions& options);

}  // namespace lekalo::locate
