#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "lekalo/locate/solid.hpp"

namespace lekalo::locate {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A pose as the search counts it: the rotation after the chart's, as x = tan(angle / 2) times its axis, and
/// the place of the pivot, the middle of the part's box, in the blank's frame. The rotation of chart 0 is the
/// start's, and that of chart 1, 2 or 3 the start's and after it half a turn about x, y or z.
struct FramedPose {
  solid::Vector x, at;
  std::uint8_t chart = 0;
};

/// A box of poses of one chart.
struct SolidCell {
  FramedPose low, high;
  [[nodiscard]] FramedPose middle() const {
    return {0.5 * (low.x + high.x), 0.5 * (low.at + high.at), low.chart};
  }
  /// The half widths.
  [[nodiscard]] FramedPose half() const { return {0.5 * (high.x - low.x), 0.5 * (high.at - low.at)}; }
  [[nodiscard]] FramedPose held(const FramedPose& pose) const {
    const auto in = [](solid::Vector v, solid::Vector from, solid::Vector to) {
      return solid::Vector{std::clamp(v.x, from.x, to.x), std::clamp(v.y, from.y, to.y),
                           std::clamp(v.z, from.z, to.z)};
    };
    return {in(pose.x, low.x, high.x), in(pose.at, low.at, high.at), pose.chart};
  }
};

/// The freedoms in the order of the programs' unknowns: shift along x, y, z, and turn about them, all in mm.
using Steps = std::array<double, 6>;

/// Returns q of u q, a point turned first by the rotation of q and then by that of u.
inline std::array<double, 4> product(const std::array<double, 4>& u, const std::array<double, 4>& q) {
  return {u[0] * q[0] - u[1] * q[1] - u[2] * q[2] - u[3] * q[3],
          u[0] * q[1] + u[1] * q[0] + u[2] * q[3] - u[3] * q[2],
          u[0] * q[2] - u[1] * q[3] + u[2] * q[0] + u[3] * q[1],
          u[0] * q[3] + u[1] * q[2] - u[2] * q[1] + u[3] * q[0]};
}

/// The frame that poses are counted in.
struct SolidFrame {
  std::array<double, 4> start{};
  solid::Vector pivot;  ///< part coordinates
  double reach = 0;     ///< no point of the part is farther from the pivot, mm
  /// The box of chart 0; that of every chart is the same.
  SolidCell window;
  /// The charts that the window has: with |x_i| <= 1, all four are all rotations, and 0 and 3 all turns about
  /// z. One of them has the rotation in which its part of the quaternion is the largest.
  std::vector<std::uint8_t> charts{0};

  /// The rotation of a chart; nothing is rounded.
  [[nodiscard]] std::array<double, 4> start_of(std::uint8_t chart) const {
    std::array<double, 4> half_turn{};
    half_turn[chart] = 1;
    return product(half_turn, start);
  }
  /// It has any length, so that a locked part of the rotation stays exactly as it is.
  [[nodiscard]] std::array<double, 4> quaternion(const FramedPose& pose) const {
    const solid::Vector x = pose.x;
    return product({1, x.x, x.y, x.z}, start_of(pose.chart));
  }
  /// The pose whose rotation is that of a quaternion after the start's, in the chart that it belongs to.
  [[nodiscard]] FramedPose framed(const std::array<double, 4>& turn, solid::Vector at) const {
    std::uint8_t chart = charts.front();
    for (const std::uint8_t other : charts)
      if (std::abs(turn[other]) > std::abs(turn[chart])) chart = other;
    std::array<double, 4> back{};
    back[chart] = chart == 0 ? 1 : -1;
    const auto [w, x, y, z] = product(turn, back);
    return {{x / w, y / w, z / w}, at, chart};
  }
  [[nodiscard]] solid::Motion motion(const FramedPose& pose) const {
    solid::Motion motion = motion_of({quaternion(pose), {}});
    motion.shift = pose.at - motion.turned(pivot);
    return motion;
  }
  /// Goes from a pose by steps that a program of its neighbourhood made, and stays in the window.
  [[nodiscard]] FramedPose moved(const FramedPose& from, const Steps& z) const {
    const solid::Vector y = 0.5 / reach * solid::Vector{z[3], z[4], z[5]}, x = from.x;
    const solid::Vector at = from.at + solid::Vector{z[0], z[1], z[2]};
    const double w = 1 - dot(y, x);
    FramedPose to{x + y + cross(y, x), at, from.chart};
    if (charts.size() == 1) {
      to.x = 1 / w * to.x;
    } else {
      std::array<double, 4> half_turn{};
      half_turn[from.chart] = 1;
      to = framed(product({w, to.x.x, to.x.y, to.x.z}, half_turn), at);
    }
    return window.held(to);
  }
  /// The half widths of a box of steps that leaves what is locked as it is.
  [[nodiscard]] Steps trusted(double half) const {
    const auto of = [half](double width) { return width > 0 ? half : 0; };
    const FramedPose w = window.half();
    return {of(w.at.x), of(w.at.y), of(w.at.z), of(w.x.x), of(w.x.y), of(w.x.z)};
  }
};

}  // namespace lekalo::locate
