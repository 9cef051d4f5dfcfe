#include "lekalo/mill/fragments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::mill {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

constexpr std::size_t kMostFragments = 200;
constexpr double kTurn = 0.1;       // rad
constexpr double kBend = 0.03;      // of the region's size
constexpr double kSoftTurn = 0.35;  // sine
constexpr double kOnward = 1e-6;    // of the region's size: nearer than this is the place itself

/// A place where the boundary turns away from the material, which lies on the left.
struct Notch {
  Point at;
  Point before, after;  ///< unit directions along the boundary
};

Point tangent(const Edge& edge, Point at) {
  if (edge.kind == EdgeKind::line) return (1 / norm(edge.to - edge.from)) * (edge.to - edge.from);
  const Point out = (1 / norm(at - edge.centre)) * (at - edge.centre);
  return edge.kind == EdgeKind::arc_ccw ? geom::perpendicular(out) : -geom::perpendicular(out);
}

Point middle_of(const Edge& arc) {
  const double radius = arc_radius(arc);
  Point towards = geom::perpendicular(arc.to - arc.from);
  if (arc.from == arc.to)
    towards = arc.centre - arc.from;
  else if (arc.kind == EdgeKind::arc_ccw)
    towards = -towards;
  return arc.centre + (radius / norm(towards)) * towards;
}

/// How a boundary turns from one edge to the next.
struct Joint {
  Notch notch;
  double turn;  ///< sine; negative away from the material
  bool soft;    ///< turns away a little, as places along a curve do
};

/// Finds the place half way round a curve that is given by many short edges, if the curve bends enough.
void add_bend(const std::vector<Joint>& curve, double size, std::vector<Notch>& notches) {
  const Point from = curve.front().notch.at, way = curve.back().notch.at - from;
  const double length = norm(way);
  double turn = 0, depth = 0;
  for (const Joint& joint : curve) {
    turn += joint.turn;
    const Point off = joint.notch.at - from;
    depth = std::max(depth, length > 0 ? std::abs(cross(way, off)) / length : norm(off));
  }
  if (!(depth > kBend * size)) return;
  double half = 0;
  for (const Joint& joint : curve) {
    half += joint.turn;
    if (half <= 0.5 * turn) return notches.push_back(joint.notch);
  }
}

void add_notches(const geom::Contour& contour, double size, std::vector<Notch>& notches) {
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Edge &edge = contour[i], &next = contour[(i + 1) % contour.size()];
    const Point a = tangent(edge, edge.to), b = tangent(next, next.from);
    const double turn = cross(a, b);
    const Point across = next.to - edge.from;
    const bool shallow = edge.kind == EdgeKind::line && next.kind == EdgeKind::line &&
                         std::abs(cross(edge.to - edge.from, across)) <= kBend * size * norm(across);
    joints.push_back({{edge.to, a, b}, turn, shallow && dot(a, b) > 0 && turn < 0 && turn > -kSoftTurn});
    if (edge.kind != EdgeKind::arc_cw) continue;
    const Point middle = middle_of(edge), along = tangent(edge, middle);
    if (norm(middle - 0.5 * (edge.from + edge.to)) > kBend * size) notches.push_back({middle, along, along});
  }
  // The walk begins after a place that is on no curve, if there is one, so that no curve is seen in halves.
  const auto first = std::find_if(joints.begin(), joints.end(), [](const Joint& j) { return !j.soft; });
  if (first != joints.end()) std::rotate(joints.begin(), first + 1, joints.end());
  for (std::size_t i = 0; i < joints.size();) {
    std::vector<Joint> curve;
    while (i < joints.size() && joints[i].soft) curve.push_back(joints[i++]);
    if (!curve.empty()) add_bend(curve, size, notches);
    if (i == joints.size()) break;
    const Joint& j = joints[i++];
    if (j.turn < -kTurn || (dot(j.notch.before, j.notch.after) < 0 && j.turn < 0)) notches.push_back(j.notch);
  }
}

/// The distance from p to the boundary along a unit direction, beyond `least`.
double reach(const std::vector<geom::Curve>& curves, Point p, Point d, double least) {
  double best = std::numeric_limits<double>::infinity();
  const auto take = [&](double t) {
    if (t > least) best = std::min(best, t);
  };
  for (const geom::Curve& curve : curves) {
    const Edge& e = curve.edge;
    if (e.kind == EdgeKind::line) {
      const Point way = e.to - e.from;
      const double turn = cross(d, way);
      if (!(std::abs(turn) > 1e-12 * norm(way))) continue;
      const double s = cross(e.from - p, d) / turn;
      if (s >= -1e-9 && s <= 1 + 1e-9) take(cross(e.from - p, way) / turn);
      continue;
    }
    const Point to_centre = e.centre - p;
    const double along = dot(to_centre, d), off = cross(d, to_centre);
    const double square = curve.radius * curve.radius - off * off;
    if (!(square >= 0)) continue;
    for (const double t : {along - std::sqrt(square), along + std::sqrt(square)})
      if (geom::faces(curve, p + t * d - e.centre)) take(t);
  }
  return best;
}

