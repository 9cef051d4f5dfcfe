#include "lekalo/solid/mesh.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "lekalo/solid/triangle_tree.hpp"
#include "support/solids.hpp"
#include "support/stopwatch.hpp"

namespace lekalo::solid_mesh_test {
namespace {

using solid::closed_mesh;
using solid::Mesh;
using solid::Vector;

/// Every triangle with three vertices of its own, as STL has them.
Mesh loose(const Mesh& mesh) {
  Mesh made;
  for (const solid::Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(made.vertices.size());
    for (const std::uint32_t v : t) made.vertices.push_back(mesh.vertices[v]);
    made.triangles.push_back({first, first + 1, first + 2});
  }
  return made;
}

std::string refusal(Mesh mesh) {
  const auto made = closed_mesh(std::move(mesh));
  return made ? "closed" : made.error().message;
}

TEST(ClosedMesh, LooseTrianglesShareTheirCorners) {
  const auto made = closed_mesh(loose(cases::block({0, 0, 0}, {10, 20, 30})));
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->mesh.vertices.size(), 8u);
  EXPECT_EQ(made->mesh.triangles.size(), 12u);
  EXPECT_TRUE(made->notices.empty());
  const solid::Box box = box_of(made->mesh.vertices);
  EXPECT_EQ(box.low, (Vector{0, 0, 0}));
  EXPECT_EQ(box.high, (Vector{10, 20, 30}));
}

TEST(ClosedMesh, ZeroHasOneSign) {
  Mesh mesh = loose(cases::block({0, 0, 0}, {1, 1, 1}));
  for (std::size_t k = 0; k < mesh.vertices.size(); k += 2)
    if (mesh.vertices[k].x == 0) mesh.vertices[k].x = -0.0;
  const auto made = closed_mesh(mesh);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->mesh.vertices.size(), 8u);
}

TEST(ClosedMesh, AnOpenEdgeIsNamedWithItsPlaceAndTriangle) {
  Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  mesh.triangles.erase(mesh.triangles.begin() + 3);
  EXPECT_EQ(refusal(mesh),
            "the surface is open: 3 edges belong to one triangle or an odd number of them, the first from "
            "(1, 0, 1) to "
            "(0, 1, 1) on triangle 3; close it in the program that the mesh comes from");
}

TEST(ClosedMesh, ATriangleThatStandsOnAnEdgeOpensIt) {
  Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({5, 5, 5});
  mesh.triangles.push_back({0, 1, 8});
  EXPECT_NE(refusal(mesh).find("3 edges belong to one triangle or an odd number"), std::string::npos)
      << refusal(mesh);
}

TEST(ClosedMesh, TrianglesWithACornerTwiceAreLeftOutAndNumbersStay) {
  Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({1, 1, 1});
  mesh.triangles.insert(mesh.triangles.begin(), {7, 8, 0});
  const auto made = closed_mesh(mesh);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->mesh.triangles.size(), 12u);
  EXPECT_EQ(made->numbers.front(), 1u);
  EXPECT_EQ(made->mesh.vertices.size(), 8u);
  EXPECT_EQ(made->notices, (std::vector<std::string>{"1 triangle has no area and is left out"}));
  mesh.triangles.pop_back();
  EXPECT_NE(refusal(mesh).find("on triangle 5;"), std::string::npos) << refusal(mesh);
}

