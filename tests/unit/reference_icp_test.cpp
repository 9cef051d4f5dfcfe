#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lekalo/geom/pose.hpp"
#include "lekalo/locate/reference.hpp"
#include "lekalo/phi/convex.hpp"
#include "support/cases.hpp"

namespace lekalo::locate::reference_icp_test {
namespace {

const geom::Ring kWedge{{0, 0}, {80, 0}, {90, 20}, {60, 40}, {5, 30}};

geom::ConvexPolygon placed(const geom::Ring& ring, const geom::BlankFromPart& pose) {
  geom::Ring moved;
  for (const geom::Point p : ring) moved.push_back(pose(p));
  return cases::convex(std::move(moved));
}

IcpOptions starting_at(double x, double y, double theta) {
  IcpOptions options;
  options.has_start = true;
  options.start = {x, y, theta, 0};
  return options;
}

TEST(LocateIcp, FindsACopyOfThePartExactly) {
  const auto pose = geom::BlankFromPart::from_angle(0.7, {300, -20});
  for (const IcpOptions& options : {starting_at(303, -18, 0.65), IcpOptions{}}) {
    const auto result = locate_icp(cases::convex(kWedge), placed(kWedge, pose), options).value();
    EXPECT_TRUE(result.converged);
    EXPECT_NEAR(result.best.x, 300, 1e-7);
    EXPECT_NEAR(result.best.y, -20, 1e-7);
    EXPECT_NEAR(result.best.theta, 0.7, 1e-9);
    EXPECT_LT(result.residual, 1e-8);
  }
}

TEST(LocateIcp, ConvergesToTheKnownPoseWhereTheStockIsEvenAllRound) {
  // Symmetric about its centre, so that the even stock pulls evenly.
  const geom::Ring hexagon{{-50, -10}, {10, -30}, {45, -20}, {50, 10}, {-10, 30}, {-45, 20}};
  const auto pose = geom::BlankFromPart::from_angle(0.3, {40, 70});
  std::vector<geom::Point> normals;
  geom::Ring moved;
  for (const geom::Point p : hexagon) moved.push_back(pose(p));
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const geom::Point edge = moved[(i + 1) % moved.size()] - moved[i];
    normals.push_back((1 / norm(edge)) * perpendicular(edge));
  }
  const auto blank = cases::detail::blank_around(moved, normals, std::vector<double>(normals.size(), 1.0));
  const auto result = locate_icp(cases::convex(hexagon), blank, starting_at(42, 69, 0.25)).value();
  EXPECT_TRUE(result.converged && result.found);
  // A corner of the blank is equally near to two sides; which one it counts for moves the pose a little.
  EXPECT_NEAR(result.best.x, 40, 0.02);
  EXPECT_NEAR(result.best.y, 70, 0.02);
  EXPECT_NEAR(result.best.theta, 0.3, 1e-3);
  EXPECT_NEAR(result.best.clearance, 1, 0.06);
  EXPECT_NEAR(result.residual, 1, 0.01);
}

TEST(LocateIcp, CutsIntoThePartWhereTheStockIsLocallyThin) {
  // Every one of these blanks holds its part with 0.1 mm to spare; least squares does not see on which side
  // it is.
  int gouges = 0;
  constexpr int kCases = 60;
  for (std::uint64_t index = 0; index < kCases; ++index) {
    const auto c = cases::random_case(1, index, cases::Kind::thin_stock);
    const auto result = locate_icp(c.part, c.blank, {}).value();
    EXPECT_GE(phi::clearance_enclosure(c.part, c.blank, c.x, c.y, c.theta).low, 0.0999) << c.name;
    gouges += result.best.clearance < 0;
  }
  EXPECT_GT(gouges, kCases / 5);
  EXPECT_LT(gouges, kCases);
}

TEST(LocateIcp, ReportsTheTrueClearanceOfItsPose) {
  for (std::uint64_t index = 0; index < 20; ++index) {
    const auto c = cases::random_case(cases::seed(), index);
    const auto result = locate_icp(c.part, c.blank, {}).value();
    const auto& best = result.best;
    EXPECT_EQ(best.clearance, phi::clearance_enclosure(c.part, c.blank, best.x, best.y, best.theta).low)
        << c.name;
    EXPECT_EQ(result.found, best.clearance >= 0) << c.name;
  }
}

TEST(LocateIcp, KeepsTheAngleInTheWindow) {
  const auto pose = geom::BlankFromPart::from_angle(0.7, {300, -20});
  IcpOptions options;
  options.window = {0.1, 0.4};
  const auto result = locate_icp(cases::convex(kWedge), placed(kWedge, pose), options).value();
  EXPECT_EQ(result.best.theta, 0.4) << "the end nearest to the true angle";
}

TEST(LocateIcp, DoesNotTurnWhatThePointsDoNotSeeTurning) {
  const auto result =
      locate_icp(cases::regular_ngon(1000, 49), cases::regular_ngon(1000, 50, {5, 5}), {}).value();
  EXPECT_NEAR(result.best.x, 5, 0.05);
  EXPECT_NEAR(result.best.y, 5, 0.05);
  EXPECT_NEAR(result.best.clearance, 1, 0.1);
}

TEST(LocateIcp, RefusesOptionsThatMeanNothing) {
  const auto square = cases::regular_ngon(4, 10);
  IcpOptions options;
  options.max_iterations = 0;
  EXPECT_EQ(locate_icp(square, square, options).error().code, ErrorCode::usage);
  options = {};
  options.window = {0, std::nan("")};
  EXPECT_EQ(locate_icp(square, square, options).error().code, ErrorCode::usage);
  EXPECT_EQ(locate_icp(square, square, starting_at(INFINITY, 0, 0)).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace lekalo::locate::reference_icp_test
