// The clearance of a mesh in a mesh against every pair of triangles, measured feature by feature in long
// double.

#include "lekalo/solid/mesh_clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "support/cases.hpp"
#include "support/solid_cases.hpp"

namespace lekalo::solid_mesh_clearance_test {
namespace {

using solid::Mesh;
using solid::MeshClearance;
using solid::Motion;
using solid::Vector;
using Real = long double;
using Wide = std::array<Real, 3>;
using Corners = std::array<Wide, 3>;

Wide wide(Vector p) { return {p.x, p.y, p.z}; }
Wide minus(const Wide& a, const Wide& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Real dot(const Wide& a, const Wide& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Wide cross(const Wide& a, const Wide& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real length(const Wide& a) { return std::sqrt(dot(a, a)); }

/// A vertex above the inside of a triangle, by its height.
void look_at_face(Real& least, const Wide& p, const Corners& t) {
  const Wide n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  for (std::size_t k = 0; k < 3; ++k)
    if (dot(cross(minus(t[(k + 1) % 3], t[k]), minus(p, t[k])), n) < 0) return;
  least = std::min(least, std::abs(dot(n, minus(p, t[0]))) / length(n));
}

/// A vertex beside the inside of an edge, and beside its end.
void look_at_edge(Real& least, const Wide& p, const Wide& a, const Wide& b) {
  const Wide ab = minus(b, a), ap = minus(p, a);
  least = std::min(least, length(ap));
  if (dot(ab, ap) > 0 && dot(ab, minus(p, b)) < 0)
    least = std::min(least, length(cross(ab, ap)) / length(ab));
}

/// Two edges that pass each other, by their common perpendicular.
void look_at_passing(Real& least, const Wide& a, const Wide& b, const Wide& c, const Wide& d) {
  const Wide u = minus(b, a), v = minus(d, c), n = cross(u, v), un = cross(u, n), vn = cross(v, n);
  if (!(length(n) > 0)) return;
  const auto sides = [](Real x, Real y) { return (x > 0) != (y > 0); };
  if (!sides(dot(vn, minus(a, c)), dot(vn, minus(b, c))) ||
      !sides(dot(un, minus(c, a)), dot(un, minus(d, a))))
    return;
  least = std::min(least, std::abs(dot(n, minus(c, a))) / length(n));
}

/// An edge that goes through a triangle.
void look_through(Real& least, const Wide& a, const Wide& b, const Corners& t) {
  const Wide n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const Real from = dot(n, minus(a, t[0])), to = dot(n, minus(b, t[0]));
  if ((from > 0) == (to > 0)) return;
  Wide p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + from / (from - to) * (b[k] - a[k]);
  for (std::size_t k = 0; k < 3; ++k)
    if (dot(cross(minus(t[(k + 1) % 3], t[k]), minus(p, t[k])), n) < 0) return;
  least = 0;
}

Real distance(const Corners& a, const Corners& b) {
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    look_at_face(least, a[i], b);
    look_at_face(least, b[i], a);
    look_through(least, a[i], a[(i + 1) % 3], b);
    look_through(least, b[i], b[(i + 1) % 3], a);
    for (std::size_t j = 0; j < 3; ++j) {
      look_at_edge(least, a[i], b[j], b[(j + 1) % 3]);
      look_at_edge(least, b[i], a[j], a[(j + 1) % 3]);
      look_at_passing(least, a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]);
    }
  }
  return least;
}

Wide moved(const Motion& motion, Vector p) {
  const auto along = [&](Vector row, double shift) {
    return Real(row.x) * p.x + Real(row.y) * p.y + Real(row.z) * p.z + shift;
  };
  return {along(motion.rotation[0], motion.shift.x), along(motion.rotation[1], motion.shift.y),
          along(motion.rotation[2], motion.shift.z)};
}

/// The least of the distances less widths of the blank's triangles.
Real brute_force(const Mesh& part, const Mesh& blank, const std::vector<double>& widths,
                 const Motion& motion) {
  Real least = std::numeric_limits<Real>::infinity();
  for (const solid::Triangle& p : part.triangles)
    for (std::size_t k = 0; k < blank.triangles.size(); ++k) {
      const solid::Triangle& b = blank.triangles[k];
      const Real apart =
          distance({moved(motion, part.vertices[p[0]]), moved(motion, part.vertices[p[1]]),
                    moved(motion, part.vertices[p[2]])},
                   {wide(blank.vertices[b[0]]), wide(blank.vertices[b[1]]), wide(blank.vertices[b[2]])});
      least = std::min(least, apart - (widths.empty() ? 0 : widths[k]));
    }
  return least;
}

cases::SolidCase some_case(Random& random) {
  switch (random.below(4)) {
    case 0:
      return cases::convex_in_convex(random, 12, 1.5, true);
    case 1:
      return cases::cored_block(random, 3);
    case 2:
      return cases::turned_part(random, 12);
    default:
      return cases::wavy_part(random, 8);
  }
}

Motion near(const Motion& there, Random& random, double angle, double shift) {
  const Motion off = cases::small_motion(random, angle, shift);
  Motion both;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector row = off.rotation[k];
    both.rotation[k] = row.x * there.rotation[0] + (row.y * there.rotation[1] + row.z * there.rotation[2]);
  }
  both.shift = off(there.shift);
  return both;
}

TEST(MeshClearance, IsTheLeastDistanceOfAllPairsOfTriangles) {
  Random random(cases::seed(), 51);
  std::size_t apart = 0, crossing = 0;
  for (std::size_t i = 0; i < cases::case_count(8); ++i) {
    const cases::SolidCase pair = some_case(random);
    for (const Mesh& mesh : {pair.part, pair.blank}) {
      const auto closed = solid::closed_mesh(mesh);
      ASSERT_TRUE(closed) << pair.kind << ": " << closed.error().message;
      EXPECT_EQ(closed->mesh.vertices.size(), mesh.vertices.size()) << pair.kind;
    }
    std::vector<double> widths;
    if (random.below(2) == 0)
      for (std::size_t k = 0; k < pair.blank.triangles.size(); ++k) widths.push_back(random.uniform(0, 0.3));
    const MeshClearance meter(pair.part, pair.blank, widths);
    std::optional<solid::NearPair> before;
    for (int k = 0; k < 3; ++k) {
      const Motion motion = k == 0 ? pair.there : near(pair.there, random, 0.02, 0.5 * k);
      const auto exact = static_cast<double>(brute_force(pair.part, pair.blank, widths, motion));
      const auto found =
          meter.nearest(motion, std::numeric_limits<double>::infinity(), before ? &*before : nullptr);
      ASSERT_TRUE(found);
      EXPECT_LE(found->low, exact) << pair.kind;
      EXPECT_GE(found->high, exact) << pair.kind;
      if (exact > 1e-9) {
        EXPECT_LT(found->high - found->low, 1e-8) << pair.kind;  // some triangles are thin
        ++apart;
      } else if (widths.empty()) {
        EXPECT_LE(found->low, 0) << pair.kind;
        EXPECT_LT(found->high, 1e-9) << pair.kind;
        ++crossing;
      }
      const double width = widths.empty() ? 0 : widths[found->blank_triangle];
      EXPECT_NEAR(norm(found->part - found->blank) - width, found->high, 1e-9);
      EXPECT_FALSE(meter.nearest(motion, found->low - 1e-9));
      std::vector<solid::NearPair> pieces;
      meter.nearest_by_piece(motion, exact + 0.5, pieces);
      double least = 1e300;
      for (const solid::NearPair& piece : pieces) least = std::min(least, piece.high);
      EXPECT_NEAR(least, found->high, 1e-11);
      before = found;
    }
  }
  EXPECT_GT(apart, 5u);
  EXPECT_GT(crossing, 1u);
}

TEST(MeshClearance, KnownStockIsFound) {
  Random random(cases::seed(), 52);
  for (std::size_t i = 0; i < cases::case_count(10); ++i) {
    const double stock = random.uniform(0.5, 3);
    const cases::SolidCase pair = cases::convex_in_convex(random, 20, stock);
    const MeshClearance meter(pair.part, pair.blank);
    EXPECT_TRUE(meter.inside(pair.there));
    EXPECT_NEAR(meter.nearest(pair.there)->high, stock, 1e-9);
  }
}

TEST(MeshClearance, APartBesideTheBlankOrAroundACoreIsNotInside) {
  const Mesh part = cases::block({0, 0, 0}, {10, 10, 10});
  const MeshClearance meter(part, cases::block({-1, -1, -1}, {11, 11, 11}));
  EXPECT_TRUE(meter.inside({}));
  EXPECT_NEAR(meter.nearest({})->low, 1, 1e-12);
  Motion beside;
  beside.shift = {20, 0, 0};
  EXPECT_FALSE(meter.inside(beside));
  // The surfaces are 3 mm apart or more, but the part swallows the void.
  Mesh hollow = cases::block({-5, -5, -5}, {15, 15, 15});
  cases::append(hollow, cases::block({4, 4, 4}, {6, 6, 6}));
  const MeshClearance swallowed(part, hollow);
  EXPECT_GT(swallowed.nearest({})->low, 3);
  EXPECT_FALSE(swallowed.inside({}));
  // Half of the part lies beside the blank.
  Mesh two = part;
  cases::append(two, cases::block({30, 0, 0}, {35, 5, 5}));
  EXPECT_FALSE(MeshClearance(two, cases::block({-1, -1, -1}, {11, 11, 11})).inside({}));
}

}  // namespace
}  // namespace lekalo::solid_mesh_clearance_test
