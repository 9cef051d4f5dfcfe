// The checker of solids against slower ways of its own kind, and against the solids of the makers.

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/solid/triangle_tree.hpp"
#include "support/cases.hpp"
#include "support/solids.hpp"
#include "support/verify_solids.hpp"
#include "verify/solid/triangle_distance.hpp"

namespace lekalo::verify::verify_solid_test {
namespace {

/// The square of the distance of the origin from the hull of points, by looking at each simplex of them: the
/// nearest place of its flat counts where it lies in the simplex.
Fraction least_square(const std::vector<Exact3>& points) {
  std::optional<Fraction> least;
  const auto look = [&](const std::vector<Exact3>& s) {
    // sum shares = 1 and the place is upright to each edge from s[0]: the shares of the others solve G x = r.
    const std::size_t n = s.size() - 1;
    std::vector<std::vector<Fraction>> rows(n, std::vector<Fraction>(n + 1));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) rows[i][j] = dot(s[i + 1] - s[0], s[j + 1] - s[0]);
      rows[i][n] = -dot(s[i + 1] - s[0], s[0]);
    }
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t pivot = k;
      while (pivot < n && sgn(rows[pivot][k]) == 0) ++pivot;
      if (pivot == n) return;
      std::swap(rows[k], rows[pivot]);
      for (std::size_t i = 0; i < n; ++i) {
        if (i == k) continue;
        const Fraction factor = rows[i][k] / rows[k][k];
        for (std::size_t j = k; j <= n; ++j) rows[i][j] -= factor * rows[k][j];
      }
    }
    Fraction first = 1;
    Exact3 place = s[0];
    for (std::size_t k = 0; k < n; ++k) {
      const Fraction share = rows[k][n] / rows[k][k];
      if (share < 0) return;
      first -= share;
      place = place + (s[k + 1] - s[0]) * share;
    }
    if (first < 0) return;
    const Fraction square = dot(place, place);
    if (!least || square < *least) least = square;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    look({points[i]});
    for (std::size_t j = 0; j < i; ++j) {
      look({points[i], points[j]});
      for (std::size_t k = 0; k < j; ++k) {
        look({points[i], points[j], points[k]});
        for (std::size_t l = 0; l < k; ++l) look({points[i], points[j], points[k], points[l]});
      }
    }
  }
  return *least;
}

Fraction slow_square(const ExactTriangle& a, const ExactTriangle& b) {
  std::vector<Exact3> differences;
  for (const Exact3& p : a)
    for (const Exact3& q : b) differences.push_back(p - q);
  return least_square(differences);
}

Triangle3 enclosed(const ExactTriangle& t) {
  Triangle3 made{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double cut = cut_to_double(t[k][axis]);
      made[k][axis] = outwards(cut, cut);
    }
  return made;
}

TEST(TriangleDistance, IsThatOfTheHullOfDifferences) {
  Random random(cases::seed());
  std::size_t zero = 0;
  for (std::size_t n = 0; n < cases::case_count(60); ++n) {
    // On a coarse lattice triangles touch, lie in one plane, and shrink to lines and points.
    const std::uint64_t steps = n % 3 == 0 ? 3 : 40;
    ExactTriangle a, b;
    for (ExactTriangle* t : {&a, &b})
      for (Exact3& p : *t)
        for (Fraction& x : p)
          x = Fraction(static_cast<long>(random.below(steps)), n % 2 == 0 ? 1 : 7), x.canonicalize();
    const Fraction slow = slow_square(a, b);
    const ExactDistance fast = exact_distance(a, b);
    EXPECT_TRUE(fast.squared == slow) << "seed " << cases::seed() << ", case " << n << ": "
                                      << fast.squared.get_str() << " and " << slow.get_str();
    EXPECT_TRUE(!fast.pierces || sgn(slow) == 0) << n;
    zero += sgn(slow) == 0 ? 1 : 0;
    const Span apart = distance(enclosed(a), enclosed(b));
    EXPECT_TRUE(Fraction(apart.low) * Fraction(apart.low) <= slow) << n;
    EXPECT_TRUE(Fraction(apart.high) * Fraction(apart.high) >= slow) << n;
    EXPECT_LT(apart.high - apart.low, 1e-11) << n;
    const Span limited = distance(enclosed(a), enclosed(b), apart.high / 2);
    EXPECT_TRUE(Fraction(limited.low) * Fraction(limited.low) <= slow) << n;
  }
  EXPECT_GT(zero, cases::case_count(60) / 20);
}

