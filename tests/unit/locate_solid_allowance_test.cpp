#include <gtest/gtest.h>

#include <cmath>

#include "lekalo/locate/solid_allowance.hpp"
#include "support/solids.hpp"

namespace lekalo::locate::solid_allowance_test {
namespace {

using solid::Vector;

double area(const solid::Mesh& mesh, const solid::Triangle& t) {
  const Vector a = mesh.vertices[t[0]];
  return 0.5 * norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
}

TEST(SolidAllowance, CutsLongEdgesAndKeepsTheSurface) {
  const solid::Mesh part = cases::block({0, 0, 0}, {40, 3, 20}),
                    blank = cases::block({-2, -2, -2}, {42, 5, 21});
  const MeasuredPart measured = measured_part(part, blank, {}, 3000);
  EXPECT_GT(measured.mesh.triangles.size(), 1000U);
  EXPECT_LT(measured.mesh.triangles.size(), 12'000U);
  ASSERT_EQ(measured.numbers.size(), measured.mesh.triangles.size());
  ASSERT_EQ(measured.allowances.size(), measured.mesh.vertices.size());
  // It closes, and each triangle lies in that of the part whose number it has.
  const auto closed = solid::closed_mesh(measured.mesh);
  ASSERT_TRUE(closed.has_value()) << closed.error().message;
  EXPECT_EQ(closed->mesh.triangles, measured.mesh.triangles) << "and looks outwards";
  std::vector<double> areas(part.triangles.size());
  for (std::size_t k = 0; k < measured.mesh.triangles.size(); ++k)
    areas[measured.numbers[k]] += area(measured.mesh, measured.mesh.triangles[k]);
  for (std::size_t k = 0; k < areas.size(); ++k)
    EXPECT_NEAR(areas[k], area(part, part.triangles[k]), 1e-9) << k;
  EXPECT_TRUE(std::equal(part.vertices.begin(), part.vertices.end(), measured.mesh.vertices.begin()));
}

TEST(SolidAllowance, IsTheDistanceToTheBlankAndNegativeOutside) {
  const solid::Mesh part = cases::block({0, 0, 0}, {40, 30, 20}),
                    blank = cases::block({-2, -2, -2}, {42, 32, 21});
  solid::Motion motion;
  motion.shift = {0, 0, 3};  // 2 mm out of the top
  const MeasuredPart measured = measured_part(part, blank, motion, 3000);
  for (std::size_t v = 0; v < measured.allowances.size(); ++v) {
    const Vector p = motion(measured.mesh.vertices[v]);
    const double inside = std::min({p.x + 2, 42 - p.x, p.y + 2, 32 - p.y, p.z + 2, 21 - p.z});
    EXPECT_NEAR(measured.allowances[v], inside, 1e-9) << v;
    EXPECT_LE(measured.allowances[v], inside) << v;
  }
  for (const unsigned threads : {1U, 3U})
    EXPECT_EQ(measured_part(part, blank, motion, 3000, threads).allowances, measured.allowances);
}

TEST(SolidAllowance, OfAPointIsItsDistanceFromThePlacedPartAndNegativeInIt) {
  const solid::Mesh part = cases::block({0, 0, 0}, {40, 30, 20});
  solid::Motion motion;
  motion.rotation = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};  // x becomes y
  motion.shift = {100, 0, 3};
  const std::vector<Vector> points{{75, 20, 25}, {75, 20, 1}, {75, 20, 21.5}, {60, 20, 10}, {97, 44, 23}};
  const std::vector<double> expected{2, 2, -1.5, 10, 4};
  const std::vector<double> found = deviations_from(part, motion, points);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(found[k], expected[k], 1e-9) << k;
    EXPECT_LE(found[k], expected[k]) << k;
  }
  std::vector<Vector> many;
  for (int k = 0; k < 2000; ++k) many.push_back({0.05 * k, 0.01 * k, 10});
  for (const unsigned threads : {1U, 3U})
    EXPECT_EQ(deviations_from(part, motion, many, threads), deviations_from(part, motion, many));
}

TEST(SolidAllowance, LeavesFinePartsAsTheyAre) {
  const solid::Mesh part = cases::block({0, 0, 0}, {1, 1, 1}), blank = cases::block({-1, -1, -1}, {2, 2, 2});
  const MeasuredPart measured = measured_part(part, blank, {}, 2);
  EXPECT_EQ(measured.mesh.triangles, part.triangles);
  for (const double allowance : measured.allowances) EXPECT_NEAR(allowance, 1, 1e-12);
}

}  // namespace
}  // namespace lekalo::locate::solid_allowance_test
