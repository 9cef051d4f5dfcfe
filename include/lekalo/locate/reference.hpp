#pragma once

#include <cstddef>
#include <cstdint>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/locate/placement.hpp"

namespace lekalo::locate {

/// Methods kept for comparison; neither proves anything. Their clearance is recomputed at the final pose and
/// rounded down like ours, however bad it is. docs/design/reference-methods.md tells what is the source's and
/// what had to be filled in.

enum class StartRule {
  random,          ///< the source's: position in the blank and angle in the window at random
  centroids,       ///< perimeter centroids aligned, angle at random
  principal_axes,  ///< centroids and principal axes of inertia of the outlines aligned: two angles, two
                   ///< starts at most
};

struct IpoptOptions {
  /// The number of feasible starts to optimise from, >= 1.
  int starts = 10;
  std::uint64_t seed = 0;
  StartRule start_rule = StartRule::random;
  /// In the full circle the angle is left free and folded back at the end.
  AngleWindow window;
  /// One unit of work is one start, feasible or rejected.
  RunControl run;
};

/// A draw is a feasible start when its homothety coefficient reaches 1 within this. IPOPT itself keeps
/// constraints to about 1e-8. A smaller value rejects good starts, and a larger one accepts starts from which
/// phi >= 0 cannot be reached.
inline constexpr double kHomothetyTolerance = 1e-6;
/// The method gives up finding feasible starts after this many draws for every start asked for.
inline constexpr int kDrawsPerStart = 10;
/// IPOPT gets n m constraints; above this number the request is refused (about 1 GB and minutes a start).
inline constexpr std::size_t kMaxIpoptConstraints = 250'000;

struct ReferenceResult {
  Placement best;
  /// For IPOPT the feasible starts that were optimised, for ICP the starts tried.
  int starts_done = 0;
  /// The draws whose homothety coefficient stayed below 1.
  int starts_rejected = 0;
  /// For IPOPT the iterations of all its runs, the feasible-start problems included; for ICP those of the
  /// start kept.
  std::uint64_t iterations = 0;
  /// For IPOPT: there was a feasible start; if not, `best` is the least bad pose seen. For ICP: the part does
  /// not stick out.
  bool found = false;
  /// The run that gave `best` ended by its own criterion (IPOPT: its tolerance; ICP: steps below 1e-10 of the
  /// blank's size), not by a limit.
  bool converged = false;
  /// For ICP the root mean square distance of the outline points from the part's lines, mm; else 0.
  double residual = 0;
};

/// The source's three stages: feasible starts by maximising the homothety coefficient lambda ((8)-(10) of the
/// article), a local maximum of phi from each by IPOPT ((5)-(7)), the best of them.
///
/// Deterministic for one build of IPOPT and its linear algebra on one processor: those choose their own
/// roundings. Stopped by request or budget it returns the best so far. Writes nothing and reads no option
/// file. Errors: usage for fewer than one start, a window with from > to or not finite, more than
/// kMaxIpoptConstraints constraints; environment when built without IPOPT. Cost: some ten iterations a start,
/// each with a factorisation for n m constraints: 8 ms (n m = 100) to 30 ms. Source: the localisation
/// article, (5)-(10) and its "general strategy"; Waechter and Biegler 2006 (IPOPT).
[[nodiscard]] Result<ReferenceResult> locate_ipopt(const geom::ConvexPolygon& part,
                                                   const geom::ConvexPolygon& blank,
                                                   const IpoptOptions& options);

struct IcpOptions {
  /// The angle is kept in the window at every step.
  AngleWindow window;
  /// Used when `has_start`.
  Placement start;
  /// Without a start, perimeter centroids and principal axes are aligned. Of the two angles (moved to the
  /// nearest end of the window when outside) the one with the smaller final residual is kept, the first when
  /// they are equal.
  bool has_start = false;
  int max_iterations = 100;  ///< of each start, >= 1
};

/// Point-to-line least squares: points of the blank's outline (its vertices, and between them at a step of at
/// most 1/360 of the perimeter) against the line of the nearest edge of the part, small-angle steps until
/// they vanish. What the trade uses, and what may cut into the part: the criterion does not see on which side
/// a point lies.
///
/// Deterministic. Errors: usage for a window with from > to or not finite, fewer than one iteration, or a
/// start that is not finite. Cost: O((n + 360) sqrt(m)) an iteration, some 10 to 100 iterations. Source: Besl
/// and McKay 1992 (iterative closest point); Chen and Medioni 1992 (distance to the tangent).
[[nodiscard]] Result<ReferenceResult> locate_icp(const geom::ConvexPolygon& part,
                                                 const geom::ConvexPolygon& blank, const IcpOptions& options);

}  // namespace lekalo::locate