TEST(ClosedMesh, ATriangleWithoutAreaStaysWhereTheSurfaceClosesAlongIt) {
  // The first triangle, (0, 0, 0) (0, 1, 0) (1, 0, 0), gets a corner in the middle of its long edge.
  Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({0.5, 0.5, 0});
  mesh.triangles[0] = {0, 2, 8};
  mesh.triangles.push_back({0, 8, 1});
  EXPECT_NE(refusal(mesh).find("the surface is open"), std::string::npos);
  mesh.triangles.push_back({2, 1, 8});
  const auto seam = closed_mesh(mesh);
  ASSERT_TRUE(seam) << seam.error().message;
  EXPECT_EQ(seam->mesh.triangles.size(), 14u);
  EXPECT_EQ(
      seam->notices,
      (std::vector<std::string>{"1 triangle has no area and stays, because the surface closes along it"}));
  EXPECT_DOUBLE_EQ(seam->shells.at(0).volume, 1);
  const solid::TriangleTree tree(seam->mesh);
  EXPECT_TRUE(tree.holds({0.5, 0.5, 0.5}));
  EXPECT_FALSE(tree.holds({0.5, 0.5, -0.5}));
  const auto near = tree.nearest({0.5, 0.5, -0.25});
  EXPECT_NEAR(near->low, 0.25, 1e-12);
  EXPECT_NEAR(near->high, 0.25, 1e-12);
  // Two that cancel each other are needed by nobody.
  mesh = cases::block({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({0.5, 0.5, 0});
  mesh.triangles.push_back({2, 1, 8});
  mesh.triangles.push_back({1, 2, 8});
  const auto without = closed_mesh(mesh);
  ASSERT_TRUE(without) << without.error().message;
  EXPECT_EQ(without->mesh.triangles.size(), 12u);
  EXPECT_EQ(without->notices, (std::vector<std::string>{"2 triangles have no area and are left out"}));
}

void turn_round(Mesh& mesh, std::size_t from, std::size_t to) {
  for (std::size_t t = from; t < to; ++t) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
}

TEST(ClosedMesh, TrianglesThatAreTurnedWrongAreTurnedRoundAndThatIsTold) {
  const Mesh right = cases::block({0, 0, 0}, {1, 2, 3});
  for (const auto& [from, to, said] :
       {std::tuple(0, 0, ""),
        std::tuple(4, 5, "1 of 12 triangles looked into the material and is turned round"),
        std::tuple(0, 7, "7 of 12 triangles looked into the material and are turned round"),
        std::tuple(0, 12, "12 of 12 triangles looked into the material and are turned round")}) {
    Mesh mesh = right;
    turn_round(mesh, static_cast<std::size_t>(from), static_cast<std::size_t>(to));
    const auto made = closed_mesh(mesh);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->notices,
              std::string(said).empty() ? std::vector<std::string>() : std::vector<std::string>{said});
    ASSERT_EQ(made->shells.size(), 1u);
    EXPECT_EQ(made->shells[0].triangles, 12u);
    EXPECT_EQ(made->shells[0].depth, 0u);
    EXPECT_DOUBLE_EQ(made->shells[0].volume, 6);
  }
}

TEST(ClosedMesh, AShellWithinAnotherIsAVoidAndABodyWithinThatABody) {
  Mesh mesh = cases::block({0, 0, 0}, {9, 9, 9});
  cases::append(mesh, cases::block({1, 1, 1}, {8, 8, 8}));
  cases::append(mesh, cases::block({2, 2, 2}, {7, 7, 7}));
  cases::append(mesh, cases::block({10, 1, 1}, {18, 8, 8}));
  turn_round(mesh, 36, 40);
  const auto made = closed_mesh(mesh);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->notices,
            (std::vector<std::string>{"4 of 48 triangles looked into the material and are turned round",
                                      "1 shell lies within another and was turned as a body is; it counts as "
                                      "a void, the first at (1, 1, 1)"}));
  ASSERT_EQ(made->shells.size(), 4u);
  const std::vector<std::pair<std::uint32_t, double>> wanted{{0, 729}, {1, -343}, {2, 125}, {0, 8 * 49}};
  for (std::size_t s = 0; s < 4; ++s) {
    EXPECT_EQ(made->shells[s].depth, wanted[s].first);
    EXPECT_DOUBLE_EQ(made->shells[s].volume, wanted[s].second);
    EXPECT_EQ(made->shells[s].first, 12 * s);
  }
  const auto again = closed_mesh(made->mesh);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_TRUE(again->notices.empty()) << again->notices[0];
}

TEST(ClosedMesh, ARepeatedTriangleIsLeftOutOrNamed) {
  Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  mesh.triangles.insert(mesh.triangles.begin() + 5, mesh.triangles[2]);
  const auto once = closed_mesh(loose(mesh));
  ASSERT_TRUE(once) << once.error().message;
  EXPECT_EQ(once->mesh.triangles.size(), 12u);
  EXPECT_EQ(once->numbers[5], 6u);
  EXPECT_EQ(once->notices, (std::vector<std::string>{
                               "1 triangle repeats one with the same corners and is left out, the first "
                               "of them triangle 6, which repeats triangle 3"}));
  mesh.triangles.pop_back();
  const std::string said = refusal(mesh);
  EXPECT_EQ(said.find("the surface is open: "), 0u) << said;
  EXPECT_NE(said.find(", and triangle 6 repeats triangle 3; close it in the program"), std::string::npos)
      << said;
}

