#include "lekalo/solid/point_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "support/solids.hpp"

namespace lekalo::solid_point_surface_test {
namespace {

using solid::Mesh;
using solid::PointSurface;
using solid::PointSurfaceOptions;
using solid::surface_through;
using solid::Vector;

/// Points spread evenly over a ball about the origin, as the seeds of a sunflower.
std::vector<Vector> ball(int count, double radius) {
  std::vector<Vector> points;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, turn = k * std::numbers::pi * (3 - std::sqrt(5.0)),
                 r = std::sqrt(1 - z * z);
    points.push_back({radius * r * std::cos(turn), radius * r * std::sin(turn), radius * z});
  }
  return points;
}

/// Points on the side and the top of a cylinder that stands at z = 0, 1 mm apart.
std::vector<Vector> cylinder(double radius, int height) {
  std::vector<Vector> points;
  const auto ring = [&](double r, double z) {
    const int count = std::max(1, static_cast<int>(2 * std::numbers::pi * r));
    for (int k = 0; k < count; ++k) {
      const double turn = 2 * std::numbers::pi * k / count;
      points.push_back({r * std::cos(turn), r * std::sin(turn), z});
    }
  };
  for (int z = 0; z <= height; ++z) ring(radius, z);
  for (double r = radius - 1; r > -0.5; r -= 1) ring(r, height);
  return points;
}

PointSurface made(const std::vector<Vector>& points, const PointSurfaceOptions& options) {
  Result<PointSurface> surface = surface_through(points, options);
  EXPECT_TRUE(surface.has_value()) << (surface ? "" : surface.error().message);
  return surface ? std::move(*surface) : PointSurface{};
}
std::string refusal(const std::vector<Vector>& points, const PointSurfaceOptions& options) {
  const auto surface = surface_through(points, options);
  return surface ? "made" : surface.error().message;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6;
  return sum;
}

/// Closed, with no corner that is neither a point nor on the floor, nor a long edge.
void expect_sound(const PointSurface& surface, const std::vector<Vector>& points, double longest) {
  EXPECT_TRUE(surface.encloses);
  EXPECT_TRUE(solid::closed_mesh(surface.mesh).has_value());
  const auto less = [](Vector a, Vector b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::vector<Vector> sorted = points;
  std::sort(sorted.begin(), sorted.end(), less);
  for (const Vector p : surface.mesh.vertices)
    EXPECT_TRUE(p.z == 0 || std::binary_search(sorted.begin(), sorted.end(), p, less));
  for (const solid::Triangle& t : surface.mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector a = surface.mesh.vertices[t[k]], b = surface.mesh.vertices[t[(k + 1) % 3]];
      EXPECT_TRUE((a.z == 0 && b.z == 0) || norm(a - b) < longest);
    }
}

TEST(PointSurface, GoesThroughThePointsOfABall) {
  const std::vector<Vector> points = ball(4000, 20);
  const PointSurface surface = made(points, {.ball = 3});
  EXPECT_EQ(surface.below, 0U);
  EXPECT_NEAR(volume(surface.mesh), 4.0 / 3 * std::numbers::pi * 8000, 300);
  expect_sound(surface, points, 4 * surface.step);
  // Most points are corners, so the surface is as fine as they allow.
  EXPECT_GT(surface.mesh.vertices.size(), points.size() / 2);
}

TEST(PointSurface, IsAsFineAsAskedFor) {
  const std::vector<Vector> points = ball(4000, 20);
  const PointSurface surface = made(points, {.ball = 7.5, .floor = {}, .step = 2.5});
  EXPECT_EQ(surface.step, 2.5);
  EXPECT_EQ(made(points, {.ball = 3, .floor = {}, .step = 2.5}).step, 1);
  EXPECT_LT(surface.mesh.vertices.size(), 1200U);
  expect_sound(surface, points, 10);
}

TEST(PointSurface, TheFloorClosesABodyThatStandsOnIt) {
  const std::vector<Vector> body = cylinder(10, 12);
  EXPECT_FALSE(made(body, {.ball = 2}).encloses);
  std::vector<Vector> points = body;
  points.push_back({0, 0, -1});
  const PointSurface surface = made(points, {.ball = 2, .floor = 0});
  EXPECT_EQ(surface.below, 1U);
  EXPECT_NEAR(volume(surface.mesh), 100 * std::numbers::pi * 12, 60);
  expect_sound(surface, body, 4 * surface.step);
}

TEST(PointSurface, AGapThatTheBallDoesNotPassIsBridged) {
  std::vector<Vector> points = ball(4000, 20);
  std::erase_if(points, [](Vector p) { return norm(p - Vector{0, 0, 20}) < 2.5; });
  const PointSurface surface = made(points, {.ball = 4});
  EXPECT_NEAR(volume(surface.mesh), 4.0 / 3 * std::numbers::pi * 8000, 300);
  expect_sound(surface, points, 6);
  std::erase_if(points, [](Vector p) { return p.z > 10; });
  EXPECT_FALSE(made(points, {.ball = 4}).encloses);
  EXPECT_TRUE(made(points, {.ball = 30}).encloses);
}

TEST(PointSurface, AVoidInPointsIsClosedToo) {
  std::vector<Vector> points = ball(8000, 20);
  for (const Vector p : ball(2000, 8)) points.push_back(p);
  // What lies inside of a surface is of the body until somebody says where the air in it comes from.
  EXPECT_NEAR(volume(made(points, {.ball = 3}).mesh), 4.0 / 3 * std::numbers::pi * 8000, 300);
}

TEST(PointSurface, IsTheSameEachTime) {
  const std::vector<Vector> points = cylinder(10, 12);
  const PointSurface one = made(points, {.ball = 2, .floor = 0}), two = made(points, {.ball = 2, .floor = 0});
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(one.mesh.vertices, two.mesh.vertices);
}

TEST(PointSurface, RefusesWhatGivesNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vector> points = ball(100, 20);
  EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}}, {.ball = 1}).find("2 points give no surface"), std::string::npos);
  EXPECT_NE(refusal({{0, 0, -1}, {1, 0, 0}}, {.ball = 1, .floor = 0}).find("1 points above the underside"),
            std::string::npos);
  EXPECT_NE(refusal({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {.ball = 1}).find("at one place"),
            std::string::npos);
  EXPECT_NE(refusal({{0, 0, nan}, {1, 0, 0}}, {.ball = 1}).find("point 1 has the coordinate nan"),
            std::string::npos);
  for (const double bad : {0.0, -1.0, nan, 1e10}) {
    EXPECT_NE(refusal(points, {.ball = bad}).find("must have a radius above 0"), std::string::npos);
    EXPECT_NE(refusal(points, {.ball = 1, .floor = {}, .step = bad}).find("must be longer than 0"),
              std::string::npos);
  }
}

TEST(PointSurface, PointsThatLieFarAwayAreToldAndTakeNoTime) {
  std::vector<Vector> points = ball(2000, 20);
  points.push_back({1e6, 1e6, 1e6});
  EXPECT_NE(refusal(points, {.ball = 3}).find("leave out those that lie far away"), std::string::npos);
}

TEST(LonelyPoints, HaveNoOtherWithinTheDistance) {
  EXPECT_EQ(solid::lonely_points({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {3, 0.5, 0.5}, {9, 9, 9}}, 1),
            (std::vector<std::uint32_t>{4}));
  EXPECT_EQ(solid::lonely_points({{0, 0, 0}, {1.01, 0, 0}, {0, 0, 2}}, 1),
            (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(solid::lonely_points({{5, 5, 5}, {5, 5, 5}}, 1e-12), (std::vector<std::uint32_t>{}));
}

}  // namespace
}  // namespace lekalo::solid_point_surface_test
