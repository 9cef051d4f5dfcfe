// How far points of triangles are from a surface at most, and the bodies that are far from it: the checker's
// own code, against points that are looked at one by one.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "support/cases.hpp"
#include "support/solids.hpp"
#include "support/verify_solids.hpp"
#include "verify/solid/solid_near.hpp"
#include "verify/solid/triangle_distance.hpp"

namespace lekalo::verify::verify_solid_near_test {
namespace {

using cases::block;
using cases::checked;

std::vector<std::uint32_t> all_of(const SolidMesh& mesh) {
  std::vector<std::uint32_t> numbers(mesh.triangles.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

/// The distance of a point from the surface, triangle by triangle.
double distance_of(const Near3& p, const PlacedSolid& blank) {
  const Vec3 at{just(p[0]), just(p[1]), just(p[2])};
  double least = HUGE_VAL;
  for (std::uint32_t t = 0; t < blank.mesh().triangles.size(); ++t)
    least = std::min(least, distance({at, at, at}, blank.triangle(t)).low);
  return least;
}

/// The largest distance over a grid of each triangle, with its corners and edges.
double largest_of_grid(const SolidMesh& part, const PlacedSolid& blank, int steps) {
  double largest = 0;
  for (const auto& t : part.triangles)
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        Near3 p{};
        for (std::size_t axis = 0; axis < 3; ++axis)
          p[axis] = (i * part.near[t[0]][axis] + j * part.near[t[1]][axis] +
                     (steps - i - j) * part.near[t[2]][axis]) /
                    steps;
        largest = std::max(largest, distance_of(p, blank));
      }
  return largest;
}

/// More than any distance here: a search that refutes it would end early.
constexpr double kMuch = 1000;

SolidMesh triangle(const std::array<Near3, 3>& corners) {
  SolidMesh made;
  made.near = {corners[0], corners[1], corners[2]};
  made.triangles = {{0, 1, 2}};
  made.numbers = {0};
  return made;
}

TEST(SolidNear, TheFarthestPointIsEnclosedAsNearlyAsIsAskedFor) {
  const SolidMesh blank = checked(block({-6, -5, -4}, {6, 5, 4}));
  const PlacedSolid around(blank);
  Random random(cases::seed(), 71);
  const auto at = [&](double size) { return random.uniform(-size, size); };
  for (std::size_t i = 0; i < cases::case_count(12); ++i) {
    const double size = i % 3 == 0 ? 3.5 : 9;  // within the blank, or about its faces
    std::array<Near3, 3> corners{};
    for (Near3& corner : corners) corner = {at(size), at(size), at(size)};
    const SolidMesh part = triangle(corners);
    const double most = largest_of_grid(part, around, 40);
    for (const double within : {0.5, 0.02}) {
      const FarthestOf found = farthest_of(PlacedSolid(part), all_of(part), around, kMuch, within);
      EXPECT_FALSE(found.open);
      EXPECT_LE(most, found.high) << i;
      EXPECT_GE(most + 0.4, found.low) << i << "the grid is coarse";
      EXPECT_LE(found.low, found.high);
      EXPECT_LE(found.high - found.low, within) << i;
      // The farthest is told from what it is not, and no search goes farther than it has to.
      EXPECT_LE(farthest_of(PlacedSolid(part), all_of(part), around, found.high + 0.1, within).high,
                found.high + 0.1);
      if (found.low > 0.05) {
        EXPECT_GT(farthest_of(PlacedSolid(part), all_of(part), around, found.low - 0.05, 0.02).low,
                  found.low - 0.05);
      }
    }
  }
}

TEST(SolidNear, TheFarthestOfManyTrianglesIsThatOfAllOfThem) {
  const SolidMesh blank = checked(block({-6, -6, -6}, {6, 6, 6}));
  const PlacedSolid around(blank);
  SolidMesh part;
  for (int k = 0; k < 9; ++k) {
    const double z = (k * 5 % 9) / 2.0;  // the farthest is neither the first nor the last
    const auto first = static_cast<std::uint32_t>(part.near.size());
    for (const Near3& p : {Near3{-1, -1, z}, {1, -1, z}, {0, 1, z}}) part.near.push_back(p);
    part.triangles.push_back({first, first + 1, first + 2});
    part.numbers.push_back(static_cast<std::uint32_t>(k));
  }
  const FarthestOf found = farthest_of(PlacedSolid(part), all_of(part), around, kMuch, 1e-6);
  EXPECT_NEAR(found.low, 6, 1e-5) << "at z = 0, above the middle of the blank";
  EXPECT_NEAR(found.high, 6, 1e-5);
  const FarthestOf last = farthest_of(PlacedSolid(part), {7, 8}, around, kMuch, 1e-6);  // z = 4 and 2
  EXPECT_NEAR(last.high, 4, 1e-5);
}

TEST(SolidNear, AFaceThatLiesEvenlyDeepIsKnownAtOnce) {
  const SolidMesh blank = checked(block({-6, -6, -6}, {6, 6, 6})),
                  part = checked(block({-2, -2, 5}, {2, 2, 5.5}));
  const PlacedSolid around(blank), placed(part);
  const FarthestOf found = farthest_of(placed, all_of(part), around, 1 + 1e-9, 1e-6);
  EXPECT_FALSE(found.open);
  EXPECT_LE(found.high, 1 + 1e-9);
  EXPECT_NEAR(found.low, 1, 1e-9);
  // One that is said to the last digit is not told from it.
  EXPECT_TRUE(farthest_of(placed, all_of(part), around, 1, 1e-6).open);
  EXPECT_FALSE(farthest_of(placed, all_of(part), around, 0.999, 1e-6).open);
  EXPECT_GT(farthest_of(placed, all_of(part), around, 0.999, 1e-6).low, 0.999);
}

/// A right-angled triangle at a height, whose short sides are so long.
void add_level(SolidMesh& mesh, double z, double wide, double deep) {
  const auto first = static_cast<std::uint32_t>(mesh.near.size());
  for (const Near3& p : {Near3{0, 0, z}, {wide, 0, z}, {0, deep, z}}) mesh.near.push_back(p);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.numbers.push_back(first / 3);
}

TEST(SolidNear, TrianglesHaveAsManyPointsAsTheirAreasSay) {
  const SolidMesh blank = checked(block({-20, -20, -20}, {20, 20, 20}));
  const PlacedSolid around(blank);
  const auto deviation = [&](const SolidMesh& part, const std::vector<std::optional<double>>& targets) {
    const Span found = deviation_of(PlacedSolid(part), all_of(part), targets, around);
    EXPECT_LE(found.high - found.low, 1e-9);
    return found.low;
  };
  SolidMesh part;
  add_level(part, 18, 1, 1);  // 2 deep, a quarter of the area
  add_level(part, 19, 1, 3);  // 1 deep
  EXPECT_NEAR(deviation(part, {std::nullopt, std::nullopt}), std::sqrt(0.1875), 1e-9) << "1.25 is the mean";
  EXPECT_NEAR(deviation(part, {1.0, std::nullopt}), std::sqrt(0.25), 1e-9);
  EXPECT_NEAR(deviation(part, {2.0, 2.0}), std::sqrt(0.75), 1e-9);
  // What has no area has no points beside what has one.
  SolidMesh needles;
  add_level(needles, 17, 1, 0);
  EXPECT_NEAR(deviation(needles, {std::nullopt}), 0, 1e-9);
  EXPECT_NEAR(deviation(needles, {1.0}), 2, 1e-9);
  add_level(needles, 18, 1, 1);
  EXPECT_NEAR(deviation(needles, {1.0, 1.0}), 1, 1e-9);
}

/// The row of a certificate: a corner, three edges and a distance.
std::array<Decimal, 13> row_of(const std::array<Near3, 4>& vectors, double apart) {
  std::array<Decimal, 13> row;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      row[3 * k + axis] = cases::decimal(std::to_string(vectors[k][axis]));
  row[12] = cases::decimal(std::to_string(apart));
  return row;
}

std::string fault(const SolidMesh& blank, const std::array<Near3, 4>& vectors, double apart) {
  FarBody body;
  const PlacedSolid around(blank);
  return fault_of_body(around, row_of(vectors, apart), body).value_or("");
}

// Each side of a body counts, its edges in any order.
TEST(SolidNear, ABodyKeepsItsDistanceOnAllSides) {
  const SolidMesh blank = checked(block({-6, -6, -6}, {6, 6, 6}));
  std::array<std::size_t, 3> order{0, 1, 2};
  do {
    for (int corner = 0; corner < 8; ++corner)
      for (int side = 0; side < 7; ++side) {  // 6: none comes nearer
        Near3 low{-4, -4, -4}, high{4, 4, 4};
        if (side < 6) (side % 2 == 0 ? low : high)[side / 2U] += side % 2 == 0 ? -0.001 : 0.001;
        std::array<Near3, 4> body{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const bool from_high = (corner >> axis & 1) != 0;
          body[0][axis] = from_high ? high[axis] : low[axis];
          body[1 + order[axis]][axis] = from_high ? low[axis] - high[axis] : high[axis] - low[axis];
        }
        EXPECT_EQ(fault(blank, body, 2).find("comes nearer to it") != std::string::npos, side < 6)
            << corner << " " << side << " " << fault(blank, body, 2);
        EXPECT_EQ(fault(blank, body, 1.99), "");
      }
  } while (std::next_permutation(order.begin(), order.end()));
}

// What comes near the middle of a side is near that side alone.
TEST(SolidNear, ASmallBlankBesideASideIsNearIt) {
  const SolidMesh blank = checked(block({-1, -1, -1}, {1, 1, 1}));
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool above : {false, true}) {
      std::array<Near3, 4> body{{{-10, -10, -10}, {20, 0, 0}, {0, 20, 0}, {0, 0, 20}}};
      body[0][axis] = above ? 1.5 : -21.5;
      EXPECT_NE(fault(blank, body, 0.6), "") << axis << above;
      EXPECT_EQ(fault(blank, body, 0.4), "") << axis << above;
    }
}

TEST(SolidNear, ALeaningBodyIsWhatItsEdgesSpan) {
  const SolidMesh blank = checked(block({-6, -6, -6}, {6, 6, 6}));
  // Its top leans over by 3 along x and 2 along y.
  const std::array<Near3, 4> body{{{-4, -4, -4}, {4, 0, 0}, {0, 5, 0}, {3, 2, 8}}};
  EXPECT_EQ(fault(blank, body, 2), "");
  for (const std::size_t edge : {1U, 2U, 3U})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<Near3, 4> longer = body;
      longer[edge][axis] += 10;
      EXPECT_NE(fault(blank, longer, 2), "") << edge << axis;
      longer = body;
      longer[edge][axis] -= 20;
      EXPECT_NE(fault(blank, longer, 2), "") << edge << axis;
    }
  FarBody made;
  EXPECT_EQ(fault_of_body(PlacedSolid(blank), row_of(body, 2), made), std::nullopt);
  EXPECT_TRUE(made.apart == 2);
  // The sides hold the corners, exactly: four on each.
  for (const FarBody::Side& side : made.sides) {
    int on = 0;
    for (int k = 0; k < 8; ++k) {
      Exact3 p{Fraction(body[0][0]), Fraction(body[0][1]), Fraction(body[0][2])};
      for (std::size_t edge = 0; edge < 3; ++edge)
        if ((k >> edge & 1) != 0)
          for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += Fraction(body[1 + edge][axis]);
      EXPECT_TRUE(dot(side.normal, p) >= side.level);
      if (dot(side.normal, p) == side.level) ++on;
    }
    EXPECT_EQ(on, 4);
  }
}

TEST(SolidNear, BodiesThatAreNoneAreRefused) {
  const SolidMesh blank = checked(block({-6, -6, -6}, {6, 6, 6}));
  const std::array<Near3, 4> body{{{-4, -4, -4}, {8, 0, 0}, {0, 8, 0}, {0, 0, 8}}};
  EXPECT_EQ(fault(blank, body, 0), "its distance is not above 0");
  EXPECT_EQ(fault(blank, body, -1), "its distance is not above 0");
  EXPECT_EQ(fault(blank, body, 2), "");
  std::array<Near3, 4> flat = body;
  flat[3] = {8, 8, 0};
  EXPECT_EQ(fault(blank, flat, 1), "it is flat");
  // A cavity that lies in it whole.
  EXPECT_EQ(fault(blank, {{{-40, -40, -40}, {80, 0, 0}, {0, 80, 0}, {0, 0, 80}}}, 2),
            "a surface of the blank lies in it");
  EXPECT_EQ(fault(blank, {{{-40, -40, 8}, {80, 0, 0}, {0, 80, 0}, {0, 0, 80}}}, 2), "") << "beside it";
  EXPECT_NE(fault(blank, {{{-40, -40, 7}, {80, 0, 0}, {0, 80, 0}, {0, 0, 80}}}, 2), "") << "too near";
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_near_test
