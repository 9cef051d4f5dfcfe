#include "lekalo/locate/solid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/locate/solid_at.hpp"
#include "solid_climb.hpp"
#include "solid_placement.hpp"
#include "solid_search.hpp"
#include "solid_start.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::Vector;

/// A climb goes on while it gains this much, mm.
constexpr double kClimbGain = 1e-5;

bool finite(Vector v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

double first_trust(const SolidProblem& problem) { return 0.5 * std::max(problem.shift, 1e-3); }

/// Gives the window its rotations.
void set_turns(SolidFrame& frame, SolidFreedom freedom, double turn) {
  const bool all = turn == SolidProblem::kAllTurns;
  const geom::SinCos half = geom::sincos(0.5 * turn);
  const double most = all ? 1 : half.sine / half.cosine;
  Vector x;
  if (freedom == SolidFreedom::six) x = {most, most, most};
  if (freedom == SolidFreedom::c_xyz) x.z = most;
  if (all && freedom == SolidFreedom::six) frame.charts = {0, 1, 2, 3};
  if (all && freedom == SolidFreedom::c_xyz) frame.charts = {0, 3};
  frame.window.low.x = -x, frame.window.high.x = x;
}

Result<void> check_demands(const SolidProblem& problem) {
  const auto& demands = problem.demands;
  if (demands.size() != problem.part.triangles.size())
    return failure(ErrorCode::usage, fmt::format("there are {} demands for the part's {} triangles",
                                                 demands.size(), problem.part.triangles.size()));
  for (const auto& demand : demands)
    if (demand &&
        (!(demand->minimum >= 0) || !(demand->minimum <= limits::kLargestCoordinate) ||
         !(demand->scale >= 1 / limits::kLargestFactor) || !(demand->scale <= limits::kLargestFactor)))
      return failure(
          ErrorCode::usage,
          fmt::format("a demand of {} mm in units of {} makes no sense: the minimum must be a number "
                      "from 0 to {:g}, the scale one from {:g} to {:g}",
                      demand->minimum, demand->scale, limits::kLargestCoordinate, 1 / limits::kLargestFactor,
                      limits::kLargestFactor));
  if (std::none_of(demands.begin(), demands.end(), [](const auto& demand) { return demand.has_value(); }))
    return failure(ErrorCode::usage, "all of the part is as cast, so nothing is to be maximised");
  return {};
}

Result<void> check_targets(const SolidProblem& problem) {
  if (!problem.targets.empty() && problem.targets.size() != problem.part.triangles.size())
    return failure(ErrorCode::usage, fmt::format("there are {} targets for the part's {} triangles",
                                                 problem.targets.size(), problem.part.triangles.size()));
  for (const auto& target : problem.targets)
    if (target && !(*target >= 0 && *target <= limits::kLargestCoordinate))
      return failure(ErrorCode::usage, fmt::format("a target of {} mm must be a number from 0 to {:g}",
                                                   *target, limits::kLargestCoordinate));
  return {};
}

Result<void> check_datums(const std::vector<SolidDatum>& datums) {
  for (const SolidDatum& datum : datums) {
    const double length = datum.on == SolidDatum::On::point ? 1 : norm(datum.direction);
    if (datum.points.empty() || !(datum.within > 0) || !(datum.within <= limits::kLargestCoordinate) ||
        !(std::abs(length - 1) < 1e-9) || !finite(datum.at))
      return failure(ErrorCode::usage,
                     fmt::format("a datum with {} points within {} mm makes no sense: it must have points, a "
                                 "tolerance above 0 up to {:g} mm, a place, and a direction of length 1",
                                 datum.points.size(), datum.within, limits::kLargestCoordinate));
  }
  return {};
}

Result<void> check_nears(const SolidProblem& problem) {
  const std::size_t triangles = problem.part.triangles.size();
  for (const SolidNear& near : problem.nears)
    if (near.triangles.empty() || !(near.rim >= 0) || !(near.rim <= limits::kLargestCoordinate) ||
        !(near.within > 0) || !(near.within <= limits::kLargestCoordinate) ||
        std::any_of(near.triangles.begin(), near.triangles.end(),
                    [&](std::uint32_t t) { return t >= triangles; }))
      return failure(
          ErrorCode::usage,
          fmt::format(
              "{} triangles of the part's {} that are to be within {} mm of the blank's surface make no "
              "sense: there must be some, all of the part, and the distance above 0 up to {:g} mm",
              near.triangles.size(), triangles, near.within, limits::kLargestCoordinate));
  const std::optional<CutPart> cut = CutPart::of(problem);
  if (!cut || std::any_of(cut->demands().begin(), cut->demands().end(),
                          [](const auto& demand) { return demand.has_value(); }))
    return {};
  return failure(ErrorCode::bad_input,
                 "nothing that demands an allowance is left beside the finished faces and their rims; "
                 "make the rims narrower");
}

}  // namespace

