// Surfaces that go through themselves, as the checker sees them and as `lekalo locate` does.

#include "verify/solid/self_crossing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/solid/crossing.hpp"
#include "support/solid_results.hpp"
#include "support/solids.hpp"
#include "support/verify_solids.hpp"

namespace lekalo::verify::verify_self_crossing_test {
namespace {

using cases::block;
using solid::Mesh;
using solid::Vector;

Mesh both(Mesh mesh, const Mesh& other) {
  cases::append(mesh, other);
  return mesh;
}

SelfCrossings crossings_of(const Mesh& mesh) {
  const SolidMesh read = cases::checked(mesh);
  return self_crossings(PlacedSolid(read));
}

/// An outline that crosses itself in the middle, pulled up.
Mesh bow_tie() {
  Mesh mesh;
  for (const double z : {0.0, 10.0})
    for (const Vector p : {Vector{0, 0, z}, {10, 10, z}, {10, 0, z}, {0, 10, z}}) mesh.vertices.push_back(p);
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t next = (k + 1) % 4;
    mesh.triangles.insert(mesh.triangles.end(), {{k, next, k + 4}, {next, next + 4, k + 4}});
  }
  mesh.triangles.insert(mesh.triangles.end(), {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}});
  return mesh;
}

struct Case {
  const char* what;
  Mesh mesh;
};

TEST(SelfCrossings, InsideChangesSidesHoweverASurfaceGoesThroughItself) {
  for (const auto& [what, mesh] :
       {Case{"askew", both(block({0, 0, 0}, {20, 20, 20}), block({5, 6, 7}, {30, 31, 32}))},
        Case{"no corner within the other",
             both(block({-50, -5, -5}, {50, 5, 5}), block({-3, -50, -7}, {4, 50, 6}))},
        Case{"on the same planes", both(block({-50, -5, -5}, {50, 5, 5}), block({-5, -50, -5}, {5, 50, 5}))},
        Case{"end in end", both(block({0, 0, 0}, {20, 2, 2}), block({19, 0, 0}, {39, 2, 2}))},
        Case{"a little", both(block({0, 0, 0}, {20, 20, 20}), block({19.95, 3, 4}, {39, 30, 30}))},
        Case{"a void that sticks out", both(block({0, 0, 0}, {20, 20, 20}), block({5, 5, 5}, {9, 9, 25}))},
        Case{"one sheet", bow_tie()}}) {
    const SelfCrossings found = crossings_of(mesh);
    EXPECT_TRUE(found.changing) << what;
    EXPECT_TRUE(found.complete) << what;
  }
}

TEST(SelfCrossings, WhatTouchesNestsOrIsThinKeepsItsInside) {
  for (const auto& [what, mesh] :
       {Case{"a block", block({0, 0, 0}, {20, 20, 20})},
        Case{"a void", both(block({0, 0, 0}, {20, 20, 20}), block({5, 5, 5}, {9, 9, 9}))},
        Case{"one face", both(block({0, 0, 0}, {20, 20, 20}), block({20, 0, 0}, {40, 20, 20}))},
        Case{"one edge", both(block({0, 0, 0}, {20, 20, 20}), block({20, 20, 0}, {40, 40, 20}))},
        Case{"parts of faces", both(block({0, 0, 0}, {20, 20, 20}), block({20, 3, 4}, {40, 30, 30}))}}) {
    const SelfCrossings found = crossings_of(mesh);
    EXPECT_FALSE(found.changing) << what;
    EXPECT_FALSE(found.first) << what;
  }
  const SelfCrossings thin =
      crossings_of(both(block({0, 0, 0}, {20, 20, 20}), block({19.999, 3, 4}, {39, 30, 30})));
  EXPECT_FALSE(thin.changing);
  ASSERT_TRUE(thin.first);
  EXPECT_NEAR(thin.first->place[0], 20, 2e-3);
  EXPECT_EQ(thin.depth, 0.02);
}

