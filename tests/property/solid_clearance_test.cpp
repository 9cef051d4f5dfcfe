// Distances, inside and outside, bounds of the field and the clearance of points, each against the plain
// definition.

#include "lekalo/solid/clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/cases.hpp"
#include "support/solids.hpp"

namespace lekalo::solid_clearance_test {
namespace {

using solid::Vector;
using Corners = std::array<Vector, 3>;

solid::ClosedMesh closed(const solid::Mesh& mesh) {
  auto made = solid::closed_mesh(mesh);
  EXPECT_TRUE(made.has_value()) << (made ? "" : made.error().message);
  return *std::move(made);
}

double to_segment(Vector p, Vector a, Vector b) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return norm(p - (a + t * (b - a)));
}

/// Of a triangle that is not thin.
double to_triangle(Vector p, const Corners& t) {
  const Vector n = cross(t[1] - t[0], t[2] - t[0]);
  bool above = true;
  double least = 1e300;
  for (const std::size_t k : {0U, 1U, 2U}) {
    const Vector &a = t[k], &b = t[(k + 1) % 3];
    least = std::min(least, to_segment(p, a, b));
    above = above && dot(cross(b - a, p - a), n) >= 0;
  }
  return above ? std::abs(dot(n, p - t[0])) / norm(n) : least;
}

std::vector<Corners> corners(const solid::Mesh& mesh) {
  std::vector<Corners> all;
  for (const solid::Triangle& t : mesh.triangles)
    all.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  return all;
}

double to_mesh(Vector p, const std::vector<Corners>& all) {
  double least = 1e300;
  for (const Corners& t : all) least = std::min(least, to_triangle(p, t));
  return least;
}

/// By the solid angle of all triangles: an odd number of whole spheres inside.
bool inside(Vector p, const std::vector<Corners>& all) {
  double angle = 0;
  for (const Corners& t : all) {
    const Vector a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double x = norm(a), y = norm(b), z = norm(c);
    angle += 2 * std::atan2(dot(a, cross(b, c)), x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y);
  }
  return std::lround(angle / (4 * std::numbers::pi)) % 2 != 0;
}

solid::Mesh body(Random& random) {
  solid::Mesh mesh = cases::ring(random, 12 + static_cast<std::uint32_t>(random.below(20)), 8, 30, 8);
  if (random.below(2) == 0) cases::append(mesh, cases::block({28, -2, -2}, {32, 2, 2}));  // a void
  if (random.below(2) == 0) cases::append(mesh, cases::block({-5, -5, -20}, {5, 5, 20}));
  return mesh;
}

Vector somewhere(Random& random) {
  return {random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-25, 25)};
}

TEST(TriangleTree, DistancesAndSidesAreThoseOfTheDefinition) {
  Random random(cases::seed(), 41);
  std::size_t within = 0;
  for (std::size_t i = 0; i < cases::case_count(40); ++i) {
    const solid::Mesh mesh = closed(body(random)).mesh;
    const auto all = corners(mesh);
    const solid::TriangleTree tree(mesh);
    std::optional<std::uint32_t> before;
    for (int k = 0; k < 50; ++k) {
      const Vector p = somewhere(random);
      const double exact = to_mesh(p, all);
      const auto near = tree.nearest(p, std::numeric_limits<double>::infinity(), before);
      ASSERT_TRUE(near);
      EXPECT_LE(near->low, exact + 1e-12);
      EXPECT_GE(near->high, exact - 1e-12);
      EXPECT_LT(near->high - near->low, 1e-11);
      EXPECT_NEAR(norm(p - near->place), exact, 1e-11);
      EXPECT_NEAR(to_triangle(near->place, all[near->triangle]), 0, 1e-11);
      std::vector<double> widths;
      double most = std::numeric_limits<double>::infinity(), least = most;
      for (const auto& corners : all) {
        widths.push_back(random.uniform(0, 3));
        most = std::min(most, to_triangle(p, corners) + widths.back());
        least = std::min(least, to_triangle(p, corners) - widths.back());
      }
      EXPECT_NEAR(tree.least_sum(p, widths, 1, 0), most, 1e-11);
      EXPECT_NEAR(tree.least_sum(p, widths, -1, -3), least, 1e-11);
      EXPECT_FALSE(tree.nearest(p, 0.999 * exact - 1e-9));
      EXPECT_TRUE(tree.nearest(p, 1.001 * exact + 1e-9));
      EXPECT_EQ(tree.holds(p), inside(p, all)) << i;
      within += tree.holds(p) ? 1 : 0;
      before = near->triangle;
    }
  }
  EXPECT_GT(within, 50u);
}

