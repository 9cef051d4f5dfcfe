#include "motion_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lekalo::nc {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// LinuxCNC keeps this share of the acceleration for the way across an arc (BLEND_ACC_RATIO_NORMAL).
constexpr double kShareAcross = 0.8660254037844386;
/// LinuxCNC passes a junction where the change of direction within one period of its servo thread asks for no
/// more than this share of the acceleration (ARC_BLEND_KINK_RATIO).
constexpr double kKinkShare = 0.1, kServoPeriod = 1e-3;  // s
/// GRBL cuts arcs into chords that lie within this of them ($12).
constexpr double kChordDeviation = 2e-3;  // mm
/// GRBL takes directions for equal, or for opposite, from this cosine on.
constexpr double kEqualDirections = 0.999999;

double dot(const SpaceVector& a, const SpaceVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The most that a rate of each axis allows along a direction.
double along(const SpaceVector& direction, const std::array<double, 3>& of_axes) {
  double most = kNoLimit;
  for (std::size_t i = 0; i < 3; ++i)
    if (direction[i] != 0) most = std::min(most, of_axes[i] / std::abs(direction[i]));
  return most;
}

/// The square of the speed with which GRBL passes a corner, by its junction deviation.
double deviation_square(double cosine, double acceleration, double deviation) {
  if (cosine >= kEqualDirections) return kNoLimit;
  if (cosine <= -kEqualDirections) return 0;
  const double half = std::sqrt(0.5 * (1 + cosine));
  return acceleration * deviation * half / (1 - half);
}

/// The limits of a motion by itself.
struct MotionLimits {
  double speed = 0, acceleration = 0;
};

class MotionPlan {
 public:
  MotionPlan(const std::vector<PlannedMotion>& way, const MachineModel& machine)
      : way_(way), machine_(machine) {
    for (const PlannedMotion& motion : way) limits_.push_back(limits_of(motion));
  }

  std::vector<double> seconds() {
    // The square of the speed where each motion begins, and where the last one ends.
    std::vector<double> square(way_.size() + 1, 0.0);
    for (std::size_t i = 1; i < way_.size(); ++i) square[i] = junction_square(i);
    for (std::size_t i = 0; i < way_.size(); ++i)
      square[i + 1] = std::min(square[i + 1], square[i] + gain(i));
    for (std::size_t i = way_.size(); i-- > 0;) square[i] = std::min(square[i], square[i + 1] + gain(i));
    std::vector<double> seconds;
    for (std::size_t i = 0; i < way_.size(); ++i)
      seconds.push_back(seconds_of(i, square[i], square[i + 1]) +
                        (square[i + 1] == 0 ? machine_.settle_s : 0));
    return seconds;
  }

 private:
  [[nodiscard]] MotionLimits limits_of(const PlannedMotion& motion) const {
    std::array<double, 3> rapid = machine_.rapid_mm_per_min;
    for (double& speed : rapid) speed /= 60;
    const std::array<double, 3>& acceleration = machine_.acceleration_mm_per_s2;
    if (motion.radius_mm == 0)
      return {std::min(motion.feed_mm_per_s, along(motion.first, rapid)), along(motion.first, acceleration)};
    // An arc may point along either axis.
    const double most = std::min(acceleration[0], acceleration[1]), r = motion.radius_mm;
    const double wanted = std::min({motion.feed_mm_per_s, rapid[0], rapid[1]});
    if (machine_.junctions == JunctionRule::deviation) {
      const double half = std::max(0.0, 1 - kChordDeviation / r), turn = 2 * half * half - 1;
      return {std::min(wanted, std::sqrt(deviation_square(turn, most, machine_.junction_deviation_mm))),
              most};
    }
    const double speed = std::min(wanted, std::sqrt(kShareAcross * most * r));
    const double across = speed * speed / (r * most);
    return {speed, most * std::sqrt(1 - across * across)};
  }

  /// The square of the largest speed at which the control passes from the motion before to this one.
  [[nodiscard]] double junction_square(std::size_t i) const {
    const SpaceVector &before = way_[i - 1].last, &after = way_[i].first;
    const double cosine = dot(before, after), slower = std::min(limits_[i - 1].speed, limits_[i].speed);
    switch (machine_.junctions) {
      case JunctionRule::exact_stop:
        return 0;
      case JunctionRule::exact_path: {
        const SpaceVector change{after[0] - before[0], after[1] - before[1], after[2] - before[2]};
        const double least = std::min(limits_[i - 1].acceleration, limits_[i].acceleration);
        const bool is_smooth =
            cosine > 0 && std::sqrt(dot(change, change)) * slower <= kKinkShare * least * kServoPeriod;
        return is_smooth ? slower * slower : 0;
      }
      case JunctionRule::deviation:
        break;
    }
    SpaceVector across{after[0] - before[0], after[1] - before[1], after[2] - before[2]};
    const double length = std::sqrt(dot(across, across));
    if (length > 0)
      for (double& one : across) one /= length;
    return std::min(slower * slower, deviation_square(cosine, along(across, machine_.acceleration_mm_per_s2),
                                                      machine_.junction_deviation_mm));
  }

  [[nodiscard]] double gain(std::size_t i) const { return 2 * limits_[i].acceleration * way_[i].length_mm; }

  /// A trapezoid of speeds, or a triangle where the motion is too short for its top.
  [[nodiscard]] double seconds_of(std::size_t i, double begin, double end) const {
    const auto& [speed, acceleration] = limits_[i];
    const double top = std::max({std::min(speed * speed, 0.5 * (begin + end + gain(i))), begin, end});
    const double ramps = (2 * top - begin - end) / (2 * acceleration), v = std::sqrt(top);
    return (2 * v - std::sqrt(begin) - std::sqrt(end)) / acceleration +
           std::max(0.0, way_[i].length_mm - ramps) / v;
  }

  const std::vector<PlannedMotion>& way_;
  const MachineModel& machine_;
  std::vector<MotionLimits> limits_;
};

}  // namespace

std::vector<double> planned_seconds(const std::vector<PlannedMotion>& way, const MachineModel& machine) {
  return MotionPlan(way, machine).seconds();
}

}  // namespace lekalo::nc