/// The point of a void touches a slanting face from inside, or goes through it by the last digit.
TEST(SelfCrossings, TheLastDigitDecides) {
  const auto tetrahedron = [](Vector a, Vector b, Vector c, Vector d) {
    return Mesh{{a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  };
  const Mesh body = tetrahedron({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3});
  for (const auto& [beyond, goes_through] : {std::pair(0.0, false), {0x1p-52, true}, {-0x1p-52, false}}) {
    const SelfCrossings found = crossings_of(both(
        body, tetrahedron({0.25, 0.25, 0.25}, {0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {1, 1, 1 + beyond})));
    EXPECT_EQ(found.first.has_value(), goes_through) << beyond;
    EXPECT_FALSE(found.changing) << beyond;
  }
}

/// Which way triangles are turned says nothing, as nothing else here asks for it.
TEST(SelfCrossings, TurnedTrianglesMeanTheSame) {
  Mesh body = block({-50, -5, -5}, {50, 5, 5}), other = block({-5, -50, -5}, {5, 50, 5});
  for (Mesh* const mesh : {&body, &other})
    for (const std::size_t t : {1U, 4U, 5U, 10U}) std::swap(mesh->triangles[t][0], mesh->triangles[t][2]);
  EXPECT_FALSE(crossings_of(body).changing);
  EXPECT_FALSE(crossings_of(both(body, block({60, 0, 0}, {70, 9, 9}))).changing);
  EXPECT_TRUE(crossings_of(both(body, other)).changing);
}

TEST(SelfCrossings, ALayerOfTwoRadiiIsEnoughAndOneOfLessIsNot) {
  for (const auto& [overlap, is_seen] : {std::pair(0.0401, true), {0.0399, false}})
    EXPECT_EQ(crossings_of(both(block({0, 0, 0}, {20, 20, 20}), block({20 - overlap, 3, 4}, {39, 30, 30})))
                  .changing.has_value(),
              is_seen)
        << overlap;
}

/// What `lekalo locate` takes is not refused here, and what it refuses by a wide margin is.
TEST(SelfCrossings, OfWavyRingsBothProgramsSayTheSame) {
  int crossing = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    Mesh mesh = cases::ring(random, 24, 12, 30, 8), other = cases::ring(random, 24, 12, 30, 8);
    const Vector shift{random.uniform(0, 90), random.uniform(-9, 9), random.uniform(-9, 9)};
    for (Vector& p : other.vertices) p = Vector{p.x, -p.z, p.y} + shift;  // as the links of a chain
    mesh = both(std::move(mesh), other);
    const solid::Crossings told = solid::crossings(mesh);
    const SelfCrossings found = crossings_of(mesh);
    EXPECT_EQ(found.first.has_value(), told.first.has_value()) << seed;
    EXPECT_EQ(found.changing.has_value(), told.changing.has_value()) << seed;
    (found.changing ? crossing : apart) += 1;
  }
  EXPECT_GT(crossing, 2);
  EXPECT_GT(apart, 2);
}

TEST(SelfCrossings, APartOrABlankThatGoesThroughItselfIsNotChecked) {
  const Mesh blank = block({-6, -6, -6}, {6, 6, 6});
  for (const bool of_part : {false, true}) {
    cases::SolidResultFiles files = cases::cube_in_cube();
    const std::string before = files.told();
    std::string& bytes = of_part ? files.part : files.blank;
    const Mesh mesh = of_part ? block({-5, -5, -5}, {5, 5, 5}) : blank;
    const auto with = [&](double from) {
      bytes = solid_files::stl_binary(both(mesh, block({from, -2, -3}, {from + 9, 3, 2})));
      files.result["inputs"][of_part ? 0 : 1]["triangles"] = 24;
      return files.told();
    };
    const std::string told = with(of_part ? 4 : 5);
    EXPECT_EQ(told.find("bad input"), 0U) << told;
    EXPECT_NE(told.find("the surface crosses itself at ("), std::string::npos) << told;
    EXPECT_NE(told.find("so that nothing says where the material is"), std::string::npos) << told;
    EXPECT_EQ(before, "unproved");
  }
}

TEST(SelfCrossings, OneThatIsThinIsToldAndTheResultKept) {
  cases::SolidResultFiles files = cases::cube_in_cube();
  files.blank =
      solid_files::stl_binary(both(block({-6, -6, -6}, {6, 6, 6}), block({5.999, -2, -3}, {9, 3, 2})));
  files.result["inputs"][1]["triangles"] = 24;
  files.result["clearance"] = 0.998, files.result["contacts"] = cases::Json::array();
  EXPECT_EQ(files.told(), "unproved");
  const auto report = files.report();
  ASSERT_TRUE(report);
  EXPECT_TRUE(std::ranges::any_of(report->notes, [](const std::string& note) {
    return note.starts_with("blank.stl: the surface crosses itself at (") &&
           note.ends_with(
               "what lies between was not found to be 0.02 mm thick anywhere, and what is inside was "
               "told by an odd count");
  }));
}

}  // namespace
}  // namespace lekalo::verify::verify_self_crossing_test
