// Rims of finished faces: what lies beyond one is kept, what lies in one is taken off, to a stated part of
// its width; exactly at its width nothing is in it.

#include "verify/solid/rims.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/cases.hpp"
#include "support/solids.hpp"
#include "support/verify_solids.hpp"
#include "verify/solid/triangle_distance.hpp"

namespace lekalo::verify::verify_rims_test {
namespace {

using cases::block;
using cases::checked;

/// What comes no nearer than 1 - 2^-11 of the width may be kept; a piece that was cut very often comes a
/// little nearer.
constexpr double kNearly = 0.98;

double distance_of(const Near3& p, const PlacedSolid& mesh) {
  const Vec3 at{just(p[0]), just(p[1]), just(p[2])};
  double least = HUGE_VAL;
  for (std::uint32_t t = 0; t < mesh.mesh().triangles.size(); ++t)
    least = std::min(least, distance({at, at, at}, mesh.triangle(t)).low);
  return least;
}

Near3 point_of(const SolidMesh& mesh, std::uint32_t triangle, Random& random) {
  double a = random.uniform(0, 1), b = random.uniform(0, 1);
  if (a + b > 1) a = 1 - a, b = 1 - b;
  const auto& t = mesh.triangles[triangle];
  Near3 p{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    p[axis] = (1 - a - b) * mesh.near[t[0]][axis] + a * mesh.near[t[1]][axis] + b * mesh.near[t[2]][axis];
  return p;
}

double area_of(const SolidMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    std::array<double, 3> u{}, v{};
    for (std::size_t k = 0; k < 3; ++k)
      u[k] = mesh.near[t[1]][k] - mesh.near[t[0]][k], v[k] = mesh.near[t[2]][k] - mesh.near[t[0]][k];
    sum += 0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  }
  return sum;
}

/// Two blocks, of which the second lies beyond the first along an axis.
SolidMesh two_blocks(std::size_t axis, double from) {
  std::array<double, 3> low{0, 0, 0}, high{4, 4, 4}, next_low{1, 1, 1}, next_high{2, 2, 2};
  next_low[axis] = from, next_high[axis] = from + 1;
  const auto at = [](const std::array<double, 3>& p) { return solid::Vector{p[0], p[1], p[2]}; };
  solid::Mesh mesh = block(at(low), at(high));
  cases::append(mesh, block(at(next_low), at(next_high)));
  return checked(mesh);
}

/// The triangles of a mesh whose corners all have this coordinate.
std::vector<std::uint32_t> at_level(const SolidMesh& mesh, std::size_t axis, double level) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (std::all_of(mesh.triangles[t].begin(), mesh.triangles[t].end(),
                    [&](std::uint32_t v) { return mesh.near[v][axis] == level; }))
      found.push_back(t);
  return found;
}

TEST(VerifyRims, ExactlyAtTheWidthNothingIsInTheRim) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const SolidMesh part = two_blocks(axis, 4.25);
    const std::vector<std::uint32_t> face = at_level(part, axis, 4), beyond = at_level(part, axis, 4.25);
    ASSERT_EQ(face.size(), 2U);
    ASSERT_EQ(beyond.size(), 2U);
    for (const auto& [width, spare] :
         {std::pair{0.25, true}, {std::nextafter(0.25, 1), false}, {0.3, false}, {0.2, true}}) {
      Rims rims(part);
      rims.add(face, width);
      EXPECT_TRUE(rims.any());
      for (const std::uint32_t t : beyond) EXPECT_EQ(rims.spare(t), spare) << axis << width;
      for (const std::uint32_t t : face) EXPECT_FALSE(rims.spare(t));
      Exact3 p{Fraction(1.5), Fraction(1.5), Fraction(1.5)};
      p[axis] = Fraction(4.25);
      EXPECT_EQ(rims.spare(p), spare) << axis << width;
    }
  }
}

