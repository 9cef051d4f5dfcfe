#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lekalo/base/stop.hpp"
#include "lekalo/locate/solid_criterion.hpp"
#include "solid_climb.hpp"
#include "solid_placement.hpp"
#include "solid_rows.hpp"
#include "spread.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::Vector;

constexpr int kMostLargestSteps = 100;
/// So many contacts of one pose are looked at.
constexpr std::size_t kContactsOfAPose = 64;
/// So many points are looked at to see how deep a pose is, and to say how deep the last one is.
constexpr std::size_t kLookedDeep = 20'000, kLookedDeepAtLast = 2'000'000;
/// So many of the deepest become rows, and so many are kept of all poses; none that is less deep than this
/// part of the deepest.
constexpr std::size_t kDeepest = 8, kMostKept = 256;
constexpr double kDeepEnough = 0.75;
/// They are chosen of so many.
constexpr std::size_t kMostPlaces = 512;
/// So many times the deepest is near enough to tell, if the last digits would take many points. A checker is
/// told so much more, and more where they do, since it looks at as many points to see the same.
constexpr double kNearlyDeepest = 1 + 1.0 / 128, kToldLarger = 1 + 1.0 / 1024, kToldMuchLarger = 1 + 1.0 / 64;
/// Margins count so many times more than depths, and a program is solved so many times to find how they
/// compare.
constexpr double kMarginWeight = 0x1p12;
constexpr int kRounds = 4;
/// A turn by so much, at the part's ends, about three axes bends a step by this and its square over the
/// reach.
constexpr double kBend = 1.5;
/// A smaller box of steps that promises this part of what the larger one does is as good; so many are tried.
constexpr double kAsGood = 0.9;
constexpr int kMostHalves = 8;
/// The first steps go up to this part of the depth.
constexpr double kFirstReach = 1.0 / 16;
/// Depths are measured to a 128th of the gap (SolidNear::slack).
constexpr double kNearGaps = 32;
/// It goes on while a step promises this part of the gap.
constexpr double kWorthAStep = 1.0 / 128;
/// Distances are rounded by less than this part of the coordinates.
constexpr double kDepthRounding = 0x1p-44;
/// The square root of 3, rounded up: how far a point is off at most for each of its coordinates.
constexpr double kDiagonalOfACube = 1.7321;

/// The triangles that have a demand. How near they are to be says how well their distances are looked for.
SolidNear demanded(const SolidProblem& problem, double within) {
  SolidNear made;
  made.within = within;
  for (std::uint32_t t = 0; t < problem.part.triangles.size(); ++t)
    if (problem.demands.empty() || problem.demands[t]) made.triangles.push_back(t);
  return made;
}

/// A pose that is allowed, and how deep it lies.
struct DeepPose {
  MeasuredSolid at;
  double deepest = 0;
  std::vector<SolidContact> contacts;
};

/// The rows of a pose: how deep points lie, as numbers below 0, with what holds the place; and how much
/// margins have over what is aimed at.
struct Program {
  std::vector<LinearBound<6>> rows, margins;
  /// All of them, where a margin that is just kept counts as `level`.
  [[nodiscard]] std::vector<LinearBound<6>> lifted(double level) const {
    std::vector<LinearBound<6>> all = rows;
    for (const LinearBound<6>& margin : margins) all.push_back({margin.slope, margin.level + level});
    return all;
  }
};

/// The steps from one allowed pose to the next.
class Descent {
 public:
  Descent(const SolidProblem& problem, const SolidMeter& meter, double least_margin,
          const SolidOptions& options)
      : meter_(meter),
        options_(options),
        least_(least_margin),
        near_(demanded(problem, kNearGaps * options.gap)),
        face_(near_, problem.part) {}

  /// Returns the best pose that steps lead to, or none where `from` is not allowed.
  std::optional<FramedPose> from(const FramedPose& from, double widest) {
    std::optional<DeepPose> here = looked_at(from, widest);
    if (!here) return std::nullopt;
    Trust trust{std::min(widest, here->deepest)};
    // A step that is too long in freedoms that do not matter yet ends where nothing small helps.
    trust.reach *= kFirstReach;
    spare_ = here->at.value - least_;
    for (int step = 0; step < kMostLargestSteps && !ended(); ++step) {
      if (options_.run.progress)
        options_.run.progress({work_, static_cast<double>(step) / kMostLargestSteps});
      const double room = room_of(trust.reach);
      const LinearSolution<6> solution = smallest_step(*here, room, trust.reach);
      const double hoped = solution.bound + here->deepest;
      if (!(hoped > kWorthAStep * options_.gap)) {
        if (room <= kWorthAStep * options_.gap) break;
        // The room for the turn may be in the way; shorter ones need less.
        trust.reach *= 0.25;
        continue;
      }
      const std::size_t known = met_;
      std::optional<DeepPose> there = looked_at(meter_.frame().moved(here->at.pose, solution.z), trust.reach);
      if (there && there->deepest < here->deepest) {
        trust.was_better(here->deepest - there->deepest, hoped, met_ > known);
        here = std::move(there);
      } else {
        trust.was_no_better(met_ > known);
      }
    }
    return here->at.pose;
  }
  [[nodiscard]] std::uint64_t work() const noexcept { return work_; }

 private:
  [[nodiscard]] bool ended() const {
    return options_.run.stop_requested() || work_ >= options_.run.work_limit;
  }

