// Voxels with cut cells: shares, walls and what a cutter takes away, against areas and volumes known exactly.

#include "lekalo/heat/body.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lekalo::heat_body_test {
namespace {

using heat::Body;
using heat::Grid;
using heat::Place;

constexpr double kPi = 3.14159265358979323846;

double wall_of(const Body& body) {
  double sum = 0;
  for (std::size_t n = 0; n < body.grid().size(); ++n) sum += body.wall(n);
  return sum;
}

TEST(Grid, PitchesFitTheBoxAndTooManyVoxelsAreRefused) {
  const Grid grid = *Grid::divide({-10, 0, -20.5}, {110, 100, 0}, 2);
  EXPECT_EQ(grid.count, (std::array<std::size_t, 3>{60, 50, 10}));
  EXPECT_DOUBLE_EQ(grid.pitch.z, 2.05);
  EXPECT_EQ(grid.voxel_of({-9, 99.5, -500}), (std::array<std::size_t, 3>{0, 49, 0}));
  for (const auto& refused :
       {Grid::divide({0, 0, 0}, {100, 0, 1}, 1), Grid::divide({0, 0, 0}, {1, 1, 1}, 0),
        Grid::divide({0, 0, 0}, {1, 1, std::nan("")}, 1), Grid::divide({0, 0, 0}, {1000, 1000, 1000}, 1)}) {
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::bad_input);
  }
}

TEST(Body, ASlantingPlaneCutsSharesAndWallExactly) {
  const Grid grid = *Grid::divide({0, 0, 0}, {8, 8, 8}, 1);
  // x + 2 y + 2 z = 12.3, a tetrahedron's face; it meets the box in a polygon.
  const Body body(grid, [](Place p) { return (12.3 - p.x - 2 * p.y - 2 * p.z) / 3; });
  const auto corner = [](double a) { return a > 0 ? a * a * a / 24 : 0; };
  EXPECT_NEAR(body.volume(), corner(12.3) - corner(12.3 - 8), 1e-9);
  // The area is the change of the volume with the plane's distance.
  const auto slope = [](double a) { return a > 0 ? a * a / 8 : 0; };
  EXPECT_NEAR(wall_of(body), 3 * (slope(12.3) - slope(12.3 - 8)), 1e-9);
  // The open shares of a voxel's faces and its wall are one closed surface: its projections cancel.
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const std::size_t i = n % 8, j = n / 8 % 8, k = n / 64;
    const double x = body.open(0, i, j, k) - body.open(0, i + 1, j, k);
    const double y = body.open(1, i, j, k) - body.open(1, i, j + 1, k);
    const double z = body.open(2, i, j, k) - body.open(2, i, j, k + 1);
    EXPECT_NEAR(std::sqrt(x * x + y * y + z * z), body.wall(n), 1e-12) << n;
  }
}

TEST(Body, APocketTakesItsVolumeAndLeavesItsWall) {
  std::array<double, 2> off_volume{}, off_wall{};
  for (const std::size_t fine : {0U, 1U}) {
    const Grid grid = *Grid::divide({0, 0, -10}, {40, 30, 0}, fine == 0 ? 1 : 0.5);
    Body body(grid);
    EXPECT_DOUBLE_EQ(body.volume(), 12000);
    body.cut({{10, 15, -4.3}, {30, 15, -4.3}, 5});
    EXPECT_DOUBLE_EQ(body.volume(), 12000) << "shares wait for settle()";
    const auto changed = body.settle();
    const double area = kPi * 25 + 200, rim = 2 * kPi * 5 + 40;
    off_volume[fine] = std::abs(12000 - 4.3 * area - body.volume()) / (4.3 * area);
    off_wall[fine] = std::abs(wall_of(body) / (area + 4.3 * rim) - 1);
    double gone = 0;
    for (const auto& c : changed) {
      EXPECT_LT(c.after, c.before);
      gone += (c.before - c.after) * grid.volume();
    }
    EXPECT_NEAR(gone, 12000 - body.volume(), 1e-8);
    body.cut({{12, 15, -4}, {28, 15, -4}, 4.9});
    EXPECT_TRUE(body.settle().empty()) << "there was nothing left to cut";
  }
  // The edge between wall and floor is cut off in each voxel: its length times the square of the pitch.
  EXPECT_LT(off_volume[0], 0.012);
  EXPECT_LT(off_volume[1], 0.4 * off_volume[0]);
  EXPECT_LT(off_wall[0], 0.04);
  EXPECT_LT(off_wall[1], 0.75 * off_wall[0]);
}

TEST(Body, AWallOnTheBordersOfVoxelsIsExact) {
  const Grid grid = *Grid::divide({0, 0, 0}, {6, 6, 6}, 1);
  const Body body(grid, [](Place p) { return 4 - p.z; });
  EXPECT_DOUBLE_EQ(body.volume(), 144);
  EXPECT_DOUBLE_EQ(wall_of(body), 36);
  EXPECT_DOUBLE_EQ(body.wall(grid.cell(2, 2, 3)), 1);
  EXPECT_DOUBLE_EQ(body.depth(grid.cell(2, 2, 3)), 0.5);
  EXPECT_DOUBLE_EQ(body.open(2, 2, 2, 4), 0);
}

TEST(Body, ARampGoesAsDeepAsItsTipDoes) {
  const Grid grid = *Grid::divide({0, 0, -10}, {40, 20, 0}, 1);
  Body body(grid);
  body.cut({{10, 10, 0}, {30, 10, -5}, 3});
  body.settle();
  // Over x the deepest tip is where the rim has just passed, at x + 3.
  const auto depth_at = [&](std::size_t i) {
    double sum = 0;
    for (std::size_t k = 0; k < 10; ++k) sum += 1 - body.share(grid.cell(i, 9, k));
    return sum;
  };
  EXPECT_NEAR(depth_at(15), (15.5 + std::sqrt(9 - 0.25) - 10) / 4, 0.02);
  EXPECT_NEAR(depth_at(29), 5, 0.02);
}

}  // namespace
}  // namespace lekalo::heat_body_test
