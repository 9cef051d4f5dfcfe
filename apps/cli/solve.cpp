#include "solve.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "interrupt.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/rounding.hpp"
#include "lekalo/phi/convex.hpp"

namespace lekalo::cli {
namespace {

constexpr double kConvexGap = 1e-9;  ///< mm

}  // namespace

/// Angles in radians that hold the window in degrees for certain: the product is within 2^-51 of the exact
/// one.
locate::AngleWindow window_of(const LocateOptions& options) {
  if (options.window_from_deg == 0 && options.window_to_deg == 360) return {};
  constexpr double kBound = 0x1p-51;
  const double from = options.window_from_deg * kDegree;
  const double to = options.window_to_deg * kDegree;
  return {from - kBound * std::abs(from), to + kBound * std::abs(to)};
}

const char* name_of(locate::Status status) {
  switch (status) {
    case locate::Status::optimal:
      return "optimal";
    case locate::Status::stopped:
      return "stopped";
    case locate::Status::infeasible:
      return "infeasible";
  }
  return "";
}

namespace {

/// Contacts in polygon indices to contacts in the indices of the result document.
class ResultIndices {
 public:
  ResultIndices(const Contour& part, const Contour& blank) : part_(part), blank_(blank) {}
  void convert(locate::Contact& contact) const {
    contact.part_vertex = part_.vertex_in_result[contact.part_vertex];
    contact.blank_edge = blank_.edge_in_result[contact.blank_edge];
  }

 private:
  const Contour& part_;
  const Contour& blank_;
};

Result<Solution> solve_certified(const Contour& part, const Contour& blank, const LocateOptions& options,
                                 const RunControl& run) {
  const ResultIndices indices(part, blank);
  Solution solution;
  locate::ConvexOptions search;
  search.gap = options.gap.value_or(kConvexGap);
  search.min_allowance = options.min_allowance;
  search.alternatives = options.alternatives;
  search.keep_certificate = false;  // all of it comes through the sink
  search.certificate_sink = [&](const locate::CertificateInterval& interval) {
    solution.certificate.push_back(interval);
    for (locate::Contact& contact : solution.certificate.back().contacts) indices.convert(contact);
  };
  search.run = run;
  const Result<locate::ConvexResult> found = locate::locate_convex(
      {part.polygon, blank.polygon, window_of(options), part.coordinate_error, blank.coordinate_error},
      search);
  if (!found) return tl::unexpected(found.error());
  solution.status = name_of(found->status);
  solution.best = found->best;
  solution.upper_bound = found->upper_bound;
  solution.shortfall = found->shortfall;
  solution.polygon_contacts = found->contacts;
  solution.contacts = found->contacts;
  for (locate::Contact& contact : solution.contacts) indices.convert(contact);
  solution.alternatives = found->alternatives;
  solution.alternatives_complete = found->alternatives_complete;
  solution.work = found->work;
  return solution;
}

/// `unproved`: such a method says nothing about other placements, whether it ran to its end or not.
Result<Solution> reference_solution(const Result<locate::ReferenceResult>& found, const Contour& part,
                                    const Contour& blank, double min_allowance) {
  if (!found) return tl::unexpected(found.error());
  Solution solution;
  solution.status = "unproved";
  solution.best = found->best;
  solution.best.clearance = safe_clearance(part, blank, found->best);
  solution.shortfall = std::max(0.0, difference_rounded_up(min_allowance, solution.best.clearance));
  return solution;
}

Result<Solution> solve_ipopt(const Contour& part, const Contour& blank, const LocateOptions& options,
                             const RunControl& run) {
  locate::IpoptOptions search;
  search.starts = options.starts;
  search.seed = options.seed;
  search.start_rule = options.start_rule;
  search.window = window_of(options);
  search.run = run;
  const Result<locate::ReferenceResult> found = locate::locate_ipopt(part.polygon, blank.polygon, search);
  Result<Solution> solution = reference_solution(found, part, blank, options.min_allowance);
  if (!solution) return solution;
  solution->work = static_cast<std::uint64_t>(found->starts_done + found->starts_rejected);
  const bool budget_spent = solution->work >= options.work && found->starts_done < options.starts;
  if (run.stop_requested() || budget_spent) solution->status = "stopped";
  return solution;
}

Result<Solution> solve_icp(const Contour& part, const Contour& blank, const LocateOptions& options) {
  locate::IcpOptions search;
  search.window = window_of(options);
  const Result<locate::ReferenceResult> found = locate::locate_icp(part.polygon, blank.polygon, search);
  Result<Solution> solution = reference_solution(found, part, blank, options.min_allowance);
  if (solution) solution->work = found->iterations;
  return solution;
}

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

}  // namespace

double safe_clearance(const Contour& part, const Contour& blank, const locate::Placement& placement) {
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

Result<Solution> solve(const Contour& part, const Contour& blank, const LocateOptions& options) {
  const StopRequests stop(options.seconds);
  ProgressLine line("searching");
  RunControl run;
  run.stop = stop.flag();
  run.progress = [&line](const Progress& progress) { line.show(progress); };
  run.work_limit = options.work;
  const auto start = std::chrono::steady_clock::now();
  Result<Solution> solution = [&] {
    switch (options.method) {
      case Method::ipopt:
        return solve_ipopt(part, blank, options, run);
      case Method::icp:
        return solve_icp(part, blank, options);
      case Method::certified:
        break;
    }
    return solve_certified(part, blank, options, run);
  }();
  if (solution) {
    solution->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return solution;
}

}  // namespace lekalo::cli