Result<void> check(const SolidProblem& problem, const SolidOptions& options) {
  if (problem.part.triangles.empty() || problem.blank.triangles.empty())
    return failure(ErrorCode::bad_input, "part and blank must have triangles");
  if (!(options.gap > 0) || !std::isfinite(options.gap))
    return failure(ErrorCode::usage, fmt::format("gap {} mm must be a positive number", options.gap));
  if (!std::isfinite(options.min_allowance))
    return failure(ErrorCode::usage, "minimum allowance is not a finite number");
  if (!(problem.shift >= 0) || !(problem.shift <= limits::kLargestCoordinate))
    return failure(ErrorCode::usage,
                   fmt::format("a window of shifts by up to {} mm must be a number from 0 to {:g}",
                               problem.shift, limits::kLargestCoordinate));
  if (!(problem.turn >= 0) || (!(problem.turn <= 0.5 * kPi) && problem.turn != SolidProblem::kAllTurns))
    return failure(
        ErrorCode::usage,
        fmt::format("a window of turns by up to {} rad must lie between 0 and a quarter turn, or be "
                    "half a turn, which is all of them",
                    problem.turn));
  for (const double error : {problem.part_coordinate_error, problem.blank_coordinate_error})
    if (!(error >= 0) || !(error <= limits::kLargestCoordinate))
      return failure(ErrorCode::usage,
                     fmt::format("coordinates that are off by {} mm must be off by a number from 0 to {:g}",
                                 error, limits::kLargestCoordinate));
  if (!problem.blank_widths.empty() && problem.blank_widths.size() != problem.blank.triangles.size())
    return failure(ErrorCode::usage,
                   fmt::format("there are {} widths for the blank's {} triangles",
                               problem.blank_widths.size(), problem.blank.triangles.size()));
  for (const double width : problem.blank_widths)
    if (!(width >= 0) || !(width <= limits::kLargestCoordinate))
      return failure(ErrorCode::usage, fmt::format("a width of {} mm must be a number from 0 to {:g}", width,
                                                   limits::kLargestCoordinate));
  if (!(problem.blank_width_error >= 0) || !(problem.blank_width_error <= limits::kLargestCoordinate))
    return failure(ErrorCode::usage,
                   fmt::format("widths that are off by {} mm must be off by a number from 0 to {:g}",
                               problem.blank_width_error, limits::kLargestCoordinate));
  if (!problem.demands.empty()) LEKALO_CHECK(check_demands(problem));
  LEKALO_CHECK(check_targets(problem));
  LEKALO_CHECK(check_datums(problem.datums));
  LEKALO_CHECK(check_nears(problem));
  double square = 0;
  for (const double q : problem.start.quaternion) square += q * q;
  if (!(square > 1e-6) || !(square < 1e6) || !finite(problem.start.shift) ||
      !(norm(problem.start.shift) <= limits::kLargestCoordinate))
    return failure(ErrorCode::usage,
                   "the start is no pose: its quaternion must be of length 1, and its shift finite");
  return {};
}

SolidFrame frame_of(const SolidProblem& problem) {
  SolidFrame frame;
  frame.start = problem.start.quaternion;
  const solid::Box box = box_of(problem.part.vertices);
  frame.pivot = 0.5 * (box.low + box.high);
  for (const Vector p : problem.part.vertices) frame.reach = std::max(frame.reach, norm(p - frame.pivot));
  const Vector at = motion_of(problem.start)(frame.pivot), shift{problem.shift, problem.shift, problem.shift};
  frame.window.low.at = at - shift, frame.window.high.at = at + shift;
  set_turns(frame, problem.freedom, problem.turn);
  return frame;
}

FramedPose framed(const SolidFrame& frame, const SolidPose& pose) {
  const auto [w, x, y, z] = frame.start;
  return frame.framed(product(pose.quaternion, {w, -x, -y, -z}), motion_of(pose)(frame.pivot));
}

