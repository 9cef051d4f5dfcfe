#include "grown_ball.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "verify/number/span.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/shape_inside.hpp"
#include "verify/shape/stretch.hpp"

namespace lekalo::verify {
namespace {

/// One ball is looked at in at most this many pieces of sides.
constexpr std::size_t kMostBallPieces = 256;
/// One ball is cut into at most this many sectors.
constexpr std::size_t kMostSectors = 2048;
/// A ball that is too large by no more than this, relatively, is made smaller at once.
constexpr double kTouching = 1e-13;
/// A piece is narrow enough when every corner's direction is off their mean by an angle with a cosine above
/// it.
constexpr double kNarrow = 0.9;

/// Points between corners, in their convex hull, that are also within a distance of a middle.
struct Hull {
  Vec middle;
  double within = 0;
  std::array<Vec, 6> at;
  std::size_t count = 0;
};

/// Returns a distance that no point of the hull exceeds from the side.
double farthest(const Hull& hull, const Side& side) {
  const Span within = just(hull.within);
  const double by_middle = (just(distance(hull.middle, side).high) + within).high;
  // The distance from one point is a convex function, and so is the distance from a line: both are largest in
  // a corner.
  double to_point = by_middle;
  for (const Vec* end : {&side.from, &side.to}) {
    double most = 0;
    for (std::size_t i = 0; i < hull.count; ++i) most = std::max(most, length(hull.at[i] - *end).high);
    to_point = std::min(to_point, (just(most) + just(side.off)).high);
  }
  if (!side.arc) {
    double most = 0;
    for (std::size_t i = 0; i < hull.count; ++i) most = std::max(most, distance(hull.at[i], side).high);
    return std::min(to_point, most);
  }
  bool after = true, before = true;
  Vec sum{just(0), just(0)};
  for (std::size_t i = 0; i < hull.count; ++i) {
    const Vec d = hull.at[i] - side.centre;
    after = after && cross(side.first, d).low >= 0;
    before = before && cross(d, side.last).low >= 0;
    sum = sum + d;
  }
  const bool faces =
      side.sweep == Sweep::full || (side.sweep == Sweep::more ? after || before : after && before);
  if (!faces) return to_point;
  double outside = 0, inside = 0;
  for (std::size_t i = 0; i < hull.count; ++i)
    outside = std::max(outside, (length(hull.at[i] - side.centre) - side.radius).high);
  outside = std::min(outside, (length(hull.middle - side.centre) + within - side.radius).high);
  // No point is further from the circle, inwards, than its centre is.
  if (length(sum).low > 0) {
    const Vec along = unit(sum);
    for (std::size_t i = 0; i < hull.count; ++i)
      inside = std::max(inside, (side.radius - dot(hull.at[i] - side.centre, along)).high);
    inside = std::min(inside, side.radius.high);
  } else {
    inside = side.radius.high;
  }
  return std::min(to_point, std::max(outside, inside));
}

/// Makes a hull of the points that lie beyond the piece on straight lines from c through it, up to `radius`
/// from c. Returns false where the piece is too wide for that.
///   With u_i the directions of the piece's corners, such a point is c + sum m_i u_i, m_i >= 0; it lies
///   between the piece and where sum m_i = R; and its distance from c is at least (sum m_i) (least u_i . v)
///   for every unit vector v.
bool beyond(const Side& piece, const Vec& c, double radius, Hull& hull) {
  const Corners corners = corners_of(piece);
  std::array<Vec, 3> u;
  Vec sum{just(0), just(0)};
  hull.middle = c, hull.within = radius, hull.count = 0;
  for (std::size_t i = 0; i < corners.count; ++i) {
    const Vec d = corners.at[i] - c;
    if (!(length(d).low > 0)) return false;
    u[i] = unit(d), sum = sum + u[i];
    hull.at[hull.count++] = corners.at[i];
  }
  if (!(length(sum).low > 0)) return false;
  const Vec v = unit(sum);
  double least = 1;
  for (std::size_t i = 0; i < corners.count; ++i) least = std::min(least, dot(u[i], v).low);
  if (!(least > kNarrow)) return false;
  const Span far = just((just(radius) / just(least)).high);
  for (std::size_t i = 0; i < corners.count; ++i) hull.at[hull.count++] = c + u[i] * far;
  return true;
}

/// Points of a ball whose directions from its middle lie between two, and whose distances do.
struct Sector {
  Vec from, to;
  double near = 0, far = 0;
};

/// Makes a hull of the sector. With u and w its directions, a point is c + m u + n w with m, n >= 0. There
/// m + n is at least the point's distance from c, and at most that over (u . v) for the middle direction v.
Hull hull_of(const Sector& sector, const Vec& c, const Vec& v) {
  Hull hull{c, sector.far, {}, 0};
  const Vec u = unit(sector.from), w = unit(sector.to);
  const double least = std::min(dot(u, v).low, dot(w, v).low);
  const Span far = just((just(sector.far) / just(least)).high);
  for (const Vec& along : {u, w})
    for (const Span& by : {just(sector.near), far}) hull.at[hull.count++] = c + along * by;
  return hull;
}

/// Sides of the part that a ball meets, and those whose rim, taken off along them, it meets.
struct Met {
  std::vector<std::size_t> sides, rims;
};

/// Says whether what of the hull is in the ball lies in the part's material, and in no rim that is taken off.
bool in_material(const Shape& part, const std::vector<double>& growth, const Met& met, const Hull& hull,
                 const Vec& middle) {
  double reach = 0;
  for (std::size_t i = 0; i < hull.count; ++i) reach = std::max(reach, length(hull.at[i] - middle).high);
  const auto beyond_reach = [&](std::size_t k, double off) {
    return (just(distance(middle, part.sides[k]).low) - just(off)).low > reach;
  };
  for (const std::size_t k : met.sides)
    if (!beyond_reach(k, 2 * part.sides[k].off)) return false;
  for (const std::size_t k : met.rims)
    if (!beyond_reach(k, -growth[k])) return false;
  const std::optional<bool> in = holds(part, middle);
  return in && *in;
}

}  // namespace

double grown_ball(const Shape& part, const std::vector<double>& growth, const Vec& c, double wanted) {
  struct Piece {
    Side side;
    /// A way out through the piece is at least this long.
    double by = 0, through = 0;
  };
  std::vector<Piece> open;
  std::vector<std::size_t> covering;
  double radius = wanted;
  for (std::size_t k = 0; k < part.sides.size(); ++k) {
    const double through = (just(distance(c, part.sides[k]).low) + just(growth[k])).low;
    if (growth[k] < 0) {
      radius = std::min(radius, through);
    } else if (through < wanted) {
      open.push_back({part.sides[k], growth[k], through});
    }
    if (growth[k] > 0 && (just(distance(c, part.sides[k]).low) - just(growth[k])).low <= wanted)
      covering.push_back(k);
  }
  // The least way out so far through what is not covered.
  double least = kInfinity;
  for (std::size_t looked = 0; !open.empty(); ++looked) {
    const Piece piece = open.back();
    open.pop_back();
    const double apart = distance(c, piece.side).low;
    const double through = std::max(piece.through, (just(apart) + just(piece.by)).low);
    if (through >= std::min(radius, least)) continue;
    // The ball touches the side there, and only rounding says that it does not fit.
    if (through >= radius - kTouching * (1 + radius)) {
      radius = through;
      continue;
    }
    const bool whole = piece.side.arc && piece.side.sweep != Sweep::less;
    Hull hull;
    bool covered = false;
    if (!whole && apart > 2 * piece.side.off && beyond(piece.side, c, radius, hull)) {
      // Lines through what joins an arc's end to its circle are off by its length, and by more as they go on.
      const Span slack = just(2 * piece.side.off) * (just(1) + just(2 * radius) / just(apart));
      covered = std::any_of(covering.begin(), covering.end(), [&](std::size_t k) {
        return (just(farthest(hull, part.sides[k])) + slack).high <= growth[k];
      });
    }
    if (covered) continue;
    if (looked >= kMostBallPieces) {
      least = through;
      continue;
    }
    for (const Side& half : halves(piece.side)) open.push_back({half, piece.by, through});
  }
  return std::min(radius, least);
}

double covered_ball(const Shape& part, const std::vector<double>& growth, const Vec& c, double wanted) {
  std::vector<std::size_t> covering;
  for (std::size_t k = 0; k < part.sides.size(); ++k)
    if (growth[k] > 0 && (just(distance(c, part.sides[k]).low) - just(growth[k])).low <= wanted)
      covering.push_back(k);
  if (covering.empty() || !(wanted > 0)) return 0;
  const std::array<Vec, 4> axes{Vec{just(1), just(0)}, Vec{just(0), just(1)}, Vec{just(-1), just(0)},
                                Vec{just(0), just(-1)}};
  // No sector is small enough where the ball touches the boundary, so it is made smaller at once.
  double radius = wanted - kTouching * (1 + wanted + length(c).high);
  Met met;
  for (std::size_t k = 0; k < part.sides.size(); ++k) {
    const double apart = distance(c, part.sides[k]).low;
    if (!((just(apart) - just(2 * part.sides[k].off)).low >= radius)) met.sides.push_back(k);
    if (growth[k] < 0 && !((just(apart) + just(growth[k])).low >= radius)) met.rims.push_back(k);
  }
  std::vector<Sector> open;
  for (std::size_t i = 0; i < axes.size(); ++i) open.push_back({axes[i], axes[(i + 1) % 4], 0, radius});
  for (std::size_t looked = 0; !open.empty() && radius > 0; ++looked) {
    const Sector sector = open.back();
    open.pop_back();
    if (sector.near >= radius) continue;
    if (looked >= kMostSectors) {
      radius = sector.near;
      continue;
    }
    const Vec v = unit(unit(sector.from) + unit(sector.to));
    const Hull hull = hull_of(sector, c, v);
    const bool covered =
        std::any_of(covering.begin(), covering.end(),
                    [&](std::size_t k) { return farthest(hull, part.sides[k]) <= growth[k]; }) ||
        in_material(part, growth, met, hull, c + v * just(0.5 * (sector.near + sector.far)));
    if (covered) continue;
    const double depth = sector.far - sector.near;
    if (sector.far * length(unit(sector.from) - unit(sector.to)).high > depth) {
      const Vec between{just(v.x.low), just(v.y.low)};
      open.push_back({sector.from, between, sector.near, sector.far});
      open.push_back({between, sector.to, sector.near, sector.far});
    } else {
      const double at = sector.near + 0.5 * depth;
      open.push_back({sector.from, sector.to, at, sector.far});
      open.push_back({sector.from, sector.to, sector.near, at});
    }
  }
  return radius;
}

}  // namespace lekalo::verify