/// A decimal of 30 places at or below a root.
std::string root_below(const Fraction& square, int more) {
  Integer scaled = square.get_num() * power_of_ten(60) / square.get_den();
  Integer root = sqrt(scaled) + more;
  std::string digits = root.get_str();
  return digits + "e-30";
}

TEST(SolidClearance, IsTheLeastOfAllPairsToThirtyPlaces) {
  Random random(cases::seed() + 1);
  std::size_t apart = 0, inside = 0;
  for (std::size_t n = 0; n < cases::case_count(8); ++n) {
    const auto coordinate = [&](std::uint64_t steps) { return static_cast<double>(random.below(steps)) / 4; };
    solid::Mesh part = cases::block({0, 0, 0}, {1 + coordinate(8), 1 + coordinate(8), 1 + coordinate(8)});
    // A pyramid, whose edges are skew to those of the part.
    solid::Mesh blank;
    const double wide = n % 4 == 0 ? 9 : 40;
    blank.vertices = {{-wide, -wide, -wide / 2},
                      {wide, -wide, -wide / 2},
                      {wide, wide, -wide / 2},
                      {-wide, wide, -wide / 2},
                      {coordinate(8), coordinate(8), wide}};
    blank.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    const auto digit = [&] { return std::to_string(static_cast<int>(random.below(9)) - 4); };
    const SolidPose pose = cases::solid_pose({"5", digit(), digit(), digit()}, {digit(), "0.1", "0.3"});
    const SolidMesh p = cases::checked(part), b = cases::checked(blank);
    const PlacedSolid placed(p, SolidMotion(pose)), still(b);
    std::optional<Fraction> least;
    for (std::uint32_t i = 0; i < p.triangles.size(); ++i)
      for (std::uint32_t j = 0; j < b.triangles.size(); ++j) {
        const Fraction square = slow_square(placed.exact_triangle(i), still.exact_triangle(j));
        if (!least || square < *least) least = square;
      }
    bool in = true;
    for (std::uint32_t v = 0; v < p.near.size(); ++v)
      in = in && still.holds(placed.at(v), placed.exactly_at(v));
    if (sgn(*least) == 0) continue;
    ++apart;
    inside += in ? 1 : 0;
    if (in) {
      EXPECT_EQ(cases::answer(p, b, pose, root_below(*least, 0)), "shown") << n;
    } else {
      EXPECT_NE(cases::answer(p, b, pose, "0").find("lies outside"), std::string::npos) << n;
    }
    EXPECT_NE(cases::answer(p, b, pose, root_below(*least, 1)).find("fault: "), std::string::npos) << n;
  }
  EXPECT_GT(apart, cases::case_count(8) / 4);
  EXPECT_GT(inside, 0u);
}

TEST(SolidClearance, InsideAndNearestAgreeWithTheMakers) {
  Random random(cases::seed() + 2);
  for (std::size_t n = 0; n < cases::case_count(6); ++n) {
    const solid::Mesh ring = cases::ring(random, 24, 12, 10, 4);
    const solid::TriangleTree tree(ring);
    const SolidMesh mesh = cases::checked(ring);
    const PlacedSolid body(mesh);
    for (std::size_t k = 0; k < 300; ++k) {
      // Every other point lies right below a vertex or the middle of an edge.
      solid::Vector p{random.uniform(-16, 16), random.uniform(-16, 16), random.uniform(-6, 6)};
      const auto& t = ring.triangles[random.below(ring.triangles.size())];
      const solid::Vector u = ring.vertices[t[0]], v = ring.vertices[t[1]];
      if (k % 4 == 1) p = {u.x, u.y, p.z};
      if (k % 4 == 3) p = {(u.x + v.x) / 2, (u.y + v.y) / 2, p.z};
      EXPECT_EQ(body.holds({just(p.x), just(p.y), just(p.z)}, {Fraction(p.x), Fraction(p.y), Fraction(p.z)}),
                tree.holds(p))
          << "case " << n << ", point " << k;
    }
    solid::Mesh small = cases::ring(random, 24, 12, 10, 2);
    const SolidMesh part = cases::checked(small);
    const SolidPose pose = cases::unturned({"0.125", "0.25", "0.5"});
    const auto pair = SolidPair::make(part, mesh, pose);
    ASSERT_TRUE(pair);
    const SolidAnswer said = pair->check(cases::decimal("0"));
    double least = 1e9;
    for (const solid::Vector q : small.vertices)
      least = std::min(least, tree.nearest(q + solid::Vector{0.125, 0.25, 0.5})->high);
    EXPECT_LE(said.least.low, least);
    EXPECT_GE(said.least.high, said.least.low);
    EXPECT_LT(said.least.high - said.least.low, 1e-11);
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_test
