#include "solid_near.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lekalo/base/stop.hpp"
#include "triangle_distance.hpp"

namespace lekalo::verify {
namespace {

/// Enclosures do not tell a distance from one that is this part of it; results say more than that.
constexpr double kNearlySaid = 1 - 0x1p-40;
/// So many pieces of triangles are looked at before it is given up.
constexpr std::size_t kMostPieces = 2'000'000;

/// The surface of the body, as a mesh of its own: corner k is at the end of a, b and c as the bits of k say.
SolidMesh surface_of(const std::array<Decimal, 13>& row) {
  SolidMesh made;
  for (std::size_t k = 0; k < 8; ++k) {
    std::array<Decimal, 3> place{row[0], row[1], row[2]};
    for (std::size_t edge = 0; edge < 3; ++edge)
      if ((k >> edge & 1) != 0)
        for (std::size_t axis = 0; axis < 3; ++axis)
          place[axis] = place[axis] - (Decimal{} - row[3 + 3 * edge + axis]);
    made.near.push_back({approximate(place[0]), approximate(place[1]), approximate(place[2])});
    made.written.push_back(std::move(place));
  }
  for (std::uint32_t edge = 0; edge < 3; ++edge)
    for (const std::uint32_t from : {0U, 1U << edge}) {
      const std::uint32_t a = 1U << (edge + 1) % 3, b = 1U << (edge + 2) % 3;
      made.triangles.push_back({from, from + a, from + a + b});
      made.triangles.push_back({from, from + a + b, from + b});
    }
  return made;
}

/// The nearest triangle to a point, and the distance.
struct NearestTriangle {
  std::uint32_t number = 0;
  Span distance{kInfinity, kInfinity};
};

NearestTriangle nearest_to(const Vec3& p, const PlacedSolid& body) {
  const BoxTree point({box_of(p)});
  NearestTriangle found;
  double limit = kInfinity, low = kInfinity;
  point.visit_pairs(body.tree(), limit, [&](std::uint32_t, std::uint32_t number) {
    const Span apart = distance({p, p, p}, body.triangle(number), limit);
    low = std::min(low, apart.low);
    if (!(apart.high < found.distance.high)) return;
    found = {number, apart};
    limit = apart.high;
  });
  found.distance.low = std::min(low, found.distance.high);
  return found;
}

/// Some points all over triangles, by area: of which triangle each is, and where as placed.
constexpr int kSpreadPoints = 600;
struct SpreadPoint {
  std::size_t triangle = 0;  ///< by its place in the list
  Vec3 at{};
};

double middle_of(Span a) { return 0.5 * (a.low + a.high); }

std::vector<SpreadPoint> spread_points(const PlacedSolid& part, const std::vector<std::uint32_t>& triangles) {
  const SolidMesh& mesh = part.mesh();
  std::vector<double> ends;
  double all = 0;
  for (const std::uint32_t t : triangles) {
    ask();
    Triangle3 at{};
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        at[corner][axis] = mesh.enclosed(mesh.triangles[t][corner], axis);
    all += middle_of(length(normal(at)));
    ends.push_back(all);
  }
  std::vector<SpreadPoint> made;
  std::size_t k = 0;
  for (int n = 0; n < kSpreadPoints; ++n) {
    const double along = (n + 0.4142) / kSpreadPoints * all;
    while (k + 1 < ends.size() && !(along < ends[k])) ++k;
    // The order of the corners is that of their places in the part's file, whichever way it names them.
    std::array<std::uint32_t, 3> v = mesh.triangles[triangles[k]];
    std::ranges::sort(v, {}, [&](std::uint32_t one) { return mesh.near[one]; });
    const double first = (n + 1) * 0.7548776662466927, second = (n + 1) * 0.5698402909980532;
    const double u = std::sqrt(first - std::floor(first)), w = second - std::floor(second);
    const Vec3 a = part.at(v[0]);
    made.push_back({k, a + (part.at(v[1]) - a) * just(u * (1 - w)) + (part.at(v[2]) - a) * just(u * w)});
  }
  return made;
}

struct Piece {
  Triangle3 at{};
  double high = 0;
};

Vec3 between(const Vec3& a, const Vec3& b) { return (a + b) * just(0.5); }

}  // namespace

std::optional<std::string> fault_of_body(const PlacedSolid& blank, const std::array<Decimal, 13>& row,
                                         FarBody& body) {
  std::array<Exact3, 4> v;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) v[k][axis] = to_fraction(row[3 * k + axis]);
  const Exact3& at = v[0];
  const int side = sgn(dot(v[1], cross(v[2], v[3])));
  if (side == 0) return "it is flat";
  body.apart = to_fraction(row[12]);
  if (sgn(body.apart) <= 0) return "its distance is not above 0";
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const Exact3 n = cross(v[1 + (edge + 1) % 3], v[1 + (edge + 2) % 3]) * Fraction(side);
    body.sides[2 * edge] = {n, dot(n, at)};
    const Exact3 back = n * Fraction(-1);
    body.sides[2 * edge + 1] = {back, dot(back, at + v[1 + edge])};
  }
  const SolidMesh surface = surface_of(row);
  const PlacedSolid placed(surface);
  std::optional<std::string> fault;
  const double limit = enclosed(body.apart).high;
  double reach = limit;
  placed.tree().visit_pairs(blank.tree(), reach, [&](std::uint32_t a, std::uint32_t b) {
    if (distance(placed.triangle(a), blank.triangle(b), limit).low > limit) return;
    if (exact_distance(placed.exact_triangle(a), blank.exact_triangle(b)).squared >= body.apart * body.apart)
      return;
    fault = fmt::format("triangle {} of the blank comes nearer to it", blank.mesh().numbers[b]);
    reach = -kInfinity;
  });
  if (fault) return fault;
  for (const std::uint32_t v0 : blank.one_of_each_component()) {
    ask();
    const Exact3 p = blank.exactly_at(v0);
    if (std::ranges::all_of(body.sides,
                            [&](const FarBody::Side& one) { return dot(one.normal, p) >= one.level; }))
      return "a surface of the blank lies in it";
  }
  return std::nullopt;
}

