#include "locate_search.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/rounding.hpp"
#include "lekalo/phi/convex.hpp"

namespace lekalo::jobs {
namespace {

/// How many times further than the ends of its edges a line of the blank moves, at most, at points up to
/// `outside` mm out of the blank.
double edge_lever(const geom::ConvexPolygon& blank, double outside) {
  const geom::Box box = geom::bounds(blank.vertices());
  const double reach = geom::norm(box.high - box.low) + outside;
  double shortest = reach;
  for (std::size_t k = 0; k < blank.size(); ++k) {
    shortest = std::min(shortest, geom::norm(blank[blank.next(k)] - blank[k]));
  }
  return 1 + 2 * reach / shortest;
}

/// `unproved`: such a method says nothing about other placements, whether it ran to its end or not.
Search unproved(const locate::ReferenceResult& r, const locate::Problem& problem, double min_allowance) {
  Search search{"unproved", {}, 0};
  search.found.best = r.best;
  search.found.best.clearance = safe_clearance(*problem.part.convex, *problem.blank.convex, r.best);
  search.found.shortfall = std::max(0.0, difference_rounded_up(min_allowance, search.found.best.clearance));
  return search;
}

Result<Search> by_ipopt(const locate::Problem& problem, const LocateOptions& o, const RunControl& run) {
  LEKALO_TRY(const locate::ReferenceResult r,
             locate::locate_ipopt(problem.part.convex->polygon, problem.blank.convex->polygon,
                                  {o.starts, o.seed, o.start_rule, problem.window, run}));
  Search search = unproved(r, problem, o.min_allowance);
  search.found.work = static_cast<std::uint64_t>(r.starts_done + r.starts_rejected);
  const bool budget_spent = search.found.work >= run.work_limit && r.starts_done < o.starts;
  if (run.stop_requested() || budget_spent) search.status = "stopped";
  return search;
}

Result<Search> by_icp(const locate::Problem& problem, const LocateOptions& o) {
  locate::IcpOptions how;
  how.window = problem.window;
  LEKALO_TRY(const locate::ReferenceResult r,
             locate::locate_icp(problem.part.convex->polygon, problem.blank.convex->polygon, how));
  Search search = unproved(r, problem, o.min_allowance);
  search.found.work = r.iterations;
  return search;
}

Result<Search> certified(const locate::Problem& problem, const LocateOptions& o, const RunControl& run) {
  LEKALO_TRY(locate::Found found, locate::locate(problem, {o.gap, o.min_allowance, o.alternatives, run}));
  return Search{io::name_of(found.status), std::move(found), 0};
}

}  // namespace

double safe_clearance(const locate::ConvexOutline& part, const locate::ConvexOutline& blank,
                      const locate::Placement& placement) {
  const double low =
      phi::clearance_enclosure(part.polygon, blank.polygon, placement.x, placement.y, placement.theta).low;
  // Points within e of the true ones in each coordinate are within sqrt(2) e of them, and so is every
  // boundary point: the clearance of a part inside changes by no more than this. Of a part outside it is the
  // distance to the line of an edge, which the ends of a short edge may turn.
  constexpr double kMoreThanDiagonal = 1.5;
  const double lever = low >= 0 ? 1 : edge_lever(blank.polygon, std::abs(low));
  const double errors = kMoreThanDiagonal * (part.coordinate_error + lever * blank.coordinate_error);
  // Decimals in the result are the shortest that read back, half a unit in the last place off the doubles.
  const double arm = 2 * geom::largest_coordinate(part.polygon.vertices());
  const double written = 0x1p-53 * (std::abs(placement.x) + std::abs(placement.y) + std::abs(low) +
                                    std::abs(placement.theta) * arm);
  return difference_rounded_down(low, errors + written);
}

Result<Search> searched(const locate::Problem& problem, const LocateOptions& options, const RunControl& run,
                        const Stopwatch& stopwatch) {
  const auto now = [&] { return stopwatch ? stopwatch() : 0; };
  const double start = now();
  Result<Search> search = options.method == LocateMethod::ipopt ? by_ipopt(problem, options, run)
                          : options.method == LocateMethod::icp ? by_icp(problem, options)
                                                                : certified(problem, options, run);
  if (search) search->seconds = now() - start;
  return search;
}

}  // namespace lekalo::jobs
