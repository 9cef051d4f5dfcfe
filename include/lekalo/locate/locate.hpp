#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/locate/demand.hpp"
#include "lekalo/locate/outline.hpp"
#include "lekalo/locate/proof.hpp"

namespace lekalo::locate {

/// Certified global localisation: where does the part lie best in the blank, and why is no placement better?
/// The searches beneath are locate_convex, locate_regions and locate_demands.

struct Problem {
  Outline part, blank;
  AngleWindow window;
  Mirror mirror = Mirror::no;
  LockedShift locked;
  std::optional<Demands> demands;
  /// As in RegionProblem.
  bool one_file = false;
};

struct Options {
  /// The search stops when upper bound - clearance is this small, mm, > 0. Without a value it is 1e-9 for
  /// convex outlines and 1e-3 for others.
  std::optional<double> gap;
  /// The status is infeasible when this is provably not reachable, mm.
  double min_allowance = 0;
  /// Only convex outlines have this: if it is set, the other local maxima whose clearance is within this of
  /// the best are listed too, mm.
  std::optional<double> alternatives;
  /// The unit of work is that of the search beneath. Regions stop by themselves after 2,000,000 units, which
  /// are some minutes and some gigabytes; without a limit here those of more than 1,000 edges do so after
  /// fewer, as the square of their edges grows.
  RunControl run;
};

struct Found {
  Status status = Status::stopped;
  /// The best placement. Its clearance is rounded down, so that an exact recheck never finds less.
  Placement best;
  bool mirrored = false;
  /// No placement in the window has more clearance; rounded up. Without a value the bound is that of the
  /// demands' margin.
  std::optional<double> upper_bound;
  /// The part of the minimum allowance, or of the demands, that is missing, mm.
  double shortfall = 0;
  /// The contacts that hold the best placement.
  std::vector<Touch> contacts;
  /// The proof of the bound. Contacts in it have the outlines' numbers.
  Proof proof;
  std::vector<Placement> alternatives;
  bool alternatives_complete = true;
  /// The findings about the demands. Their certificate has moved to `proof`, their contacts to `contacts`.
  std::optional<DemandResult> demands;
  std::uint64_t work = 0;
};

/// Says whether the fast path takes the problem: two convex outlines, and nothing asked for but the clearance
/// of a part that is not mirrored and may be shifted anywhere.
[[nodiscard]] bool is_convex(const Problem& problem) noexcept;

/// Chooses the search: the fast path where is_convex says so, else that of regions, with demands if there are
/// any. Errors and costs are those of the searches; ErrorCode::usage for alternatives without the fast path.
/// \pre outlines that the fast path does not take have regions
[[nodiscard]] Result<Found> locate(const Problem& problem, const Options& options);

}  // namespace lekalo::locate
