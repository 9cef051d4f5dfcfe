#include "solid_deep.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lekalo/base/stop.hpp"
#include "solid_climb.hpp"
#include "spread.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::Vector;

/// So many contacts of one pose are looked at.
constexpr std::size_t kContactsOfAPose = 64;
/// So many points are looked at to see how deep a pose is.
constexpr std::size_t kLookedDeep = 20'000;
/// So many of the deepest become rows, and so many are kept of all poses; none that is less deep than this
/// part of the deepest.
constexpr std::size_t kDeepest = 8, kMostKept = 256;
constexpr double kDeepEnough = 0.75;
/// They are chosen of so many.
constexpr std::size_t kMostPlaces = 512;
/// Depths are measured to a 128th of the gap (SolidNear::slack).
constexpr double kNearGaps = 32;
/// A turn by so much, at the part's ends, about three axes bends a step by this and its square over the
/// reach.
constexpr double kBend = 1.5;

}  // namespace

SolidNear demanded(const SolidProblem& problem, double within) {
  SolidNear made;
  made.within = within;
  for (std::uint32_t t = 0; t < problem.part.triangles.size(); ++t)
    if (problem.demands.empty() || problem.demands[t]) made.triangles.push_back(t);
  return made;
}

Result<void> check_kept(const SolidPlacement& from, double least_margin) {
  if (from.inside && from.margin >= least_margin) return {};
  return failure(ErrorCode::usage,
                 fmt::format("a placement {} with a margin of {} mm does not keep one of {}",
                             from.inside ? "inside" : "that is not inside", from.margin, least_margin));
}

double room_for_turns(const SolidFrame& frame, double spare, double reach) {
  return std::min(0.5 * spare, kBend * reach * reach / frame.reach);
}

double most_turn_in(const SolidFrame& frame, double room) { return std::sqrt(room * frame.reach / kBend); }

DeepPoses::DeepPoses(const SolidProblem& problem, const SolidMeter& meter, double least_margin,
                     const SolidOptions& options)
    : meter_(meter),
      options_(options),
      least_(least_margin),
      near_(demanded(problem, kNearGaps * options.gap)),
      face_(near_, problem.part) {}

bool DeepPoses::ended() const { return options_.run.stop_requested() || work_ >= options_.run.work_limit; }

std::optional<DeepPose> DeepPoses::looked_at(const FramedPose& pose, double reach) {
  DeepPose made;
  const auto measured = measured_unless_stopped(meter_, pose, least_ + 2 * reach, kContactsOfAPose,
                                                options_.run, made.contacts);
  ++work_;
  if (!measured) return std::nullopt;
  if (pool_.add(made.contacts)) ++met_;
  if (!measured->inside || !(measured->value >= least_)) return std::nullopt;
  made.at = *measured;
  const Motion motion = meter_.frame().motion(pose);
  const auto found = unless_stopped<Farthest>(
      options_.run, [&] { return face_.at(meter_.clearance().blank(), motion, 0, kLookedDeep); });
  ++work_;
  if (!found) return std::nullopt;
  made.deepest = found->low;
  keep_deepest(*found);
  return made;
}

/// Keeps the deepest point, and of those that are nearly as deep some that lie apart from each other.
void DeepPoses::keep_deepest(const Farthest& found) {
  std::vector<std::size_t> order(found.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return found.points[a].far > found.points[b].far; });
  std::vector<Vector> places;
  for (const std::size_t k : order)
    if (found.points[k].far >= kDeepEnough * found.low && places.size() < kMostPlaces)
      places.push_back(found.points[k].part);
  for (const std::size_t k : spread(places, kDeepest)) {
    const FarPoint& point = found.points[order[k]];
    if (std::any_of(deep_.begin(), deep_.end(), [&](const FarPoint& o) { return o.part == point.part; }))
      continue;
    if (deep_.size() == kMostKept) deep_.erase(deep_.begin());
    deep_.push_back(point);
    ++met_;
  }
}

DeepRows DeepPoses::rows(const DeepPose& here) const {
  const SolidFrame& frame = meter_.frame();
  const Motion motion = frame.motion(here.at.pose);
  DeepRows made;
  for (const SolidContact& contact : contacts_at(meter_, here.at.pose, true, pool_, here.contacts))
    (contact.of_place() ? made.places : made.margins).push_back(row_of(frame, motion, contact));
  for (const FarPoint& one : deep_) {
    const FarPoint now = NearFace::point_at(meter_.clearance().blank(), motion, one.part, one.triangle);
    const Vector way = now.blank - now.placed;
    if (!(norm(way) > 0)) continue;
    SolidContact contact{now.part, now.blank, 1 / norm(way) * way};
    contact.distance = -now.far;
    made.depths.push_back(row_of(frame, motion, contact));
  }
  return made;
}

}  // namespace lekalo::locate
