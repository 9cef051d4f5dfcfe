#include "solid_start.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "solid_climb.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::PrincipalAxes;
using solid::Vector;
using Quaternion = std::array<double, 4>;

/// So many places of each part of x are looked at in every chart: where all three are free, no rotation is
/// farther than some 47 degrees from one that is looked at, and where only turns about z are, than 8 degrees.
constexpr int kPlacesOfSix = 4, kPlacesOfOne = 16;
/// It climbs from so many rotations, no two of which are closer to each other than the angle whose half has
/// this cosine, 20 degrees.
constexpr std::size_t kClimbs = 8;
constexpr double kApart = 0.985;

/// The middles of equal parts of the window.
std::vector<double> places(double most, int count) {
  std::vector<double> made;
  if (most == 0) return {0};
  for (int k = 0; k < count; ++k) made.push_back(most * (2 * k + 1 - count) / count);
  return made;
}

/// The rotation whose rows these are.
Quaternion quaternion_of(const std::array<Vector, 3>& r) {
  // Four times the products of its parts with each other; the row of the largest part has all of them.
  const auto& [x, y, z] = r;
  const std::array<Quaternion, 4> rows{{{1 + x.x + y.y + z.z, z.y - y.z, x.z - z.x, y.x - x.y},
                                        {z.y - y.z, 1 + x.x - y.y - z.z, x.y + y.x, x.z + z.x},
                                        {x.z - z.x, x.y + y.x, 1 - x.x + y.y - z.z, y.z + z.y},
                                        {y.x - x.y, x.z + z.x, y.z + z.y, 1 - x.x - y.y + z.z}}};
  std::size_t largest = 0;
  for (std::size_t k = 1; k < 4; ++k)
    if (rows[k][k] > rows[largest][largest]) largest = k;
  return rows[largest];
}

/// The poses to begin with: rotations all over the window, with the centres of volume in one place; and where
/// all are free those that bring the axes together, whichever is which, for where moments are nearly equal
/// their order says nothing.
std::vector<FramedPose> poses_all_over(const SolidMeter& meter) {
  const SolidFrame& frame = meter.frame();
  const PrincipalAxes part = principal_axes(meter.part()), blank = principal_axes(meter.blank());
  const Vector most = frame.window.high.x;
  const bool six = most.x > 0;
  std::vector<FramedPose> poses;
  if (six)
    for (const auto& [i, j] :
         {std::pair<std::size_t, std::size_t>(0, 1), {1, 2}, {2, 0}, {1, 0}, {2, 1}, {0, 2}})
      for (const double first : {1.0, -1.0})
        for (const double second : {1.0, -1.0}) {
          const Vector a = first * blank.axes[i], b = second * blank.axes[j];
          poses.push_back(frame.window.held(aligned(frame, part, {a, b, cross(a, b)}, blank.centre)));
        }
  const int count = six ? kPlacesOfSix : kPlacesOfOne;
  for (const std::uint8_t chart : frame.charts)
    for (const double x : places(most.x, count))
      for (const double y : places(most.y, count))
        for (const double z : places(most.z, count)) {
          FramedPose pose{{x, y, z}, {}, chart};
          pose.at = blank.centre + frame.motion(pose).turned(frame.pivot - part.centre);
          poses.push_back(frame.window.held(pose));
        }
  return poses;
}

/// Says if the rotations of two poses are closer to each other than climbs should begin.
bool close(const SolidFrame& frame, const FramedPose& a, const FramedPose& b) {
  const Quaternion p = frame.quaternion(a), q = frame.quaternion(b);
  double pp = 0, pq = 0, qq = 0;
  for (std::size_t k = 0; k < 4; ++k) pp += p[k] * p[k], pq += p[k] * q[k], qq += q[k] * q[k];
  return std::abs(pq) > kApart * std::sqrt(pp * qq);
}

}  // namespace

FramedPose aligned(const SolidFrame& frame, const PrincipalAxes& part, const std::array<Vector, 3>& axes,
                   Vector centre) {
  const Motion start = motion_of({frame.start, {}});
  Motion turn;
  turn.rotation = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector from = start.turned(part.axes[k]), to = axes[k];
    turn.rotation[0] = turn.rotation[0] + to.x * from;
    turn.rotation[1] = turn.rotation[1] + to.y * from;
    turn.rotation[2] = turn.rotation[2] + to.z * from;
  }
  const Vector lever = turn.turned(start.turned(frame.pivot - part.centre));
  return frame.framed(quaternion_of(turn.rotation), centre + lever);
}

MeasuredSolid first_climb(const SolidMeter& meter, double trust, double enough, const RunControl& run,
                          std::uint64_t& work) {
  const SolidFrame& frame = meter.frame();
  if (frame.charts.size() == 1) return climb(meter, frame.window.middle(), trust, enough, run, work);
  std::vector<FramedPose> begin{frame.window.middle()};
  std::vector<std::pair<double, FramedPose>> ranked;
  for (const FramedPose& pose : poses_all_over(meter)) {
    if (run.stop_requested()) break;
    ranked.emplace_back(meter.misfit(frame.motion(pose)), pose);
    ++work;
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [misfit, pose] : ranked) {
    if (begin.size() > kClimbs) break;
    if (std::none_of(begin.begin(), begin.end(),
                     [&, &one = pose](const FramedPose& other) { return close(frame, one, other); }))
      begin.push_back(pose);
  }
  RunControl quiet = run;
  quiet.progress = nullptr;
  std::optional<MeasuredSolid> best;
  const RunControl nobody;
  std::optional<Listening> to_the_end;
  for (std::size_t k = 0; k < begin.size(); ++k) {
    if (best && (run.stop_requested() || work >= run.work_limit)) break;
    if (run.progress) run.progress({work, static_cast<double>(k) / static_cast<double>(begin.size())});
    const MeasuredSolid climbed = climb(meter, begin[k], trust, enough, quiet, work);
    if (!best || climbed.better_than(*best)) best = climbed;
    if (!to_the_end) to_the_end.emplace(nobody);
  }
  return *best;
}

}  // namespace lekalo::locate
