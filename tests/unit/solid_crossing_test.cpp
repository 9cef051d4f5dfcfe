#include "lekalo/solid/crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/solid/triangle_tree.hpp"
#include "support/crossing_solids.hpp"
#include "support/solids.hpp"

namespace lekalo::solid_crossing_test {
namespace {

using cases::block;
using cases::both;
using solid::closed_mesh;
using solid::Crossings;
using solid::Mesh;
using solid::Vector;

Crossings crossings_of(Mesh mesh) {
  const auto closed = closed_mesh(std::move(mesh));
  EXPECT_TRUE(closed) << (closed ? "" : closed.error().message);
  return closed ? solid::crossings(closed->mesh) : Crossings{};
}

TEST(Crossings, WhatChangesInsideAndOutsideIsFoundHoweverItLies) {
  for (const auto& [what, mesh] : cases::changing_meshes()) {
    const Crossings found = crossings_of(mesh);
    EXPECT_TRUE(found.changing) << what;
    EXPECT_TRUE(found.complete) << what;
  }
}

TEST(Crossings, WhatTouchesNestsOrIsThinChangesNothing) {
  // A part of the top is folded over by a rounding: two triangles lie on the others, one of them upside down.
  Mesh folded = block({0, 0, 0}, {20, 20, 20});
  folded.vertices.push_back({12, 12, 20});
  folded.vertices.push_back({8, 8, 20});
  folded.triangles.erase(folded.triangles.begin() + 2, folded.triangles.begin() + 4);
  // Corners 4, 5, 6, 7 are (0,0), (20,0), (0,20), (20,20) of the top; 8 and 9 have changed places.
  folded.triangles.insert(folded.triangles.end(),
                          {{4, 5, 8}, {5, 7, 9}, {5, 9, 8}, {7, 6, 9}, {6, 4, 8}, {6, 8, 9}});
  struct Case {
    const char* what;
    Mesh mesh;
    bool touches;
  };
  for (const auto& [what, mesh, touches] :
       {Case{"a block", block({0, 0, 0}, {20, 20, 20}), false},
        Case{"a void", both(block({0, 0, 0}, {20, 20, 20}), block({5, 5, 5}, {9, 9, 9})), false},
        Case{"one face", both(block({0, 0, 0}, {20, 20, 20}), block({20, 0, 0}, {40, 20, 20})), false},
        Case{"parts of faces", both(block({0, 0, 0}, {20, 20, 20}), block({20, 3, 4}, {40, 30, 30})), true},
        Case{"one edge", both(block({0, 0, 0}, {20, 20, 20}), block({20, 20, 0}, {40, 40, 20})), false},
        Case{"a thousandth", both(block({0, 0, 0}, {20, 20, 20}), block({19.999, 3, 4}, {39, 30, 30})), true},
        Case{"a fold", folded, false}}) {
    const Crossings found = crossings_of(mesh);
    EXPECT_FALSE(found.changing) << what;
    EXPECT_EQ(found.edges > 0, touches) << what;
  }
}

/// How many times the surface goes around a point, as the sum of the solid angles of its triangles.
double winding(const Mesh& mesh, Vector p) {
  double sum = 0;
  for (const solid::Triangle& t : mesh.triangles) {
    const Vector a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p, c = mesh.vertices[t[2]] - p;
    sum += std::atan2(dot(a, cross(b, c)), norm(a) * norm(b) * norm(c) + dot(a, b) * norm(c) +
                                               dot(b, c) * norm(a) + dot(c, a) * norm(b));
  }
  return sum / (2 * std::numbers::pi);
}

/// Of two rings whose triangles all look outwards, and wave, points with room around them say by how often
/// the surface goes around them whether it may be read as a body.
TEST(Crossings, OfWavyRingsTheyAgreeWithWindingNumbers) {
  int crossing = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    Mesh mesh = cases::ring(random, 24, 12, 30, 8), other = cases::ring(random, 24, 12, 30, 8);
    const Vector shift{random.uniform(0, 90), random.uniform(-9, 9), random.uniform(-9, 9)};
    for (Vector& p : other.vertices) p = Vector{p.x, -p.z, p.y} + shift;  // as the links of a chain
    mesh = both(std::move(mesh), other);
    const Crossings found = crossings_of(mesh);
    const solid::TriangleTree tree(mesh);
    const solid::Box box = tree.box();
    bool strange = false;
    for (int k = 0; k < 4000 && !strange; ++k) {
      const Vector p{random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y),
                     random.uniform(box.low.z, box.high.z)};
      if (tree.nearest(p, 0.2)) continue;
      const double around = std::abs(winding(mesh, p));
      strange = around > 1.5;
    }
    if (strange) {
      EXPECT_TRUE(found.changing) << seed;
    }
    if (found.edges == 0) {
      EXPECT_FALSE(found.changing) << seed;
    }
    (found.changing ? crossing : apart) += 1;
  }
  EXPECT_GT(crossing, 2);
  EXPECT_GT(apart, 2);
}

}  // namespace
}  // namespace lekalo::solid_crossing_test
