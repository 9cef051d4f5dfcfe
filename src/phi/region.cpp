#include "lekalo/phi/region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "lekalo/base/stop.hpp"

namespace lekalo::phi {
namespace {

/// The farther half of so many contacts is dropped: far from any contact all pairs of edges would be within a
/// wide margin.
constexpr std::size_t kMostContacts = 8192;

/// Drops the farther half of the contacts and returns how far the rest reach.
double keep_nearer_half(std::vector<RegionContact>& contacts) {
  std::sort(contacts.begin(), contacts.end(), [](const RegionContact& a, const RegionContact& b) {
    return std::tie(a.distance, a.part_edge, a.blank_edge) < std::tie(b.distance, b.part_edge, b.blank_edge);
  });
  contacts.resize(contacts.size() / 2);
  return contacts.back().distance;
}

}  // namespace

using geom::BlankFromPart;
using geom::Curve;
using geom::Point;

geom::Curve placed(const Curve& curve, const BlankFromPart& pose) noexcept {
  Curve moved = curve;
  moved.edge.from = pose(curve.edge.from);
  moved.edge.to = pose(curve.edge.to);
  if (curve.edge.kind == geom::EdgeKind::line) {
    moved.unit = pose.rotate(curve.unit);
    return moved;
  }
  moved.edge.centre = pose(curve.edge.centre);
  moved.first = pose.rotate(curve.first);
  moved.last = pose.rotate(curve.last);
  // A mirrored arc that ran counter-clockwise from first to last runs so from last to first.
  if (pose.mirrored) {
    std::swap(moved.first, moved.last);
    moved.edge.kind =
        curve.edge.kind == geom::EdgeKind::arc_ccw ? geom::EdgeKind::arc_cw : geom::EdgeKind::arc_ccw;
  }
  return moved;
}

RegionClearance::RegionClearance(const std::vector<geom::Region>& part,
                                 const std::vector<geom::Region>& blank)
    : part_(part), blank_(blank) {
  for (const Curve& curve : part_.curves()) {
    const geom::Box box = geom::curve_box(curve);
    disc_.push_back({0.5 * (box.low + box.high), 0.5 * norm(box.high - box.low)});
  }
}

bool RegionClearance::inside(const BlankFromPart& pose) const {
  // The boundaries do not meet, so each contour lies on one side of every other, and one point tells on
  // which.
  const auto& part_starts = part_.contour_starts();
  for (std::size_t c = 0; c + 1 < part_starts.size(); ++c)
    if (!blank_.contains(pose(part_.curves()[part_starts[c]].edge.from))) return false;
  const geom::Pose<geom::PartFrame, geom::BlankFrame> back = pose.inverse();
  const auto& blank_starts = blank_.contour_starts();
  for (std::size_t c = 0; c + 1 < blank_starts.size(); ++c)
    if (part_.contains(back(blank_.curves()[blank_starts[c]].edge.from))) return false;
  return true;
}

/// Says the same where the boundaries may touch, so that one point may lie on another contour and tell
/// nothing, and where they may even cross at ends of edges: all ends and middles are asked that are not in
/// doubt.
bool RegionClearance::touches_from_inside(const BlankFromPart& pose, double doubt) const {
  const auto all_on_one_side = [&](const geom::RegionIndex& of, const geom::RegionIndex& other,
                                   const auto& moved, bool in) {
    return std::all_of(of.curves().begin(), of.curves().end(), [&](const Curve& curve) {
      const geom::Edge& edge = curve.edge;
      Point middle = 0.5 * (edge.from + edge.to);
      if (edge.kind != geom::EdgeKind::line) {
        const double turn = (edge.kind == geom::EdgeKind::arc_ccw ? 0.5 : -0.5) * geom::arc_sweep(edge);
        middle = edge.centre + BlankFromPart::from_angle(turn, {}).rotate(edge.from - edge.centre);
      }
      const auto fits = [&](Point p) {
        return other.nearest(p).distance <= doubt || other.contains(p) == in;
      };
      return fits(moved(edge.from)) && fits(moved(middle));
    });
  };
  return all_on_one_side(part_, blank_, pose, true) && all_on_one_side(blank_, part_, pose.inverse(), false);
}

RegionClearance::Value RegionClearance::at(const BlankFromPart& pose, double margin,
                                           std::vector<RegionContact>* contacts) const {
  if (contacts != nullptr) contacts->clear();
  double least = std::numeric_limits<double>::infinity(), limit = least, most = least;
  const geom::Pose<geom::PartFrame, geom::BlankFrame> back = pose.inverse();
  for (std::uint32_t i = 0; i < disc_.size(); ++i) {
    const Curve moved = placed(part_.curves()[i], pose);
    blank_.visit_within(pose(disc_[i].centre), disc_[i].radius, limit, [&](std::uint32_t j) {
      const geom::ClosestPoints close = closest_points(moved, blank_.curves()[j]);
      if (close.distance > limit) return;
      if (close.distance < least) least = close.distance, limit = std::min(least + margin, most);
      // A shared end belongs to the edge that begins there, so that it makes one contact and not two.
      const Curve& other = blank_.curves()[j];
      const bool elsewhere =
          (close.a == moved.edge.to && !moved.full) || (close.b == other.edge.to && !other.full);
      if (contacts != nullptr && !elsewhere)
        contacts->push_back({i, j, back(close.a), close.b, close.distance});
      if (contacts != nullptr && contacts->size() == kMostContacts)
        limit = most = std::min(limit, keep_nearer_half(*contacts));
    });
  }
  if (contacts != nullptr)
    contacts->erase(std::remove_if(contacts->begin(), contacts->end(),
                                   [&](const RegionContact& c) { return c.distance > limit; }),
                    contacts->end());
  double size = std::max(std::abs(pose.translation.x), std::abs(pose.translation.y));
  for (const geom::Box& box : {part_.bounds(), blank_.bounds()})
    size = std::max({size, -box.low.x, -box.low.y, box.high.x, box.high.y});
  const double doubt = geom::kEdgeDistanceError * size;
  return {least, least > 0 && (least > doubt ? inside(pose) : touches_from_inside(pose, doubt))};
}

RegionContact RegionClearance::nearest(const BlankFromPart& pose, std::uint32_t part_edge) const {
  const Curve moved = placed(part_.curves()[part_edge], pose);
  RegionContact least{part_edge, 0, {}, {}, std::numeric_limits<double>::infinity()};
  const Disc& disc = disc_[part_edge];
  blank_.visit_within(pose(disc.centre), disc.radius, least.distance, [&](std::uint32_t j) {
    const geom::ClosestPoints close = closest_points(moved, blank_.curves()[j]);
    if (close.distance < least.distance) least = {part_edge, j, close.a, close.b, close.distance};
  });
  least.part = pose.inverse()(least.part);
  return least;
}

double RegionClearance::depth(const BlankFromPart& pose, double tolerance) const {
  // Returns how far a point of the part's frame lies outside the blank.
  const auto outside = [&](Point p) {
    const Point q = pose(p);
    const double distance = blank_.nearest(q).distance;
    return blank_.contains(q) ? -distance : distance;
  };
  constexpr double kRelative = 1.0 / 256;
  constexpr std::size_t kMostSquares = 1'000'000;
  double reached = 0;
  for (const Curve& curve : part_.curves()) reached = std::max(reached, outside(curve.edge.from));
  struct Square {
    Point centre;
    double half = 0;
  };
  const geom::Box box = part_.bounds();
  std::vector<Square> open{
      {0.5 * (box.low + box.high), 0.5 * std::max(box.high.x - box.low.x, box.high.y - box.low.y)}};
  for (std::size_t looked = 0; !open.empty(); ++looked) {
    ask();
    const Square square = open.back();
    open.pop_back();
    const double radius = 1.4142135623730952 * square.half;
    const double out = outside(square.centre);
    // Past the limit each square counts with the most that its middle allows.
    if (looked > kMostSquares) {
      reached = std::max(reached, out + radius);
      continue;
    }
    if (out + radius <= reached + std::max(tolerance, kRelative * reached)) continue;
    const double to_part = part_.contains(square.centre) ? 0 : part_.nearest(square.centre).distance;
    if (to_part > radius) continue;
    // The nearest point of the material sticks out by at least this much.
    reached = std::max(reached, out - to_part);
    const double quarter = 0.5 * square.half;
    for (const double dx : {-quarter, quarter})
      for (const double dy : {-quarter, quarter}) open.push_back({square.centre + Point{dx, dy}, quarter});
  }
  return reached + std::max(tolerance, kRelative * reached);
}

}  // namespace lekalo::phi