  /// Measures at a pose, and learns what it meets there. Nothing where the pose is not allowed, or a stop was
  /// asked for.
  std::optional<DeepPose> looked_at(const FramedPose& pose, double reach) {
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
  void keep_deepest(const Farthest& found) {
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

  /// So much more margin than what is kept is aimed at, mm: a turn bends by that what is linear in a step.
  [[nodiscard]] double room_of(double reach) const {
    return std::min(0.5 * spare_, kBend * reach * reach / meter_.frame().reach);
  }

  /// Solves the program in the smallest of some boxes of steps that promises nearly as much as the one up to
  /// `reach`, which becomes its size. In a larger one, freedoms that change nothing go to its ends.
  [[nodiscard]] LinearSolution<6> smallest_step(const DeepPose& here, double room, double& reach) const {
    const Program program = program_at(here, least_ + room);
    const double most_turn = std::sqrt(room * meter_.frame().reach / kBend);
    const auto solved = [&](double half) {
      Steps steps = meter_.frame().trusted(half);
      for (std::size_t k = 3; k < 6; ++k) steps[k] = std::min(steps[k], most_turn);
      // A margin that is just kept counts as the depth that is hoped for, which is not known before.
      LinearSolution<6> solution;
      double hoped = here.deepest;
      for (int round = 0; round < kRounds; ++round) {
        solution = solve_cell(program.lifted(hoped - here.deepest), steps);
        hoped = std::max(0.0, solution.bound + here.deepest);
      }
      return solution;
    };
    LinearSolution<6> best = solved(reach);
    const double enough = kAsGood * (best.bound + here.deepest);
    if (!(enough > 0)) return best;
    for (int k = 0; k < kMostHalves; ++k) {
      const LinearSolution<6> smaller = solved(0.5 * reach);
      if (!(smaller.bound + here.deepest >= enough)) break;
      best = smaller, reach *= 0.5;
    }
    return best;
  }

  [[nodiscard]] Program program_at(const DeepPose& here, double aim) const {
    const SolidFrame& frame = meter_.frame();
    const Motion motion = frame.motion(here.at.pose);
    Program made;
    for (const SolidContact& contact : contacts_at(meter_, here.at.pose, true, pool_, here.contacts)) {
      LinearBound<6> row = row_of(frame, motion, contact);
      if (contact.of_place()) {
        made.rows.push_back(row);
        continue;
      }
      row.level = kMarginWeight * (row.level - aim);
      for (double& slope : row.slope) slope *= kMarginWeight;
      made.margins.push_back(row);
    }
    for (const FarPoint& one : deep_) {
      const FarPoint now = NearFace::point_at(meter_.clearance().blank(), motion, one.part, one.triangle);
      const Vector way = now.blank - now.placed;
      if (!(norm(way) > 0)) continue;
      SolidContact contact{now.part, now.blank, 1 / norm(way) * way};
      contact.distance = -now.far;
      made.rows.push_back(row_of(frame, motion, contact));
    }
    return made;
  }

  const SolidMeter& meter_;
  const SolidOptions& options_;
  double least_, spare_ = 0;
  SolidNear near_;
  NearFace face_;
  ContactPool pool_;
  std::vector<FarPoint> deep_;
  std::size_t met_ = 0;  ///< counts what was new
  std::uint64_t work_ = 0;
};

}  // namespace

double largest_allowance(const SolidProblem& problem, const SolidPose& pose) {
  const solid::TriangleTree blank(problem.blank);
  const Motion motion = motion_of(pose);
  double far = 1 + norm(motion.shift);
  for (const solid::Mesh* mesh : {&problem.part, &problem.blank})
    for (const Vector p : mesh->vertices) far = std::max(far, norm(p));
  const SolidNear all = demanded(problem, 1);
  const NearFace face(all, problem.part);
  Farthest found = face.at(blank, motion, 0, kLookedDeep);
  double told = kToldLarger * found.high;
  if (found.high > kNearlyDeepest * found.low) {
    for (double enough = kNearlyDeepest * found.low;
         found.high > enough && found.points.size() < kLookedDeepAtLast;
         enough = kNearlyDeepest * std::max(enough, found.low))
      found = face.at(blank, motion, enough, kLookedDeepAtLast);
    told = kToldMuchLarger * found.high;
  }
  return told + kDepthRounding * far +
         kDiagonalOfACube * (problem.part_coordinate_error + problem.blank_coordinate_error);
}

Result<SolidPlacement> smallest_largest(const SolidProblem& problem, const SolidPlacement& from,
                                        double least_margin, const SolidOptions& options) {
  LEKALO_CHECK(check(problem, options));
  if (!from.inside || !(from.margin >= least_margin))
    return failure(ErrorCode::usage,
                   fmt::format("a placement {} with a margin of {} mm does not keep one of {}",
                               from.inside ? "inside" : "that is not inside", from.margin, least_margin));
  const RunControl nobody;
  const Listening to_the_end(nobody);
  const SolidMeter meter(problem, frame_of(problem), options.threads);
  Descent descent(problem, meter, least_margin, options);
  const auto best =
      descent.from(framed(meter.frame(), from.pose), 0.5 * std::max(problem.shift, options.gap));
  SolidPlacement made = from;
  if (best) made = placement(meter, *best);
  const bool keeps = made.inside && made.margin >= least_margin;
  if (!keeps || !(largest_allowance(problem, made.pose) < largest_allowance(problem, from.pose)))
    made = from;
  else
    made.contacts = holding_contacts(meter, {*best, made.margin, true}, options.gap);
  made.work = from.work + descent.work();
  return made;
}

}  // namespace lekalo::locate
