#include "lekalo/solid/mesh.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "support/solids.hpp"

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
  EXPECT_EQ(made->mesh.vertices.size(), 8u);
  ASSERT_EQ(made->notices.size(), 1u);
  EXPECT_EQ(made->notices[0], "1 triangle had two corners at one place and left out");
  mesh.triangles.pop_back();
  EXPECT_NE(refusal(mesh).find("on triangle 5;"), std::string::npos) << refusal(mesh);
}

TEST(ClosedMesh, WhichWayTrianglesTurnDoesNotMatterAndIsTold) {
  Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  const auto made = closed_mesh(mesh);
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->notices.size(), 1u);
  EXPECT_EQ(made->notices[0].find("at 3 edges the triangles are turned against each other"), 0u)
      << made->notices[0];
}

TEST(ClosedMesh, RefusesWhatIsNoMesh) {
  EXPECT_EQ(refusal({}), "there are no triangles in it, or none with three corners");
  Mesh mesh = cases::block({0, 0, 0}, {1, 1, 1});
  mesh.vertices[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(mesh), "vertex 3 at (0, nan, 0) lies beyond 1e+09 mm; look at its units");
  mesh.vertices[2].y = 1.1e9;
  EXPECT_EQ(refusal(mesh), "vertex 3 at (0, 1.1e+09, 0) lies beyond 1e+09 mm; look at its units");
}

}  // namespace
}  // namespace lekalo::solid_mesh_test
