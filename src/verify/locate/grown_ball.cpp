#include "grown_ball.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "verify/number/span.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/stretch.hpp"

namespace lekalo::verify {
namespace {

/// One ball is looked at in at most this many pieces of sides.
constexpr std::size_t kMostBallPieces = 256;
/// A ball that is too large by no more than this, relatively, is made smaller at once.
constexpr double kTouching = 1e-13;
/// A piece is narrow enough when every corner's direction is off their mean by an angle with a cosine above
/// it.
constexpr double kNarrow = 0.9;

/// The corners of a convex set.
struct Hull {
  std::array<Vec, 6> at;
  std::size_t count = 0;
};

/// Returns a distance that no point of the hull exceeds from the side.
double farthest(const Hull& hull, const Side& side) {
  // The distance from one point is a convex function, and so is the distance from a line: both are largest in
  // a corner.
  double to_point = kInfinity;
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
  if (!faces || !(length(sum).low > 0)) return to_point;
  const Vec along = unit(sum);
  double outside = 0, inside = 0;
  for (std::size_t i = 0; i < hull.count; ++i) {
    const Vec d = hull.at[i] - side.centre;
    outside = std::max(outside, (length(d) - side.radius).high);
    inside = std::max(inside, (side.radius - dot(d, along)).high);
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
  hull.count = 0;
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

}  // namespace lekalo::verify
