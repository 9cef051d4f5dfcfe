#include "solid_near.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lekalo/base/stop.hpp"

namespace lekalo::locate {
namespace {

using solid::Motion;
using solid::TriangleTree;
using solid::Vector;

/// So many points of a face tell where it is too far, once it is.
constexpr std::size_t kEnoughPoints = 64;

/// A piece of a triangle, by three of the points that were looked at.
struct Piece {
  std::array<std::uint32_t, 3> corner{};
  double high = 0;
  bool operator<(const Piece& other) const { return high < other.high; }
};

/// No point of a piece is farther from the surface: the distance from one triangle of the blank is convex, so
/// that it is the largest at a corner; and no distance grows faster than one goes.
double bound_of(const TriangleTree& blank, const std::vector<FarPoint>& points, const Piece& piece) {
  double high = std::numeric_limits<double>::infinity();
  for (const std::uint32_t k : piece.corner) {
    const FarPoint& at = points[k];
    const solid::Corners& near = blank.corners(blank.place_in_order(at.surface));
    double of_triangle = 0, longest = 0;
    for (const std::uint32_t other : piece.corner) {
      const Vector q = points[other].placed;
      of_triangle = std::max(of_triangle, other == k ? at.far : solid::distance(near, q));
      longest = std::max(longest, norm(q - at.placed));
    }
    high = std::min({high, of_triangle, at.far + longest});
  }
  return high;
}

/// A direction across n, along a leg of a triangle where that has a right angle or nearly so.
Vector along_leg(const solid::Corners& t, Vector n) {
  Vector best;
  double least = 2;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector one = t[(k + 1) % 3] - t[k], other = t[(k + 2) % 3] - t[k];
    const double sizes = norm(one) * norm(other);
    if (!(sizes > 0)) continue;
    if (const double cosine = std::abs(dot(one, other)) / sizes; cosine < least) least = cosine, best = one;
  }
  const Vector flat = best - dot(best, n) * n;
  if (norm(flat) > 0.5 * norm(best) && norm(best) > 0) return 1 / norm(flat) * flat;
  const Vector axis = std::abs(n.x) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0}, w = cross(n, axis);
  return 1 / norm(w) * w;
}

solid::Mesh surface_of(const SolidBody& body) {
  solid::Mesh made;
  for (std::uint32_t k = 0; k < 8; ++k)
    made.vertices.push_back(body.at + ((k & 1) != 0 ? 1.0 : 0.0) * body.a +
                            ((k & 2) != 0 ? 1.0 : 0.0) * body.b + ((k & 4) != 0 ? 1.0 : 0.0) * body.c);
  for (const auto& [a, b, c, d] : std::array<std::array<std::uint32_t, 4>, 6>{
           {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}}) {
    made.triangles.push_back({a, b, c});
    made.triangles.push_back({a, c, d});
  }
  return made;
}

}  // namespace

NearFace::NearFace(const SolidNear& demand, const solid::Mesh& part) : demand_(demand) {
  constexpr std::uint32_t kNobody = 0xffffffff;
  std::vector<std::uint32_t> becomes(part.vertices.size(), kNobody);
  for (const std::uint32_t number : demand.triangles) {
    solid::Triangle t = part.triangles[number];
    for (std::uint32_t& v : t) {
      if (becomes[v] == kNobody) {
        becomes[v] = static_cast<std::uint32_t>(corners_.size());
        corners_.push_back(part.vertices[v]);
        of_corner_.push_back(number);
      }
      v = becomes[v];
    }
    triangles_.push_back(t);
  }
}

FarPoint NearFace::point_at(const TriangleTree& blank, const Motion& motion, Vector part,
                            std::uint32_t triangle) {
  const Vector placed = motion(part);
  const auto near = blank.nearest(placed);
  return {part, placed, near->place, near->high, triangle, near->triangle};
}