struct Chord {
  Point at, direction;
  double length = std::numeric_limits<double>::infinity();
};

/// The shortest cut from any notch.
std::optional<Chord> shortest_cut(const Region& region) {
  const geom::Box box = geom::bounds(region.outer);
  const double size = norm(box.high - box.low);
  std::vector<Notch> notches;
  add_notches(region.outer, size, notches);
  for (const geom::Contour& hole : region.holes) add_notches(hole, size, notches);
  const geom::RegionIndex index({region});
  Chord best;
  double least = std::numeric_limits<double>::infinity();
  for (const Notch& n : notches) {
    const Point across = geom::perpendicular(n.before + n.after);
    std::vector<Point> ways{n.before, -n.after};
    if (norm(across) > 1e-9) ways.push_back((1 / norm(across)) * across);
    for (const Notch& other : notches)
      if (const double far = norm(other.at - n.at); far > kOnward * size)
        ways.push_back((1 / far) * (other.at - n.at));
    for (const Point way : ways) {
      // A cut goes between the lines of the two edges, or the corner would stay one.
      if (cross(n.before, way) < -1e-9 || cross(n.after, way) < -1e-9) continue;
      if (norm(n.before - n.after) < 1e-9 && dot(way, across) < 0.9 * norm(across)) continue;
      const double length = reach(index.curves(), n.at, way, kOnward * size);
      if (!(length < 2 * size) || !index.contains(n.at + (0.5 * length) * way)) continue;
      // A cut that ends in another such place does away with both.
      const bool both = std::any_of(notches.begin(), notches.end(), [&](const Notch& other) {
        return norm(n.at + length * way - other.at) < kOnward * size;
      });
      const double cost = both ? 0.5 * length : length;
      if (cost < least * (1 - 1e-9)) least = cost, best = {n.at, way, length};
    }
  }
  if (!(best.length < std::numeric_limits<double>::infinity())) return std::nullopt;
  return best;
}

/// The part that lies on one side of the chord, next to it and as far as its line goes, and the rest.
Result<std::vector<Region>> divided(const Region& region, const Chord& chord, double side) {
  const geom::Box box = geom::bounds(region.outer);
  const double size = 2 * norm(box.high - box.low) + 1;
  const Point along = side * chord.direction;
  const Point a = chord.at - size * along, b = chord.at + size * along;
  const Point left = size * geom::perpendicular(along);
  LEKALO_TRY(const auto half, geom::make_region({{EdgeKind::line, a, b, {}},
                                                 {EdgeKind::line, b, b + left, {}},
                                                 {EdgeKind::line, b + left, a + left, {}},
                                                 {EdgeKind::line, a + left, a, {}}}));
  LEKALO_TRY(const auto pieces, geom::combine({region}, {half}, geom::BooleanOperation::intersect));
  const Point beside =
      chord.at + (0.5 * chord.length) * chord.direction + (1e-6 * chord.length) * geom::perpendicular(along);
  for (const Region& piece : pieces.regions) {
    if (!geom::RegionIndex({piece}).contains(beside)) continue;
    LEKALO_TRY(auto rest,
               geom::combine({region}, {piece}, geom::BooleanOperation::subtract, pieces.edge_error));
    std::vector<Region> both{piece};
    const double speck = 1e-9 * geom::area(region);
    for (Region& r : rest.regions)
      if (geom::area(r) > speck) both.push_back(std::move(r));
    return both;
  }
  return std::vector<Region>{region};
}

/// Divides by the chord, from the side on which its line cuts less of the rest off.
Result<std::vector<Region>> divided(const Region& region, const Chord& chord) {
  auto left = divided(region, chord, 1);
  if (!left || left->size() == 2) return left;
  auto right = divided(region, chord, -1);
  const bool better = right && right->size() > 1 && (left->size() < 2 || right->size() < left->size());
  return better ? right : left;
}

}  // namespace

Result<std::vector<Region>> convex_fragments(const std::vector<Region>& regions) {
  std::vector<Region> open(regions.rbegin(), regions.rend()), done;
  while (!open.empty()) {
    ask();
    const Region region = std::move(open.back());
    open.pop_back();
    const auto cut = done.size() + open.size() < kMostFragments ? shortest_cut(region) : std::nullopt;
    if (!cut) {
      done.push_back(region);
      continue;
    }
    LEKALO_TRY(auto parts, divided(region, *cut));
    if (parts.size() < 2) {
      done.push_back(region);
      continue;
    }
    open.insert(open.end(), parts.rbegin(), parts.rend());
  }
  return done;
}

}  // namespace lekalo::mill
