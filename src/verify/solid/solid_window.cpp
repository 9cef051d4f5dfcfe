#include "solid_window.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "verify/number/interval.hpp"

namespace lekalo::verify {
namespace {

constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "turn_x", "turn_y", "turn_z"};

using Quaternion = std::array<Fraction, 4>;

Quaternion exact(const std::array<Decimal, 4>& written) {
  Quaternion q;
  for (std::size_t k = 0; k < 4; ++k) q[k] = to_fraction(written[k]);
  return q;
}

/// Returns the rotation that a chart is counted from: half a turn about x, y or z for 1, 2 or 3, after q.
Quaternion of_chart(std::size_t chart, const Quaternion& q) {
  switch (chart) {
    case 1:
      return {Fraction(-q[1]), q[0], Fraction(-q[3]), q[2]};
    case 2:
      return {Fraction(-q[2]), q[3], q[0], Fraction(-q[1])};
    case 3:
      return {Fraction(-q[3]), Fraction(-q[2]), q[1], q[0]};
    default:
      return q;
  }
}

bool has_all_turns(const SolidWindow& window) { return compare(window.turn_deg, Decimal{18, 1}) == 0; }

/// Returns a multiple of u where the rotation of q is that of u after that of s.
Quaternion after(const Quaternion& q, const Quaternion& s) {
  const Exact3 a{q[1], q[2], q[3]}, b{s[1], s[2], s[3]};
  const Exact3 axis = a * s[0] - b * q[0] - cross(a, b);
  return {Fraction(q[0] * s[0] + dot(a, b)), axis[0], axis[1], axis[2]};
}

/// Returns how far each part of x goes in a chart, tan(turn / 2), rounded up; 0 and 1 are exact.
Fraction most_turn(const SolidWindow& window) {
  if (sgn(window.turn_deg.digits) == 0) return 0;
  if (compare(window.turn_deg, Decimal{9, 1}) == 0 || has_all_turns(window)) return 1;
  const Turn half = turn_by_degrees(to_fraction(window.turn_deg) / 2);
  return {(half.sine / half.cosine).high_double()};
}

/// Returns how far each part of x goes in the window.
Exact3 most_turns(const SolidWindow& window) {
  switch (window.freedom) {
    case SolidFreedom::xyz:
      return {};
    case SolidFreedom::c_xyz:
      return {0, 0, most_turn(window)};
    case SolidFreedom::six:
      break;
  }
  const Fraction most = most_turn(window);
  return {most, most, most};
}

Exact3 exact(const std::array<Decimal, 3>& written) {
  return {to_fraction(written[0]), to_fraction(written[1]), to_fraction(written[2])};
}

}  // namespace

std::vector<std::size_t> charts_of(const SolidWindow& window) {
  if (!has_all_turns(window) || window.freedom == SolidFreedom::xyz) return {0};
  if (window.freedom == SolidFreedom::c_xyz) return {0, 3};
  return {0, 1, 2, 3};
}

std::optional<std::string> beyond_box(const SolidWindow& window, std::size_t chart, const PoseBox& box,
                                      const std::array<Decimal, 4>& start) {
  const Quaternion turn = after(exact(start), of_chart(chart, exact(window.start.quaternion)));
  if (std::any_of(turn.begin() + 1, turn.end(), [](const Fraction& part) { return sgn(part) != 0; }))
    return "its rotations are counted from another one than the window's";
  const Exact3 middle = SolidMotion(window.start)(exact(window.pivot)), turns = most_turns(window);
  const Fraction shift = to_fraction(window.shift);
  for (std::size_t k = 0; k < 6; ++k) {
    const Fraction at = k < 3 ? middle[k] : Fraction(), most = k < 3 ? shift : turns[k - 3];
    if (box.low[k].exact <= at - most && box.high[k].exact >= at + most) continue;
    return fmt::format("{} from {} to {} does not cover the window, from {} to {}", kNames[k],
                       nearest(box.low[k].exact), nearest(box.high[k].exact), nearest(at - most),
                       nearest(at + most));
  }
  return std::nullopt;
}

std::optional<std::string> off_window(const SolidWindow& window, const SolidPose& pose) {
  const Fraction slack(4, 1'000'000'000'000'000);
  const Quaternion turn = after(exact(pose.quaternion), exact(window.start.quaternion));
  const Exact3 turns = most_turns(window);
  Fraction largest;
  for (const std::size_t chart : charts_of(window))
    if (abs(turn[chart]) > abs(largest)) largest = turn[chart];
  for (std::size_t k = 0; k < 3; ++k) {
    const Fraction allowed = window.freedom == SolidFreedom::xyz ? Fraction() : Fraction(turns[k] + slack);
    if (abs(turn[k + 1]) <= allowed * abs(largest)) continue;
    return fmt::format("its rotation from the start's has the {} {}, beyond {}", kNames[k + 3],
                       sgn(largest) == 0 ? kInfinity : nearest(turn[k + 1] / largest), nearest(turns[k]));
  }
  const Exact3 pivot = exact(window.pivot), from = SolidMotion(window.start)(pivot),
               to = SolidMotion(pose)(pivot), at = exact(pose.shift);
  Fraction size = to_fraction(window.shift);
  for (std::size_t k = 0; k < 3; ++k) size += abs(pivot[k]) + abs(at[k]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Fraction off = abs(to[k] - from[k]);
    if (off > to_fraction(window.shift) + slack * size)
      return fmt::format("the pivot's {} is {} mm from its place at the start, more than {}", kNames[k],
                         nearest(off), approximate(window.shift));
  }
  return std::nullopt;
}

}  // namespace lekalo::verify
