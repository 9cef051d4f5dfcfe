#include "nc_arc.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/limits.hpp"

namespace lekalo::verify {
namespace {

/// The radii at the two ends of an arc may differ by this much.
constexpr double kCircleTolerance = 5e-3;  // mm
constexpr double kSpiralTolerance = 10;    // mm, as LinuxCNC grants arcs of 10 m
/// LinuxCNC refuses arcs of a smaller radius, and arcs by R whose ends are further apart than the diameter
/// and twice this.
constexpr double kRadiusTolerance = 5e-5 * 25.4;  // mm
/// LinuxCNC takes an arc by R for a half circle from this half chord over the radius on.
constexpr double kHalfCircle = 1 - 1e-12;
/// LinuxCNC takes ends closer than 1e-6 rad, seen from the centre, for one point, and the arc for a full
/// turn.
constexpr double kSmallestSweep = 2e-6;
constexpr double kChordTolerance = 1e-4;  // mm

Place in_plane(const Spot& spot, ArcPlane plane) {
  const auto axes = axes_of(plane);
  return {spot[axes[0]], spot[axes[1]]};
}

double sweep_of(const NcArc& arc, Place from, Place to) {
  if (from.x == to.x && from.y == to.y) return 2 * kPi * arc.turns;
  double sweep = (arc.ccw ? 1 : -1) * angle_between(from, to);
  if (!(sweep > 0)) sweep += 2 * kPi;
  return sweep + 2 * kPi * (arc.turns - 1);
}

}  // namespace

std::array<std::size_t, 3> axes_of(ArcPlane plane) {
  if (plane == ArcPlane::xy) return {0, 1, 2};
  return plane == ArcPlane::zx ? std::array<std::size_t, 3>{2, 0, 1} : std::array<std::size_t, 3>{1, 2, 0};
}

std::optional<std::array<double, 2>> centre_of_radius(const NcArc& arc, double radius,
                                                      std::string& complaint) {
  const Place from = in_plane(arc.from, arc.plane), to = in_plane(arc.to, arc.plane);
  const Place chord = to - from;
  const double half = length(chord) / 2;
  if (!(half > 0))
    complaint = "an arc given by R ends where it begins";
  else if (!(std::abs(radius) <= limits::kLargestProgramCoordinate &&
             half <= std::abs(radius) + kRadiusTolerance))
    complaint = fmt::format("no arc of radius {:.6g} joins ends {:.6g} mm apart", std::abs(radius), 2 * half);
  if (!complaint.empty()) return std::nullopt;
  const bool half_circle = half > kHalfCircle * std::abs(radius);
  const double up = half_circle ? 0 : std::sqrt(std::max(0.0, radius * radius - half * half));
  const double side = (arc.ccw ? 1 : -1) * (radius > 0 ? 1 : -1);
  const Place centre = 0.5 * (from + to) + (side * up / (2 * half)) * left_of(chord);
  return std::array{centre.x, centre.y};
}

std::string complaint_about(const NcArc& arc, bool spirals) {
  const Place from = in_plane(arc.from, arc.plane), to = in_plane(arc.to, arc.plane);
  const Place centre{arc.centre[0], arc.centre[1]};
  const double a = length(from - centre), b = length(to - centre);
  const double allowed = spirals ? kSpiralTolerance : kCircleTolerance;
  if (!(a >= kRadiusTolerance && b >= kRadiusTolerance && std::abs(a - b) <= allowed &&
        a <= limits::kLargestProgramCoordinate))
    return fmt::format("the arc's ends are {:.6g} and {:.6g} mm from its centre", a, b);
  const bool full = from.x == to.x && from.y == to.y;
  if (!full && !(std::abs(angle_between(from - centre, to - centre)) >= kSmallestSweep))
    return "an arc of nearly no turn or a full one; give a full turn the same end as start";
  return "";
}

Spot spot_at(const NcArc& arc, double share) {
  if (share >= 1) return arc.to;
  const auto axes = axes_of(arc.plane);
  const Place centre{arc.centre[0], arc.centre[1]};
  const Place from = in_plane(arc.from, arc.plane) - centre, to = in_plane(arc.to, arc.plane) - centre;
  const double turned = (arc.ccw ? 1 : -1) * share * sweep_of(arc, from, to);
  const double angle = std::atan2(from.y, from.x) + turned;
  const double radius = length(from) + share * (length(to) - length(from));
  Spot spot = arc.from;
  spot[axes[0]] = centre.x + radius * std::cos(angle);
  spot[axes[1]] = centre.y + radius * std::sin(angle);
  spot[axes[2]] += share * (arc.to[axes[2]] - arc.from[axes[2]]);
  return spot;
}

void add_arc_moves(const NcArc& arc, const Move& like, std::vector<Move>& moves) {
  Move move = like;
  if (arc.plane == ArcPlane::xy) {
    move.arc = true, move.ccw = arc.ccw, move.turns = arc.turns;
    move.centre = {arc.centre[0], arc.centre[1]};
    moves.push_back(move);
    return;
  }
  const Place centre{arc.centre[0], arc.centre[1]};
  const Place from = in_plane(arc.from, arc.plane) - centre, to = in_plane(arc.to, arc.plane) - centre;
  const double bend = 2 * std::acos(std::max(0.0, 1 - kChordTolerance / std::max(length(from), length(to))));
  const auto chords = static_cast<std::size_t>(std::ceil(sweep_of(arc, from, to) / bend));
  Spot before = arc.from;
  for (std::size_t k = 1; k <= chords; ++k) {
    const Spot spot = spot_at(arc, static_cast<double>(k) / static_cast<double>(chords));
    move.from = {before[0], before[1]}, move.from_z = before[2];
    move.to = {spot[0], spot[1]}, move.to_z = spot[2];
    moves.push_back(move);
    before = spot;
  }
}

}  // namespace lekalo::verify
