#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/locate/placement.hpp"

namespace lekalo::locate {

/// Certified global localisation of a convex part in a convex blank:
///   maximise Phi(x, y, theta) over all x, y and theta in the window,
/// by branch and bound on theta. For a fixed angle the problem is a linear program in (x, y, phi) whose
/// matrix does not depend on the angle, so a dual basis (three contacts) found at one angle bounds every
/// angle by a sinusoid. docs/design/locate-convex.md has the bound, the error analysis and what failed.

struct ConvexProblem {
  geom::ConvexPolygon part, blank;
  AngleWindow window;
  /// Every coordinate may differ from the true one (the decimal in the file) by up to this, mm. The error is
  /// taken off the clearance and added to the upper bound.
  double part_coordinate_error = 0, blank_coordinate_error = 0;
};

/// Three contacts that bound the clearance for every angle in [from, to]. With the inward unit normals n and
/// anchors a of the three blank edges, and multipliers m >= 0, sum m = 1, sum m n = 0, no placement at angle
/// theta has more clearance than sum m n . (R(theta) v - a).
struct CertificateInterval {
  double from = 0, to = 0;  ///< radians
  std::array<Contact, 3> contacts;
};

struct ConvexOptions {
  /// The search stops when upper bound - clearance is this small, mm, > 0.
  double gap = 1e-9;
  /// The status is infeasible when this is provably not reachable, mm.
  double min_allowance = 0;
  /// If it is set, the other local maxima whose clearance is within this of the best are listed too, mm.
  std::optional<double> alternatives;
  bool keep_certificate = true;
  /// The result keeps at most this many intervals; the others go to `certificate_sink` alone.
  std::size_t certificate_limit = 10'000;
  /// Called with every interval, in ascending order of angle, once the search has ended; may be empty.
  std::function<void(const CertificateInterval&)> certificate_sink;
  /// One unit of work is one linear program.
  RunControl run;
};

struct ConvexResult {
  Status status = Status::stopped;
  /// The best placement. Its clearance is rounded down, so that an exact recheck never finds less.
  Placement best;
  /// No placement in the window has more clearance; rounded up.
  double upper_bound = 0;
  double shortfall = 0;  ///< max(0, min_allowance - clearance)
  /// The tight pairs, which hold the best placement.
  std::vector<Contact> contacts;
  std::vector<CertificateInterval> certificate;
  std::uint64_t certificate_size = 0;
  std::vector<Placement> alternatives;
  bool alternatives_complete = true;
  std::uint64_t work = 0;  ///< linear programs solved
};

/// Searches the whole window. It never fails for a valid problem: a window with from > to, a gap that is not
/// positive or a value that is not finite give ErrorCode::usage. Deterministic; single-threaded. Cost: about
/// 25 linear programs of 3 variables where the optimum is a sharp peak; grows to O(1/sqrt(gap)) where the
/// clearance is flat in the angle (near-round shapes). Memory is bounded by the certificate kept.
[[nodiscard]] Result<ConvexResult> locate_convex(const ConvexProblem& problem, const ConvexOptions& options);

/// Returns the contact at a placement: the vertex, and the foot of its perpendicular on the line of the
/// blank's edge.
[[nodiscard]] Touch touch_of(const Contact& contact, const geom::ConvexPolygon& part,
                             const geom::ConvexPolygon& blank, const Placement& placement);

}  // namespace lekalo::locate