FarthestOf farthest_of(const PlacedSolid& part, const std::vector<std::uint32_t>& triangles,
                       const PlacedSolid& blank, double said, double within) {
  FarthestOf made;
  std::vector<Piece> open;
  std::size_t looked = 0;
  const auto is_lower = [](const Piece& a, const Piece& b) { return a.high < b.high; };
  // No point of a piece is farther from the triangle that is nearest to its middle than its corners are, as
  // the distance from a triangle is convex; nor farther from the surface than its middle, and the way from
  // there.
  const auto add = [&](const Triangle3& at) {
    ask();
    ++looked;
    const Vec3 middle = (at[0] + at[1] + at[2]) * (just(1) / just(3));
    const NearestTriangle near = nearest_to(middle, blank);
    double of_corners = 0, way = 0;
    for (const Vec3& corner : at) {
      of_corners = std::max(of_corners, distance({corner, corner, corner}, blank.triangle(near.number)).high);
      way = std::max(way, length(corner - middle).high);
    }
    made.low = std::max(made.low, near.distance.low);
    open.push_back({at, std::min(of_corners, (near.distance + just(way)).high)});
    std::ranges::push_heap(open, is_lower);
  };
  for (const std::uint32_t t : triangles) add(part.triangle(t));
  while (open.front().high > said || open.front().high > made.low + within) {
    if (looked > kMostPieces || made.low > said * kNearlySaid) {
      made.open = !(made.low > said);
      break;
    }
    std::ranges::pop_heap(open, is_lower);
    const Triangle3 at = open.back().at;
    open.pop_back();
    std::size_t longest = 0;
    double most = -1;
    for (std::size_t k = 0; k < 3; ++k)
      if (const double far = length(at[(k + 1) % 3] - at[k]).high; far > most) most = far, longest = k;
    const Vec3 &a = at[longest], &b = at[(longest + 1) % 3], &c = at[(longest + 2) % 3], m = between(a, b);
    add({a, m, c});
    add({m, b, c});
  }
  made.high = std::max(made.low, open.front().high);
  return made;
}

Span deviation_of(const PlacedSolid& part, const std::vector<std::uint32_t>& triangles,
                  const std::vector<std::optional<double>>& targets, const PlacedSolid& blank) {
  const std::vector<SpreadPoint> points = spread_points(part, triangles);
  std::vector<Span> apart;
  Span mean = just(0), squares = just(0);
  int free = 0;
  for (const SpreadPoint& one : points) {
    ask();
    apart.push_back(nearest_to(one.at, blank).distance);
    if (!targets[one.triangle]) mean = mean + apart.back(), ++free;
  }
  // Nothing reads it where no point is free.
  mean = mean * (just(1) / just(free));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto& target = targets[points[k].triangle];
    squares = squares + squared(apart[k] - (target ? just(*target) : mean));
  }
  return square_root(squares * (just(1) / just(kSpreadPoints)));
}

std::optional<std::string> fault_of_farthest(const PlacedSolid& part,
                                             const std::vector<std::uint32_t>& triangles,
                                             const PlacedSolid& blank, Span said, double slack, double within,
                                             bool& is_open) {
  const FarthestOf is = farthest_of(part, triangles, blank, said.low, within);
  if (is.low > said.low || said.high > is.high + slack)
    return fmt::format("is said to be {}, but it is {}", said.low, is.low > said.low ? is.low : is.high);
  is_open = is.open;
  return std::nullopt;
}

}  // namespace lekalo::verify