TEST(TriangleTree, SidesHoldWhereTheWayMeetsCornersAndEdges) {
  // Everything lies on whole numbers, so that a way straight up runs through corners, edges and upright
  // faces.
  Random random(cases::seed(), 42);
  for (std::size_t i = 0; i < cases::case_count(40); ++i) {
    solid::Mesh mesh = cases::block({0, 0, 0}, {8, 8, 8});
    const auto at = [&] { return static_cast<double>(1 + random.below(3)); };
    const Vector low{at(), at(), at()}, high = low + Vector{at(), at(), at()};
    cases::append(mesh, cases::block(low, high));
    const solid::TriangleTree tree(closed(mesh).mesh);
    for (int x = -1; x <= 9; ++x) {
      for (int y = -1; y <= 9; ++y) {
        for (int z = -1; z <= 8; ++z) {
          const Vector p{double(x), double(y), z + 0.5};
          const auto in = [&](Vector a, Vector b) {
            return p.x > a.x && p.x < b.x && p.y > a.y && p.y < b.y && p.z > a.z && p.z < b.z;
          };
          const bool on = to_mesh(p, corners(mesh)) == 0;
          if (on) continue;
          ASSERT_EQ(tree.holds(p), in({0, 0, 0}, {8, 8, 8}) && !in(low, high)) << x << " " << y << " " << z;
        }
      }
    }
  }
}

/// Nodes are in preorder, halve their triangles and hold them, and leaves have no more than they may.
void expect_tree(const solid::TriangleTree& tree, std::uint32_t leaf, std::uint32_t triangles) {
  const auto& nodes = tree.nodes();
  std::uint32_t next = 0, in_order = 0;
  const auto look = [&](const auto& self, std::uint32_t begin, std::uint32_t end) -> void {
    ASSERT_LT(next, nodes.size());
    const solid::TriangleTree::Node& node = nodes[next++];
    ASSERT_EQ(node.begin, begin);
    ASSERT_EQ(node.end, end);
    solid::Box box;
    for (std::uint32_t k = begin; k < end; ++k)
      for (const Vector p : tree.corners(k)) box.hold(p);
    EXPECT_EQ(node.box.low, box.low);
    EXPECT_EQ(node.box.high, box.high);
    if (end - begin <= leaf) {
      EXPECT_EQ(node.right, 0U);
      in_order = end;
      return;
    }
    const std::uint32_t half = begin + (end - begin) / 2;
    self(self, begin, half);
    ASSERT_EQ(node.right, next);
    self(self, half, end);
  };
  look(look, 0, triangles);
  EXPECT_EQ(next, nodes.size());
  EXPECT_EQ(in_order, triangles);
}

TEST(TriangleTree, ItIsTheSameForAnyThreadsAndHalvesItsTriangles) {
  Random random(cases::seed(), 47);
  for (const std::uint32_t around : {3U, 17U, 230U}) {
    const solid::Mesh mesh = cases::ring(random, around, 40, 30, 8);
    const auto triangles = static_cast<std::uint32_t>(mesh.triangles.size());
    for (const std::uint32_t leaf : {1U, 2U, 4U, 7U}) {
      const solid::TriangleTree one(mesh, leaf);
      expect_tree(one, leaf, triangles);
      for (const unsigned threads : {2U, 3U, 8U}) {
        const solid::TriangleTree other(mesh, leaf, threads);
        expect_tree(other, leaf, triangles);
        ASSERT_EQ(other.nodes().size(), one.nodes().size());
        for (std::uint32_t k = 0; k < triangles; ++k) {
          ASSERT_EQ(other.triangle(k), one.triangle(k));
          ASSERT_EQ(other.place_in_order(other.triangle(k)), k);
          ASSERT_EQ(other.corners(k), one.corners(k));
        }
      }
    }
  }
}