/// Measures what the part has at its pose.
void measure_at_pose(const SolidMeter& meter, SolidPlacement& made) {
  const Motion motion = motion_of(made.pose);
  const MeasuredPose there = meter.measure(motion);
  made.inside = there.inside;
  for (const SolidDatum& datum : meter.datums()) made.off.push_back(meter.off(datum, motion));
  for (const NearFace& face : meter.nears()) {
    made.far.push_back(meter.far(face, motion));
    made.inside = made.inside && made.far.back() <= face.demand().within;
  }
  made.clearance = made.inside ? there.clearance : 0;
  made.margin = made.inside ? there.margin : 0;
}

SolidPlacement placement(const SolidMeter& meter, const FramedPose& found) {
  SolidPlacement made;
  made.pose.quaternion = meter.frame().quaternion(found);
  if (!(found.x == Vector{}) || found.chart != 0) {
    double square = 0;
    for (const double q : made.pose.quaternion) square += q * q;
    for (double& q : made.pose.quaternion) q /= std::sqrt(square);
  }
  const Motion turn = motion_of({made.pose.quaternion, {}});
  made.pose.shift = found.at - turn.turned(meter.frame().pivot);
  measure_at_pose(meter, made);
  return made;
}

Motion motion_of(const SolidPose& pose) noexcept {
  const auto [w, x, y, z] = pose.quaternion;
  const double k = 2 / (w * w + x * x + y * y + z * z);
  return {{{{1 - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)},
            {k * (x * y + w * z), 1 - k * (x * x + z * z), k * (y * z - w * x)},
            {k * (x * z - w * y), k * (y * z + w * x), 1 - k * (x * x + y * y)}}},
          pose.shift};
}

Result<SolidPlacement> place_solid(const SolidProblem& problem, const SolidOptions& options) {
  LEKALO_CHECK(check(problem, options));
  const SolidMeter meter(problem, frame_of(problem), options.threads);
  std::uint64_t work = 0;
  const MeasuredSolid best = first_climb(meter, first_trust(problem), kClimbGain, options.run, work);
  const RunControl nobody;
  const Listening to_the_end(nobody);
  SolidPlacement made = placement(meter, best.pose);
  made.contacts = holding_contacts(meter, best, options.gap);
  made.work = work;
  return made;
}

Result<SolidPlacement> find_start(const SolidProblem& problem, const SolidOptions& options) {
  LEKALO_CHECK(check(problem, options));
  SolidFrame frame = frame_of(problem);
  set_turns(frame, problem.freedom, SolidProblem::kAllTurns);
  const solid::Box blank = box_of(problem.blank.vertices);
  const Vector reach{frame.reach, frame.reach, frame.reach};
  frame.window.low.at = blank.low - reach, frame.window.high.at = blank.high + reach;
  const SolidMeter meter(problem, frame, options.threads);
  std::uint64_t work = 0;
  const MeasuredSolid best = first_climb(meter, frame.reach, options.gap, options.run, work);
  const RunControl nobody;
  const Listening to_the_end(nobody);
  SolidPlacement made = placement(meter, best.pose);
  made.work = work;
  return made;
}

Result<std::optional<SolidPlacement>> solid_at(const SolidProblem& problem, const SolidPose& pose,
                                               const SolidOptions& options) {
  LEKALO_CHECK(check(problem, options));
  const SolidMeter meter(problem, frame_of(problem));
  const SolidFrame& frame = meter.frame();
  const FramedPose at = framed(frame, pose), held = frame.window.held(at);
  if (!(held.x == at.x && held.at == at.at)) return std::nullopt;
  SolidPlacement made;
  made.pose = pose;
  measure_at_pose(meter, made);
  made.contacts = holding_contacts(meter, {at, made.clearance, made.inside}, options.gap);
  return made;
}

Result<SolidResult> locate_solid(const SolidProblem& problem, const SolidOptions& options) {
  LEKALO_CHECK(check(problem, options));
  if (options.run.progress) options.run.progress({});
  const SolidMeter meter(problem, frame_of(problem), options.threads);
  SolidSearch search(meter, options);
  const RunControl nobody;
  const Listening to_the_end(nobody);
  search.run();
  SolidResult result;
  result.best = placement(meter, search.best().pose);
  result.best.contacts = holding_contacts(meter, search.best(), options.gap);
  result.best.work = search.work();
  result.boxes = search.boxes();
  result.upper_bound = search.upper();
  result.proof = search.proof();
  const bool closed = result.best.inside && result.upper_bound - result.best.margin <= options.gap;
  result.status = search.finished() && closed ? Status::optimal : Status::stopped;
  if (result.upper_bound < options.min_allowance) result.status = Status::infeasible;
  return result;
}

}  // namespace lekalo::locate
