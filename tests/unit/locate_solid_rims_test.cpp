// Triangles that are cut where the rims of finished faces end: what demands something is all there, and
// reaches into a rim by a little of it at most.

#include "locate/solid/solid_rims.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/cases.hpp"
#include "support/solids.hpp"

namespace lekalo::locate::locate_solid_rims_test {
namespace {

using solid::Corners;
using solid::Vector;

/// What demands something may come so near to the face, of the rim's width: 1 - 2^-10 and 2^-11 less, and a
/// piece that was cut very often a little nearer.
constexpr double kNearly = 0.98;

Corners corners_of(const solid::Mesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

double area_of(const Corners& t) { return 0.5 * norm(cross(t[1] - t[0], t[2] - t[0])); }

Vector point_of(const Corners& t, Random& random) {
  double a = random.uniform(0, 1), b = random.uniform(0, 1);
  if (a + b > 1) a = 1 - a, b = 1 - b;
  return t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
}

/// How far the nearest of some triangles is from a point.
double distance_of(Vector p, const std::vector<Corners>& face) {
  double least = std::numeric_limits<double>::infinity();
  for (const Corners& one : face) least = std::min(least, solid::distance(one, p));
  return least;
}

TEST(SolidRims, WhatDemandsNothingLiesInOneAndWhatDemandsSomethingHardlyDoes) {
  Random random(cases::seed(), 18);
  for (std::size_t i = 0; i < cases::case_count(24); ++i) {
    // Faces much smaller than the triangles about them, as large, and of several that meet.
    const double size = i % 3 == 0 ? 20 : 3;
    solid::Mesh mesh = i % 2 == 0 ? cases::ring(random, 8, 6, 3, 1) : cases::block({-2, -2, -2}, {2, 2, 2});
    for (Vector& v : mesh.vertices) v.x = v.x * size / 3 + 50;
    SolidProblem problem;
    problem.part = closed_mesh(std::move(mesh)).value().mesh;
    const auto count = static_cast<std::uint32_t>(problem.part.triangles.size());
    const auto first = static_cast<std::uint32_t>(random.uniform(0, count - 3));
    problem.nears.push_back({{}, 1, random.uniform(0.05, 1.5)});
    const double rim = problem.nears.front().rim;
    std::vector<Corners> face;
    for (std::uint32_t t = 0; t < count; ++t) {
      const bool finished = t >= first && t < first + 1 + i % 3;
      problem.demands.push_back(finished ? std::nullopt : std::optional(SolidDemand{}));
      if (!finished) continue;
      problem.nears.front().triangles.push_back(t);
      face.push_back(corners_of(problem.part, t));
    }
    const std::optional<CutPart> cut = CutPart::of(problem);
    ASSERT_TRUE(cut) << "what meets the face lies in its rim";
    std::vector<double> area(count);
    for (std::uint32_t piece = 0; piece < cut->mesh().triangles.size(); ++piece) {
      const std::uint32_t t = cut->number(piece);
      const Corners at = corners_of(cut->mesh(), piece);
      area[t] += area_of(at);
      for (int k = 0; k < 3; ++k) {
        const double far = distance_of(point_of(at, random), face);
        if (cut->demands()[piece])
          EXPECT_GE(far, kNearly * rim) << i;
        else
          EXPECT_LT(far, rim) << i;
      }
    }
    for (std::uint32_t t = 0; t < count; ++t) {
      const double whole = area_of(corners_of(problem.part, t));
      EXPECT_NEAR(area[t], whole, 1e-9 * (1 + whole));
    }
  }
}

}  // namespace
}  // namespace lekalo::locate::locate_solid_rims_test