TEST(ClosedMesh, ABodyThatIsWrittenTwiceOrFromBothSidesCountsOnce) {
  const Mesh right = cases::block({0, 0, 0}, {1, 1, 1});
  for (const bool from_both_sides : {false, true}) {
    Mesh mesh = right;
    cases::append(mesh, right);
    if (from_both_sides) turn_round(mesh, 12, 24);
    const auto made = closed_mesh(mesh);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->mesh.triangles.size(), 12u);
    EXPECT_TRUE(solid::TriangleTree(made->mesh).holds({0.5, 0.5, 0.25}));
    ASSERT_EQ(made->notices.size(), 1u);
    EXPECT_EQ(made->notices[0].find("12 triangles repeat one with the same corners and are left out"), 0u)
        << made->notices[0];
  }
}

TEST(ClosedMesh, BodiesThatTouchInTrianglesKeepThem) {
  Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1}), beside = mesh;
  for (Vector& p : beside.vertices) p.x = 2 - p.x;
  turn_round(beside, 0, 12);
  cases::append(mesh, beside);
  const auto made = closed_mesh(mesh);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->mesh.triangles.size(), 24u);
}

TEST(ClosedMesh, WhatCannotBeToldStaysAsItIs) {
  // Two blocks that share an edge: four triangles meet there.
  Mesh edge = cases::block({0, 0, 0}, {1, 1, 1});
  cases::append(edge, cases::block({1, 1, 0}, {2, 2, 1}));
  turn_round(edge, 0, 1);
  // Two blocks that cross.
  Mesh crossing = cases::block({0, 0, 0}, {2, 2, 2});
  cases::append(crossing, cases::block({0.5, 0.5, 0.5}, {3, 3, 3}));
  turn_round(crossing, 0, 1);
  for (const Mesh& mesh : {edge, crossing}) {
    const auto made = closed_mesh(mesh);
    ASSERT_TRUE(made) << made.error().message;
    ASSERT_EQ(made->notices.size(), 2u);
    EXPECT_NE(made->notices[0].find(" turned as given, because surfaces meet or cross there"),
              std::string::npos)
        << made->notices[0];
    EXPECT_EQ(made->notices[1].find("at 3 edges the triangles are turned against each other"), 0u)
        << made->notices[1];
  }
}

TEST(ClosedMesh, ThousandsOfNestedShellsTakeNoSquareOfTime) {
  Mesh mesh;
  constexpr int kShells = 10'000;
  for (int k = 1; k <= kShells; ++k) {
    const double half = k;
    cases::append(mesh, cases::block({-half, -half, -half}, {half, half, half}));
  }
  const cases::Stopwatch watch;
  const auto made = closed_mesh(std::move(mesh));
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_LT(watch.seconds(), 5 * cases::kSlowdown);
  EXPECT_EQ(made->shells.size(), std::size_t{kShells});
  EXPECT_FALSE(made->notices.empty());
}

TEST(ClosedMesh, CoordinatesThatPredicatesDoNotTakeAreZero) {
  Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  mesh.vertices[0].x = 1e-99;
  const auto made = closed_mesh(mesh);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->mesh.vertices[0].x, 0);
}

TEST(ClosedMesh, AFlatMeshEnclosesNothing) {
  Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  for (Vector& p : mesh.vertices) p.y = 0.5;
  EXPECT_EQ(refusal(mesh),
            "all of it lies in the plane y = 0.5, so it encloses nothing; export it as a solid body");
}

TEST(ClosedMesh, RefusesWhatIsNoMesh) {
  EXPECT_EQ(refusal({}), "there are no triangles in it, or none with an area");
  Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  mesh.vertices[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(mesh), "vertex 3 at (0, nan, 0) lies beyond 1e+09 mm; look at its units");
  mesh.vertices[2].y = 1.1e9;
  EXPECT_EQ(refusal(mesh), "vertex 3 at (0, 1.1e+09, 0) lies beyond 1e+09 mm; look at its units");
}

}  // namespace
}  // namespace lekalo::solid_mesh_test