Farthest NearFace::at(const TriangleTree& blank, const Motion& motion, double enough,
                      std::size_t most_looked) const {
  Farthest made;
  const auto look = [&](Vector part, std::uint32_t triangle) {
    ask();
    made.points.push_back(point_at(blank, motion, part, triangle));
    made.low = std::max(made.low, made.points.back().far);
    return static_cast<std::uint32_t>(made.points.size() - 1);
  };
  for (std::size_t k = 0; k < corners_.size(); ++k) look(corners_[k], of_corner_[k]);
  std::vector<Piece> open;
  const auto add = [&](const std::array<std::uint32_t, 3>& corner) {
    Piece piece{corner};
    piece.high = bound_of(blank, made.points, piece);
    open.push_back(piece);
    std::push_heap(open.begin(), open.end());
  };
  for (std::size_t k = 0; k < triangles_.size(); ++k) add(triangles_[k]);
  const double slack = demand_.slack();
  while (open.front().high > enough && open.front().high > made.low + slack &&
         made.points.size() < most_looked &&
         !(made.low > enough && enough > 0 && made.points.size() >= kEnoughPoints)) {
    std::pop_heap(open.begin(), open.end());
    const Piece piece = open.back();
    open.pop_back();
    // It is cut in two across its longest side.
    std::size_t longest = 0;
    double length = -1;
    for (std::size_t k = 0; k < 3; ++k)
      if (const double far =
              norm(made.points[piece.corner[(k + 1) % 3]].placed - made.points[piece.corner[k]].placed);
          far > length)
        length = far, longest = k;
    const std::uint32_t a = piece.corner[longest], b = piece.corner[(longest + 1) % 3],
                        c = piece.corner[(longest + 2) % 3];
    const std::uint32_t middle =
        look(0.5 * (made.points[a].part + made.points[b].part), made.points[a].triangle);
    add({a, middle, c});
    add({middle, b, c});
  }
  made.high = std::max(made.low, open.front().high);
  return made;
}

std::vector<BodySide> sides_of(const SolidBody& body) {
  std::vector<BodySide> made;
  for (const auto& [along, one, other] :
       {std::array{body.a, body.b, body.c}, {body.b, body.c, body.a}, {body.c, body.a, body.b}}) {
    Vector n = cross(one, other);
    n = (dot(n, along) < 0 ? -1 : 1) / norm(n) * n;
    made.push_back({n, dot(n, body.at)});
    made.push_back({-n, -dot(n, body.at + along)});
  }
  return made;
}

std::optional<SolidBody> body_beside(const solid::MeshClearance& clearance,
                                     const std::vector<Vector>& blank_points, const FarPoint& point,
                                     double apart, double error, double scale) {
  /// The smallest and the largest sizes that are tried are these parts of part and blank together, and sizes
  /// are found to this part of a step.
  constexpr double kFirst = 1.0 / 256, kSmallest = 0x1p-20, kFiner = 1.0 / 8;
  const TriangleTree& blank = clearance.blank();
  const Vector out = point.placed - point.blank;
  if (!(norm(out) > kSmallest * scale)) return std::nullopt;
  Vector n = 1 / norm(out) * out;
  const solid::Corners& near = blank.corners(blank.place_in_order(point.surface));
  const Vector across = cross(near[1] - near[0], near[2] - near[0]);
  // Bodies of one flat face stand on one plane.
  if (const double along = dot(n, across) / norm(across); std::abs(along) > 1 - 0x1p-30)
    n = (along < 0 ? -1 : 1) / norm(across) * across;
  const Vector u = along_leg(near, n), v = cross(n, u);
  const double stays = apart + error, base = stays + 0x1p-36 * scale;
  const Vector foot = point.blank + base * n;
  /// How far it reaches: up, and along u and v both ways.
  std::array<double, 5> reach{};
  const auto body_of = [&](const std::array<double, 5>& r) {
    return SolidBody{foot - r[2] * u - r[4] * v, r[0] * n, (r[1] + r[2]) * u, (r[3] + r[4]) * v, apart};
  };
  const auto has_room = [&](const std::array<double, 5>& r) {
    const SolidBody body = body_of(r);
    if (solid::MeshClearance(surface_of(body), clearance).nearest(Motion{}, stays)) return false;
    const auto sides = sides_of(body);
    return std::none_of(blank_points.begin(), blank_points.end(), [&](Vector p) {
      return std::all_of(sides.begin(), sides.end(),
                         [&](const BodySide& s) { return dot(s.normal, p) >= s.least; });
    });
  };
  double step = kFirst * scale;
  for (;; step *= 0.25) {
    if (step < kSmallest * scale) return std::nullopt;
    reach.fill(step);
    if (has_room(reach)) break;
  }
  const double first = step;
  const auto go_on = [&](double by) {
    bool any = false;
    for (double& one : reach) {
      const double before = one;
      one += by;
      if (one <= 2 * scale && has_room(reach))
        any = true;
      else
        one = before;
    }
    return any;
  };
  while (go_on(step)) step *= 2;
  for (double finer = step / 2; finer >= std::max(kFiner * first, step * kFiner * kFiner); finer /= 2)
    go_on(finer);
  return body_of(reach);
}

}  // namespace lekalo::locate