TEST(TriangleTree, TheForemostCornerIsOne) {
  Random random(cases::seed(), 46);
  for (std::size_t i = 0; i < cases::case_count(10); ++i) {
    const solid::Mesh mesh = body(random);
    const solid::TriangleTree tree(mesh, 1 + static_cast<std::uint32_t>(random.below(4)));
    for (int k = 0; k < 10; ++k) {
      const Vector n{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      double least = 1e300;
      for (const Vector v : mesh.vertices) least = std::min(least, dot(n, v));
      EXPECT_EQ(dot(n, tree.foremost(n)), least);
    }
  }
}

TEST(TriangleTree, ABoundHoldsBesideTrianglesAsThinAsCanBe) {
  Random random(cases::seed(), 43);
  for (std::size_t i = 0; i < cases::case_count(2000); ++i) {
    // Three corners on a line but for ulps, or but for what is far more than these and far less than a
    // micrometre: the distance is that to the line.
    const Vector a = somewhere(random), b = somewhere(random), off = somewhere(random);
    const double t = random.uniform(), width = i % 2 == 0 ? 0 : std::pow(10, random.uniform(-12, -7));
    const Vector c = a + t * (b - a) + width / norm(off) * off;
    const solid::Mesh needle{{a, b, c}, {{0, 1, 2}}};
    const Vector p = somewhere(random);
    const auto near = solid::TriangleTree(needle).nearest(p);
    const double exact = to_segment(p, a, b);
    ASSERT_LE(near->low, exact + width + 1e-12) << i;
    ASSERT_GE(near->high, exact - width - 1e-12) << i;
    ASSERT_LT(near->high - near->low, width == 0 ? 1e-11 : 1e-4) << i;
  }
}

TEST(DistanceField, NoBoundIsAboveTheDistance) {
  Random random(cases::seed(), 44);
  for (std::size_t i = 0; i < cases::case_count(4); ++i) {
    const solid::Mesh mesh = closed(body(random)).mesh;
    const solid::TriangleTree tree(mesh);
    const double cell = random.uniform(0.3, 2), margin = random.uniform(1, 10);
    solid::DistanceField field(tree, cell, margin, 100);
    double off = 0;
    std::size_t far = 0;
    for (int k = 0; k < 400; ++k) {
      const Vector p = somewhere(random), at = 1 / cell * (p - field.low());
      const solid::DistanceField::Place place{static_cast<float>(at.x), static_cast<float>(at.y),
                                              static_cast<float>(at.z)};
      const auto near = *tree.nearest(p);
      const double distance = tree.holds(p) ? -near.low : near.high;
      EXPECT_LE(field.bound(place), distance);
      const std::uint64_t cell_there = field.unmade_at(place);
      if (cell_there == solid::DistanceField::kNoCell) continue;
      // Another cell of the same brick may have some of its corners.
      const std::uint64_t beside = field.unmade_at({place.x + 1, place.y, place.z});
      if (beside != solid::DistanceField::kNoCell) field.make_cells({beside}, 1);
      field.make_cells({cell_there, cell_there}, 1);
      EXPECT_EQ(field.unmade_at(place), solid::DistanceField::kNoCell);
      const double bound = field.bound(place);
      EXPECT_LE(bound, distance);
      EXPECT_GE(bound, distance - 1.74 * cell - 0.01);  // a mean of corners, less the way to them
      if (distance > 4 * cell) {
        ++far;
        off += (distance - bound) / cell;
      }
    }
    // Far from the surface most cells see it as a plane, and the mean is the distance.
    EXPECT_GT(far, 20u);
    EXPECT_LT(off / static_cast<double>(far), 0.2);
  }
}

TEST(ClearanceMeter, FindsTheLeastSignedDistanceAtEveryPose) {
  Random random(cases::seed(), 45);
  std::size_t outside = 0, across = 0;
  for (std::size_t i = 0; i < cases::case_count(4); ++i) {
    const solid::Mesh mesh = closed(body(random)).mesh;
    const solid::TriangleTree tree(mesh);
    // Points about the body, some of them far from the origin when they were measured.
    const Vector away{random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4), 0};
    std::vector<Vector> points;
    while (points.size() < 600) {
      const Vector p = somewhere(random);
      if (!tree.holds(p) && tree.nearest(p)->low > 1) points.push_back(p + away);
    }
    solid::ClearanceMeter one(tree, points, 1, 1), two(tree, points, 0.7, 2);
    for (int k = 0; k < 6; ++k) {
      const double a = k == 0 ? 0 : random.uniform(-0.05, 0.05), c = std::cos(a), s = std::sin(a),
                   most = k == 0 ? 0 : 1.5;
      solid::Motion motion{{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}, {}};
      motion.shift =
          Vector{random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)} -
          motion(away);
      double low = 1e300, high = 1e300;
      for (const Vector p : points) {
        const auto near = *tree.nearest(motion(p));
        const bool in = tree.holds(motion(p));
        low = std::min(low, in ? -near.high : near.low);
        high = std::min(high, in ? -near.low : near.high);
      }
      for (solid::ClearanceMeter* const meter : {&one, &two, &one}) {
        const solid::Clearance found = meter->at(motion);
        EXPECT_LE(found.low, high);
        EXPECT_GE(found.high, low);
        EXPECT_NEAR(found.low, low, 1e-10);
        EXPECT_NEAR(found.high, high, 1e-10);
        ASSERT_LT(found.point, points.size());
        EXPECT_NEAR(norm(motion(points[found.point]) - found.place), std::abs(found.high), 1e-9);
      }
      ++(high > 0 ? outside : across);
    }
  }
  EXPECT_GT(outside, 5u);
  EXPECT_GT(across, 5u);
}

}  // namespace
}  // namespace lekalo::solid_clearance_test
