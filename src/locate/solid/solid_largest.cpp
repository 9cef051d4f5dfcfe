#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"
#include "lekalo/locate/solid_criterion.hpp"
#include "solid_climb.hpp"
#include "solid_deep.hpp"
#include "solid_placement.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::Vector;

constexpr int kMostLargestSteps = 100;
/// So many points are looked at to say how deep a pose is.
constexpr std::size_t kLookedDeepAtFirst = 20'000, kLookedDeepAtLast = 2'000'000;
/// So many times the deepest is near enough to tell, if the last digits would take many points. A checker is
/// told so much more, and more where they do, since it looks at as many points to see the same.
constexpr double kNearlyDeepest = 1 + 1.0 / 128, kToldLarger = 1 + 1.0 / 1024, kToldMuchLarger = 1 + 1.0 / 64;
/// Margins count so many times more than depths, and a program is solved so many times to find how they
/// compare.
constexpr double kMarginWeight = 0x1p12;
constexpr int kRounds = 4;
/// A smaller box of steps that promises this part of what the larger one does is as good; so many are tried.
constexpr double kAsGood = 0.9;
constexpr int kMostHalves = 8;
/// The first steps go up to this part of the depth.
constexpr double kFirstReach = 1.0 / 16;
/// It goes on while a step promises this part of the gap.
constexpr double kWorthAStep = 1.0 / 128;
/// Distances are rounded by less than this part of the coordinates.
constexpr double kDepthRounding = 0x1p-44;
/// The square root of 3, rounded up: how far a point is off at most for each of its coordinates.
constexpr double kDiagonalOfACube = 1.7321;

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
        poses_(problem, meter, least_margin, options) {}

  /// Returns the best pose that steps lead to, or none where `from` is not allowed.
  std::optional<FramedPose> from(const FramedPose& from, double widest) {
    std::optional<DeepPose> here = poses_.looked_at(from, widest);
    if (!here) return std::nullopt;
    Trust trust{std::min(widest, here->deepest)};
    // A step that is too long in freedoms that do not matter yet ends where nothing small helps.
    trust.reach *= kFirstReach;
    spare_ = here->at.value - least_;
    for (int step = 0; step < kMostLargestSteps && !poses_.ended(); ++step) {
      if (options_.run.progress)
        options_.run.progress({poses_.work(), static_cast<double>(step) / kMostLargestSteps});
      const double room = room_for_turns(meter_.frame(), spare_, trust.reach);
      const LinearSolution<6> solution = smallest_step(*here, room, trust.reach);
      const double hoped = solution.bound + here->deepest;
      if (!(hoped > kWorthAStep * options_.gap)) {
        if (room <= kWorthAStep * options_.gap) break;
        // The room for the turn may be in the way; shorter ones need less.
        trust.reach *= 0.25;
        continue;
      }
      const std::size_t known = poses_.met();
      std::optional<DeepPose> there =
          poses_.looked_at(meter_.frame().moved(here->at.pose, solution.z), trust.reach);
      if (there && there->deepest < here->deepest) {
        trust.was_better(here->deepest - there->deepest, hoped, poses_.met() > known);
        here = std::move(there);
      } else {
        trust.was_no_better(poses_.met() > known);
      }
    }
    return here->at.pose;
  }
  [[nodiscard]] std::uint64_t work() const noexcept { return poses_.work(); }

 private:
  /// Solves the program in the smallest of some boxes of steps that promises nearly as much as the one up to
  /// `reach`, which becomes its size. In a larger one, freedoms that change nothing go to its ends.
  [[nodiscard]] LinearSolution<6> smallest_step(const DeepPose& here, double room, double& reach) const {
    const Program program = program_at(here, least_ + room);
    const double most_turn = most_turn_in(meter_.frame(), room);
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
    DeepRows rows = poses_.rows(here);
    Program made{std::move(rows.places), std::move(rows.margins)};
    for (LinearBound<6>& margin : made.margins) {
      margin.level = kMarginWeight * (margin.level - aim);
      for (double& slope : margin.slope) slope *= kMarginWeight;
    }
    made.rows.insert(made.rows.end(), rows.depths.begin(), rows.depths.end());
    return made;
  }

  const SolidMeter& meter_;
  const SolidOptions& options_;
  double least_, spare_ = 0;
  DeepPoses poses_;
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
  Farthest found = face.at(blank, motion, 0, kLookedDeepAtFirst);
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
  LEKALO_CHECK(check_kept(from, least_margin));
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
