#include "lekalo/locate/allowance.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/pose.hpp"
#include "outline_tree.hpp"

namespace lekalo::locate {
namespace {

using geom::Point;
using geom::Ring;

geom::BlankFromPart pose_of(const Placement& placement) {
  return geom::BlankFromPart::from_angle(placement.theta, {placement.x, placement.y});
}

Ring placed(const Ring& part, const Placement& placement) {
  const geom::BlankFromPart pose = pose_of(placement);
  Ring ring(part.size());
  std::transform(part.begin(), part.end(), ring.begin(), pose);
  return ring;
}

Point end_of_edge(const Ring& ring, std::size_t edge) { return ring[edge + 1 == ring.size() ? 0 : edge + 1]; }

/// Returns in how many pieces each edge is cut so that none is longer than the step; empty when they are too
/// many.
std::vector<std::size_t> pieces_of_edges(const Ring& ring, double step) {
  std::vector<std::size_t> pieces;
  double total = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const double count = std::max(1.0, std::ceil(geom::norm(end_of_edge(ring, k) - ring[k]) / step));
    total += count;
    if (!(total <= static_cast<double>(kMaxAllowanceSamples))) return {};
    pieces.push_back(static_cast<std::size_t>(count));
  }
  return pieces;
}

double least_turn(double angle) {
  const double turn = std::remainder(angle, kTurn);
  return turn <= -kPi ? kPi : turn;
}

}  // namespace

Result<std::vector<AllowanceSample>> contour_allowance(const Ring& part, const Ring& blank,
                                                       const Placement& placement, double step) {
  if (!(step > 0)) {
    return failure(ErrorCode::usage,
                   fmt::format("the step along the contour is {} mm; it must be above 0", step));
  }
  const Ring outline = placed(part, placement);
  const std::vector<std::size_t> pieces = pieces_of_edges(outline, step);
  if (pieces.empty()) {
    return failure(
        ErrorCode::usage,
        fmt::format("a step of {} mm gives more than {} points along the contour; choose a longer one", step,
                    kMaxAllowanceSamples));
  }
  const detail::OutlineTree tree(blank);
  std::vector<AllowanceSample> samples;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Point edge = end_of_edge(outline, k) - outline[k];
    for (std::size_t j = 0; j < pieces[k]; ++j) {
      const double along = static_cast<double>(j) / static_cast<double>(pieces[k]);
      const Point at = outline[k] + along * edge;
      samples.push_back({at, tree.signed_distance(at), static_cast<std::uint32_t>(k), along});
    }
  }
  return samples;
}

std::vector<double> deviations(const Ring& probed, const Ring& part, const Placement& placement) {
  const detail::OutlineTree tree(placed(part, placement));
  std::vector<double> result(probed.size());
  // The difference 0 - d is not -d: for a point on the outline it gives 0, which prints without a sign.
  std::transform(probed.begin(), probed.end(), result.begin(),
                 [&tree](Point p) { return 0 - tree.signed_distance(p); });
  return result;
}

PlacementShift placement_shift(const Ring& part, const Placement& last, const Placement& now) {
  PlacementShift shift{now.x - last.x, now.y - last.y, least_turn(now.theta - last.theta), 0, 0};
  const geom::BlankFromPart from = pose_of(last), to = pose_of(now);
  for (std::size_t i = 0; i < part.size(); ++i) {
    const double moved = geom::norm(to(part[i]) - from(part[i]));
    if (moved > shift.largest) {
      shift.largest = moved;
      shift.vertex = i;
    }
  }
  return shift;
}

}  // namespace lekalo::locate
