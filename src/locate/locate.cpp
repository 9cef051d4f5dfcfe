#include "lekalo/locate/locate.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "lekalo/geom/pose.hpp"

namespace lekalo::locate {
namespace {

constexpr double kConvexGap = 1e-9, kRegionGap = 1e-3;  ///< mm
constexpr std::uint64_t kRegionWork = 2'000'000;
/// Shapes of this many edges get all of that.
constexpr std::uint64_t kOrdinaryEdges = 1000;

std::uint32_t number_of(const std::vector<std::uint32_t>& numbers, std::uint32_t index) {
  return numbers.empty() ? index : numbers[index];
}

Contact numbered(Contact contact, const Problem& problem) {
  contact.part_vertex = number_of(problem.part.convex->vertex_numbers, contact.part_vertex);
  contact.blank_edge = number_of(problem.blank.convex->edge_numbers, contact.blank_edge);
  return contact;
}

Result<Found> by_angles(const Problem& problem, const Options& options) {
  const ConvexOutline &part = *problem.part.convex, &blank = *problem.blank.convex;
  Found found;
  AngleProof& proof = std::get<AngleProof>(found.proof);
  ConvexOptions search;
  search.gap = options.gap.value_or(kConvexGap);
  search.min_allowance = options.min_allowance;
  search.alternatives = options.alternatives;
  // The certificate comes through the sink, all of it.
  search.keep_certificate = false;
  search.certificate_sink = [&](const CertificateInterval& interval) {
    proof.intervals.push_back(interval);
    for (Contact& contact : proof.intervals.back().contacts) contact = numbered(contact, problem);
  };
  search.run = options.run;
  LEKALO_TRY(ConvexResult r, locate_convex({part.polygon, blank.polygon, problem.window,
                                            part.coordinate_error, blank.coordinate_error},
                                           search));
  found.status = r.status, found.best = r.best, found.work = r.work;
  found.upper_bound = r.upper_bound, found.shortfall = r.shortfall;
  for (const Contact& contact : r.contacts) {
    const Contact named = numbered(contact, problem);
    Touch& touch = found.contacts.emplace_back(touch_of(contact, part.polygon, blank.polygon, r.best));
    touch.part_edge = named.part_vertex, touch.blank_edge = named.blank_edge;
  }
  found.alternatives = std::move(r.alternatives);
  found.alternatives_complete = r.alternatives_complete;
  return found;
}

Result<Found> by_poses(const RegionProblem& shapes, const RegionOptions& search) {
  LEKALO_TRY(RegionResult r, locate_regions(shapes, search));
  Found found;
  found.status = r.status, found.best = r.best, found.mirrored = r.mirrored, found.work = r.work;
  found.upper_bound = r.upper_bound, found.shortfall = r.shortfall;
  found.contacts = std::move(r.contacts);
  found.proof = PoseProof{r.pivot, std::move(r.certificate), r.own_outline};
  return found;
}

Result<Found> by_demands(const Demands& demands, const RegionProblem& shapes, const RegionOptions& search) {
  Result<DemandResult> r = locate_demands({demands, shapes}, search);
  LEKALO_CHECK(r);
  Found found;
  found.status = r->status, found.best = r->best, found.mirrored = r->mirrored, found.work = r->work;
  found.shortfall = std::max(0.0, -r->margin);
  found.contacts = std::move(r->contacts);
  found.proof = PoseProof{r->proof.pivot, std::move(r->proof.certificate), OwnOutline::no};
  found.demands = std::move(*r);
  return found;
}

/// A unit of work looks at the edges of a shape, and shapes of more edges need more units to no end. So the
/// work that nobody has limited shrinks with the square of the edges.
std::uint64_t most_work(const RegionProblem& shapes, std::uint64_t asked) {
  if (asked != std::numeric_limits<std::uint64_t>::max()) return std::min(asked, kRegionWork);
  const std::uint64_t edges = geom::edges_in(shapes.part) + geom::edges_in(shapes.blank);
  if (edges <= kOrdinaryEdges) return kRegionWork;
  const double share = static_cast<double>(kOrdinaryEdges) / static_cast<double>(edges);
  return static_cast<std::uint64_t>(static_cast<double>(kRegionWork) * share * share) + 1;
}

}  // namespace

bool is_convex(const Problem& problem) noexcept {
  return problem.part.convex && problem.blank.convex && problem.mirror == Mirror::no && !problem.locked.x &&
         !problem.locked.y && !problem.demands;
}

Result<Found> locate(const Problem& problem, const Options& options) {
  if (is_convex(problem)) return by_angles(problem, options);
  if (options.alternatives)
    return failure(ErrorCode::usage, "alternatives are listed for convex outlines alone");
  const RegionProblem shapes{problem.part.regions,   problem.blank.regions,   problem.window, problem.mirror,
                             problem.part.tolerance, problem.blank.tolerance, problem.locked, {},
                             problem.one_file};
  RegionOptions search;
  search.gap = options.gap.value_or(kRegionGap);
  search.min_allowance = options.min_allowance;
  search.run = options.run;
  search.run.work_limit = most_work(shapes, options.run.work_limit);
  return problem.demands ? by_demands(*problem.demands, shapes, search) : by_poses(shapes, search);
}

}  // namespace lekalo::locate
