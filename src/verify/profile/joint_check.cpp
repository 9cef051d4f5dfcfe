#include "joint_check.hpp"

#include <fmt/core.h>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

/// The rounding of words may change a joint by so much, mm.
constexpr double kJointRounding = 5e-3;

}  // namespace

FoundJoints joints_of_contour(const std::vector<ContourStretch>& stretches, const ContourRing& contour,
                              bool is_hole, const std::string& name, const ProfileWords& words,
                              double slack) {
  FoundJoints found;
  const double half = 0.5 * words.kerf_mm;
  std::vector<bool> followed(stretches.size(), false);
  std::vector<Stroke> gaps;
  for (const ContourStretch& stretch : stretches) {
    const Place end = stretch.edges.back().to;
    std::size_t next = 0;
    for (std::size_t i = 1; i < stretches.size(); ++i)
      if (length(stretches[i].edges[0].from - end) < length(stretches[next].edges[0].from - end)) next = i;
    const Place start = stretches[next].edges[0].from;
    const double apart = length(start - end), width = apart - words.kerf_mm;
    if (!(std::abs(width - words.joint_width_mm) <= kJointRounding)) {
      found.findings.push_back(
          fmt::format("line {}: the cut along {} ends {:.4f} mm before it goes on, and a "
                      "joint of {} mm is stated",
                      stretch.line, name, width, words.joint_width_mm));
      continue;
    }
    if (followed[next]) {
      found.findings.push_back(
          fmt::format("line {}: two cuts along {} end before the same place", stretch.line, name));
      continue;
    }
    followed[next] = true;
    gaps.push_back({false, true, end, start, {}, 0});
    const Place way = unit(start - end);
    const Place left = end + half * left_of(way), right = end - half * left_of(way);
    const Place waste =
        contour.distance_of(left) > contour.distance_of(right) ? left_of(way) : -1.0 * left_of(way);
    const double out = half + words.joint_width_mm;
    const Place a = end + half * way, b = start - half * way;
    found.joints.push_back({stretch.line, {a, b, b + out * waste, a + out * waste}});
  }
  if (!found.findings.empty()) return found;
  std::vector<Strokes> cut;
  for (const ContourStretch& stretch : stretches) cut.push_back(stretch.edges);
  const ContourRing all(cut, 0.1 * half);
  const bool right = std::signbit(contour.area()) == is_hole;
  for (const Stroke& piece : contour.pieces) {
    const int samples = static_cast<int>(std::ceil(length(piece)));
    for (int k = 0; k < samples; ++k) {
      ask();
      const Place at = at_share(piece, (k + 0.5) / samples);
      const Place middle = at + (right ? -half : half) * left_of(heading(piece, at));
      if (!(contour.distance_of(middle) >= half - 1e-7) || all.distance_of(middle) <= slack) continue;
      const bool in_joint = std::any_of(gaps.begin(), gaps.end(), [&](const Stroke& gap) {
        return distance(middle, gap) <= slack + 0.5 * length(gap);
      });
      if (in_joint) continue;
      found.findings.push_back(fmt::format("{} is not cut near ({:.4f}, {:.4f})", name, at.x, at.y));
      return found;
    }
  }
  return found;
}

bool leaves_joint(const Stroke& piece, double radius, const FoundJoint& joint) {
  const double reach = radius + length(piece) + length(joint.corners[2] - joint.corners[0]);
  if (length(piece.from - joint.corners[0]) > reach) return true;
  for (std::size_t i = 0; i < 4; ++i) {
    const Stroke side{false, true, joint.corners[i], joint.corners[(i + 1) % 4], {}, 0};
    std::vector<Place> crossings;
    add_crossings(piece, side, crossings);
    if (!crossings.empty() || !(distance_apart(piece, side) >= radius - kJointRounding)) return false;
  }
  return true;
}

}  // namespace lekalo::verify
