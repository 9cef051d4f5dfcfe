#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/phi/region.hpp"

namespace lekalo::phi {
namespace {

using geom::Curve;
using geom::EdgeKind;
using geom::Point;

/// A stretch of a placed edge of the part: a line, or an arc of a quarter turn at most.
struct Piece {
  Point from, to, centre;
  double radius = 0;  ///< 0 for a line
  std::uint32_t edge = 0;
  /// No point of the piece lies deeper than this.
  double most = 0;
  friend bool operator<(const Piece& a, const Piece& b) { return a.most < b.most; }
};

Point middle_of(const Piece& piece) {
  const Point chord_middle = 0.5 * (piece.from + piece.to);
  if (piece.radius == 0) return chord_middle;
  const Point out = chord_middle - piece.centre;
  return piece.centre + (piece.radius / norm(out)) * out;
}

/// The corners of a convex set that holds the piece.
struct Corners {
  std::array<Point, 3> at;
  std::size_t count = 2;
};
Corners corners_of(const Piece& piece) {
  Corners corners{{piece.from, piece.to, {}}, 2};
  if (piece.radius == 0) return corners;
  const Point chord_middle = 0.5 * (piece.from + piece.to), out = chord_middle - piece.centre;
  corners.at[corners.count++] = piece.centre + (piece.radius * piece.radius / dot(out, out)) * out;
  return corners;
}

/// Returns a distance that no point of the piece exceeds from the curve.
double farthest(const Piece& piece, const Corners& corners, const Curve& curve) {
  const auto from_point = [&](Point c) {
    double most = 0;
    for (std::size_t k = 0; k < corners.count; ++k) most = std::max(most, norm(corners.at[k] - c));
    return most;
  };
  // The distance from a line is a convex function, so it is largest in a corner.
  if (curve.edge.kind == EdgeKind::line) {
    double most = 0;
    for (std::size_t k = 0; k < corners.count; ++k)
      most = std::max(most, norm(corners.at[k] - nearest_on(curve, corners.at[k])));
    return most;
  }
  const double ends = std::min(from_point(curve.edge.from), from_point(curve.edge.to));
  const bool in_sector =
      curve.full ||
      (!curve.wide &&
       std::all_of(corners.at.begin(), corners.at.begin() + static_cast<std::ptrdiff_t>(corners.count),
                   [&](Point p) { return faces(curve, p - curve.edge.centre); }));
  if (!in_sector) return ends;
  // The distances from the arc's centre are between `near` and `far`.
  double far = from_point(curve.edge.centre), near = 0;
  if (piece.radius == 0) {
    near = norm(curve.edge.centre -
                nearest_on(geom::make_curve({EdgeKind::line, piece.from, piece.to, {}}), curve.edge.centre));
  } else {
    const double apart = norm(piece.centre - curve.edge.centre);
    near = std::abs(apart - piece.radius);
    far = std::min(far, apart + piece.radius);
  }
  return std::min(ends, std::max(far - curve.radius, curve.radius - near));
}

class Deepest {
 public:
  struct Place {
    std::uint32_t part_edge = 0, blank_edge = 0;
    Point at, nearest;
    double depth = 0;
  };

  Deepest(const geom::RegionIndex& blank, double tolerance, double margin)
      : blank_(blank), tolerance_(tolerance), margin_(margin) {}

  void add(const Curve& curve, std::uint32_t edge) {
    if (curve.edge.kind == EdgeKind::line)
      return look(Piece{curve.edge.from, curve.edge.to, {}, 0, edge, 0}, true);
    const double sweep = geom::arc_sweep(curve.edge);
    const auto parts = static_cast<int>(std::ceil(sweep / (kPi / 2) - 1e-9));
    const double step = (curve.edge.kind == EdgeKind::arc_ccw ? sweep : -sweep) / parts;
    const Point centre = curve.edge.centre, out = curve.edge.from - centre;
    Point from = curve.edge.from;
    for (int k = 1; k <= parts; ++k) {
      const geom::SinCos turn = geom::sincos(step * k);
      const Point turned{turn.cosine * out.x - turn.sine * out.y, turn.sine * out.x + turn.cosine * out.y};
      const Point to = k == parts ? curve.edge.to : centre + turned;
      look(Piece{from, to, centre, curve.radius, edge, 0}, true);
      from = to;
    }
  }

  double run() {
    for (std::size_t looked = 0; !open_.empty() && looked < RegionClearance::kMostPieces; ++looked) {
      ask();
      const Piece piece = open_.top();
      if (piece.most <= best_ + tolerance_) break;
      open_.pop();
      Piece half = piece;
      half.to = middle_of(piece);
      look(half, false);
      half.from = half.to, half.to = piece.to;
      look(half, false);
    }
    return open_.empty() ? best_ : std::max(best_, open_.top().most);
  }

  /// Returns the places of all edges that are near the deepest of all. Each edge gives the beginnings and
  /// middles of its pieces, and its deepest place.
  [[nodiscard]] std::vector<Place> places() {
    std::vector<Place> kept;
    for (const std::vector<Place>* const list : {&first_, &later_})
      for (const Place& place : *list)
        if (place.depth >= best_ - margin_) kept.push_back(place);
    return kept;
  }

 private:
  void look(Piece piece, bool first) {
    const Point middle = middle_of(piece);
    const auto nearest = blank_.nearest(middle, likely_);
    likely_ = nearest.edge;
    // Half of an arc of a quarter turn is at most 0.5554 of its chord long.
    const double half = (piece.radius == 0 ? 0.5 : 0.5554) * norm(piece.to - piece.from);
    if (nearest.distance + half < best_ - margin_) return;
    const bool inside = blank_.contains(middle);
    if (!inside && nearest.distance > half) return;
    piece.most = nearest.distance + half;
    if (inside) {
      note({piece.edge, nearest.edge, middle, nearest.point, nearest.distance}, first);
      const auto from = blank_.nearest(piece.from, nearest.edge), to = blank_.nearest(piece.to, nearest.edge);
      const Corners corners = corners_of(piece);
      for (const std::uint32_t edge : {nearest.edge, from.edge, to.edge})
        piece.most = std::min(piece.most, farthest(piece, corners, blank_.curves()[edge]));
      piece.most = std::max(piece.most, nearest.distance);
      if (first && blank_.contains(piece.from))
        note({piece.edge, from.edge, piece.from, from.point, from.distance}, first);
    }
    open_.push(piece);
  }

  void note(const Place& place, bool first) {
    best_ = std::max(best_, place.depth);
    if (first) {
      first_.push_back(place);
    } else if (later_.empty() || later_.back().part_edge != place.part_edge) {
      later_.push_back(place);
    } else if (place.depth > later_.back().depth) {
      later_.back() = place;
    }
  }

  const geom::RegionIndex& blank_;
  double tolerance_, margin_, best_ = 0;
  std::uint32_t likely_ = 0;
  std::priority_queue<Piece> open_;
  std::vector<Place> first_, later_;
};

}  // namespace

double RegionClearance::deepest(const geom::BlankFromPart& pose, const std::vector<Curve>& edges,
                                double tolerance, double margin, std::vector<RegionContact>& points) const {
  Deepest search(blank_, tolerance, margin);
  for (std::uint32_t k = 0; k < edges.size(); ++k) search.add(placed(edges[k], pose), k);
  const double deepest = search.run();
  const auto back = pose.inverse();
  points.clear();
  for (const Deepest::Place& place : search.places())
    points.push_back({place.part_edge, place.blank_edge, back(place.at), place.nearest, place.depth});
  return deepest;
}

}  // namespace lekalo::phi