TEST(VerifyRims, OfATriangleThatIsHalfInTheRimTheOtherHalfIsLeft) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const SolidMesh part = two_blocks(axis, 100);
    Rims rims(part);
    rims.add(at_level(part, axis, 4), 1);
    for (std::size_t k = 0; k < 3; ++k) {
      if (k == axis) continue;
      // Of four by four, four by three is not nearer than 1.
      const SolidMesh left = rims.rest(at_level(part, k, 0));
      EXPECT_NEAR(area_of(left), 12, 12 * 0x1p-10) << axis << k;
      EXPECT_GE(area_of(left), 12 - 1e-9);
    }
    EXPECT_TRUE(rims.rest(at_level(part, axis, 4)).triangles.empty()) << "the face itself";
    EXPECT_NEAR(area_of(rims.rest(at_level(part, axis, 0))), 16, 1e-9) << "the face behind";
  }
}

TEST(VerifyRims, OfALongTriangleBesideASmallFaceLittleIsTakenOff) {
  // A square of 0.5 by 0.5 lies 0.1 beside the middle of 200 by 4.
  solid::Mesh mesh = block({-100, 0, 0}, {100, 4, 4});
  cases::append(mesh, block({-0.25, -0.6, 1.75}, {0.25, -0.1, 2.25}));
  const SolidMesh part = checked(mesh);
  Rims rims(part);
  rims.add(at_level(part, 1, -0.1), 0.5);
  const SolidMesh left = rims.rest(at_level(part, 1, 0));
  const double reach = std::sqrt(0.25 - 0.01), pi = 3.141592653589793;
  EXPECT_NEAR(area_of(left), 800 - (0.25 + 2 * reach + pi * reach * reach), 0.01);
  EXPECT_LT(left.triangles.size(), 5000U);
}

/// Looks at points of a part one by one.
void hold_points(std::size_t i, Random& random) {
  // Faces much smaller than the triangles about them, as large, and of several that meet.
  const double size = i % 3 == 0 ? 20 : 3;
  solid::Mesh mesh = i % 2 == 0 ? cases::ring(random, 8, 6, 3, 1) : block({-2, -2, -2}, {2, 2, 2});
  for (solid::Vector& v : mesh.vertices) v.x = v.x * size / 3 + 50;
  const SolidMesh part = checked(mesh);
  std::vector<std::uint32_t> face, others;
  const auto count = static_cast<std::uint32_t>(part.triangles.size());
  const auto first = static_cast<std::uint32_t>(random.uniform(0, count - 3));
  for (std::uint32_t t = 0; t < count; ++t)
    (t >= first && t < first + 1 + i % 3 ? face : others).push_back(t);
  const double width = random.uniform(0.05, 1.5);
  Rims rims(part);
  rims.add(face, width);
  const SolidMesh left = rims.rest(others), of_face = part_of(part, face);
  const PlacedSolid near_face(of_face);
  EXPECT_LT(rims.off(), 1e-11);
  for (std::uint32_t piece = 0; piece < left.triangles.size(); ++piece)
    for (int k = 0; k < 2; ++k)
      EXPECT_GE(distance_of(point_of(left, piece, random), near_face), kNearly * width - 1e-9) << i;
  for (const std::uint32_t t : others) {
    std::vector<std::uint32_t> pieces;
    for (std::uint32_t piece = 0; piece < left.triangles.size(); ++piece)
      if (left.numbers[piece] == part.numbers[t]) pieces.push_back(piece);
    const SolidMesh of_triangle = part_of(pieces.empty() ? part : left, pieces.empty() ? face : pieces);
    const PlacedSolid kept(of_triangle);  // of one of which nothing is left, the face
    for (int k = 0; k < 8; ++k) {
      const Near3 p = point_of(part, t, random);
      if (distance_of(p, near_face) <= width * (1 + 1e-9)) continue;
      EXPECT_LE(distance_of(p, kept), 1e-9) << i << " triangle " << t;
    }
  }
}

TEST(VerifyRims, WhatIsBeyondIsKeptAndWhatIsInIsTakenOff) {
  Random random(cases::seed(), 17);
  for (std::size_t i = 0; i < cases::case_count(12); ++i) hold_points(i, random);
}

// Small enough to be asked for each mutant.
TEST(VerifyRims, PiecesDeepInARimBetweenTwoTrianglesAreTakenOff) {
  Random random(3, 17);
  hold_points(1, random);
  hold_points(5, random);
}

}  // namespace
}  // namespace lekalo::verify::verify_rims_test
