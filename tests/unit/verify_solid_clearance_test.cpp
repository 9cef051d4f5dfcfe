// A part at a pose in a blank, both meshes: what the checker shows, refutes and leaves open.

#include <gtest/gtest.h>

#include <string>

#include "lekalo/base/stop.hpp"
#include "support/solids.hpp"
#include "support/stopwatch.hpp"
#include "support/verify_solids.hpp"

namespace lekalo::verify::verify_solid_clearance_test {
namespace {

using cases::answer;
using cases::block;
using cases::solid_pose;
using cases::unturned;
using solid::Mesh;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

Mesh both(Mesh a, const Mesh& b) {
  cases::append(a, b);
  return a;
}

TEST(SolidClearance, ACubeInACubeHasItsClearanceToTheLastDigit) {
  const Mesh part = block({0, 0, 0}, {8, 8, 8}), blank = block({0, 0, 0}, {10, 10, 10});
  const SolidPose middle = unturned({"1", "1", "1"});
  EXPECT_EQ(answer(part, blank, middle, "1"), "shown");
  EXPECT_EQ(answer(part, blank, middle, "0.999999999999999999999999999999"), "shown");
  EXPECT_EQ(answer(part, blank, middle, "0"), "shown");
  EXPECT_TRUE(says(answer(part, blank, middle, "1.000000000000000000000000000001"),
                   "fault: triangle 1 of the part, placed at (1, 1, 1), is nearer than the clearance to"))
      << answer(part, blank, middle, "1.000000000000000000000000000001");
  EXPECT_TRUE(says(answer(part, blank, middle, "1.1"), "fault: the clearance 1.1 mm is above 1.0000000000"))
      << answer(part, blank, middle, "1.1");
  // A decimal that no double is.
  const SolidPose off = unturned({"1.1", "1", "1"});
  EXPECT_EQ(answer(part, blank, off, "0.9"), "shown");
  EXPECT_TRUE(says(answer(part, blank, off, "0.90000000000000000000000001"), "is nearer than"));
}

TEST(SolidClearance, TheLeastDistanceIsEnclosed) {
  const SolidMesh part = cases::checked(block({0, 0, 0}, {8, 8, 8})),
                  blank = cases::checked(block({0, 0, 0}, {10, 10, 10}));
  const auto pair = SolidPair::make(part, blank, unturned({"1.1", "1", "1"}));
  ASSERT_TRUE(pair);
  const SolidAnswer said = pair->check(cases::decimal("0"));
  EXPECT_LE(said.least.low, 0.9);
  EXPECT_GE(said.least.high, 0.9);
  EXPECT_LT(said.least.high - said.least.low, 1e-13);
}

TEST(SolidClearance, TurnsWithRationalSinesAreExact) {
  // About z by the angle of 3, 4, 5: the part's corner (5, 0) goes to (3, 4), (0, 5) to (-4, 3).
  const Mesh part = block({0, 0, 0}, {5, 5, 5}), blank = block({-5, -1, -1}, {4, 8, 6});
  const SolidPose pose = solid_pose({"2", "0", "0", "1"}, {"0", "0", "0"});
  EXPECT_EQ(answer(part, blank, pose, "1"), "shown");
  EXPECT_TRUE(says(answer(part, blank, pose, "1.00000000000000000000001"), "is nearer"));
  // Any length of the quaternion, and either sign.
  EXPECT_EQ(answer(part, blank, solid_pose({"-2e-30", "0", "0", "-1e-30"}, {"0", "0", "0"}), "1"), "shown");
  EXPECT_EQ(answer(part, blank, solid_pose({"0.4", "0", "0", "0.2"}, {"0", "0", "0"}), "1"), "shown");
  // The other way round it sticks out.
  EXPECT_TRUE(
      says(answer(part, blank, solid_pose({"2", "0", "0", "-1"}, {"0", "0", "0"}), "0"), "passes through"));
  EXPECT_EQ(answer(part, blank, solid_pose({"0", "0", "0", "0"}, {"0", "0", "0"}), "1"),
            "the quaternion is 0, which is no rotation");
}

TEST(SolidMotion, IsTheRotationOfTheQuaternionThenTheShift) {
  // A third of a turn about (1, 1, 1): x goes to y, y to z, z to x.
  const SolidMotion third(solid_pose({"0.5", "0.5", "0.5", "0.5"}, {"0.1", "0.2", "0.3"}));
  const auto is = [](const Exact3& p, const Fraction& x, const Fraction& y, const Fraction& z) {
    return p[0] == x && p[1] == y && p[2] == z;
  };
  EXPECT_TRUE(is(third(Exact3{7, 8, 9}), Fraction(91, 10), Fraction(36, 5), Fraction(83, 10)));
  const Vec3 near = third(Vec3{just(7), just(8), just(9)});
  for (const auto& [span, value] : {std::pair(near[0], 9.1), {near[1], 7.2}, {near[2], 8.3}}) {
    EXPECT_LE(span.low, value);
    EXPECT_GE(span.high, value);
    EXPECT_LT(span.high - span.low, 1e-13);
  }
  // Any other: columns of length 1, upright to each other, right-handed, with the axis in place.
  const SolidMotion any(solid_pose({"5", "1", "-2", "3"}, {"0", "0", "0"}));
  const std::array<Exact3, 3> to{any(Exact3{1, 0, 0}), any(Exact3{0, 1, 0}), any(Exact3{0, 0, 1})};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) EXPECT_TRUE(dot(to[i], to[j]) == (i == j ? 1 : 0)) << i << j;
    EXPECT_TRUE(cross(to[i], to[(i + 1) % 3]) == to[(i + 2) % 3]);
  }
  EXPECT_TRUE(is(any(Exact3{1, -2, 3}), 1, -2, 3));
  EXPECT_TRUE(Fraction(to[0][0] + to[1][1] + to[2][2] + 1) == Fraction(100, 39));
  // A turn by the angle of 3, 4, 5 about each axis, counter-clockwise as seen from its tip.
  const Fraction c(3, 5), s(4, 5);
  EXPECT_TRUE(is(SolidMotion(solid_pose({"2", "1", "0", "0"}, {"0", "0", "0"}))(Exact3{0, 1, 0}), 0, c, s));
  EXPECT_TRUE(is(SolidMotion(solid_pose({"2", "0", "1", "0"}, {"0", "0", "0"}))(Exact3{0, 0, 1}), s, 0, c));
  EXPECT_TRUE(is(SolidMotion(solid_pose({"2", "0", "0", "1"}, {"0", "0", "0"}))(Exact3{1, 0, 0}), c, s, 0));
}

TEST(SolidClearance, ATiltedPartIsMeasuredExactly) {
  const Mesh part = block({0, 0, 0}, {1, 1, 1});
  const Mesh blank = block({-3, -3, -3}, {4, 4, 4});
  // Turned by 45 degrees about z, q = (cos, sin) of 22.5 degrees, is no fraction; by 3-4-5 about x and y it
  // is.
  const SolidPose pose = solid_pose({"2", "1", "0", "0"}, {"0", "0.5", "0"});
  // y of (x, y, z) becomes (3 y - 4 z) / 5 + 0.5: from -0.3 to 1.1; z becomes (4 y + 3 z) / 5: from 0 to 1.4.
  EXPECT_EQ(answer(part, blank, pose, "2.6"), "shown");
  EXPECT_TRUE(says(answer(part, blank, pose, "2.6000000000000000000001"), "is nearer"));
}

TEST(SolidClearance, ATouchIsNoClearanceAndLeavesZeroOpen) {
  const Mesh blank = block({0, 0, 0}, {10, 10, 10});
  const Mesh part = block({0, 0, 0}, {8, 8, 8});
  // The last one touches from outside.
  for (const auto& shift : {unturned({"0", "1", "1"}), unturned({"0", "0", "0"}), unturned({"2", "1", "1"}),
                            unturned({"10", "1", "1"})}) {
    EXPECT_TRUE(says(answer(part, blank, shift, "1e-300"), "touches"))
        << answer(part, blank, shift, "1e-300");
    EXPECT_TRUE(says(answer(part, blank, shift, "1e-300"), "fault"));
    EXPECT_TRUE(says(answer(part, blank, shift, "0"), "open: ")) << answer(part, blank, shift, "0");
  }
  // Apart by less than any double between 0 and 1 would tell.
  EXPECT_EQ(answer(part, blank, unturned({"1e-40", "1", "1"}), "0"), "shown");
  EXPECT_EQ(answer(part, blank, unturned({"1e-40", "1", "1"}), "1e-40"), "shown");
  EXPECT_TRUE(says(answer(part, blank, unturned({"1e-40", "1", "1"}), "1.1e-40"), "is nearer"));
  EXPECT_TRUE(says(answer(part, blank, unturned({"-1e-40", "1", "1"}), "0"), "passes through"));
}

TEST(SolidClearance, APartThatCrossesOrLiesOutsideIsRefuted) {
  const Mesh part = block({0, 0, 0}, {8, 8, 8}), blank = block({0, 0, 0}, {10, 10, 10});
  EXPECT_TRUE(says(answer(part, blank, unturned({"5", "1", "1"}), "0"), "passes through"));
  EXPECT_TRUE(says(answer(part, blank, unturned({"20", "1", "1"}), "1"),
                   "fault: the part is not in the blank: its surface at (20, 1, 1) lies outside"))
      << answer(part, blank, unturned({"20", "1", "1"}), "1");
  EXPECT_TRUE(says(answer(part, blank, unturned({"1", "1", "1"}), "-1"), "open: the clearance -1"));
  // A part around the blank.
  EXPECT_TRUE(says(answer(blank, part, unturned({"-1", "-1", "-1"}), "1"), "lies outside"));
}

TEST(SolidClearance, ACoreThatThePartSwallowsIsSeen) {
  const Mesh part = block({1, 1, 1}, {9, 9, 9});
  const Mesh cored = both(block({0, 0, 0}, {10, 10, 10}), block({4, 4, 4}, {6, 6, 6}));
  EXPECT_TRUE(says(answer(part, cored, unturned(), "1"),
                   "fault: the blank's surface at (4, 4, 4) lies within the part"))
      << answer(part, cored, unturned(), "1");
  // A part with a void around the core is as good as one without.
  const Mesh hollow = both(part, block({3, 3, 3}, {7, 7, 7}));
  EXPECT_EQ(answer(hollow, cored, unturned(), "1"), "shown");
  // A part's void within material is no matter, and one of its shells in the blank's void is.
  EXPECT_EQ(answer(hollow, block({0, 0, 0}, {10, 10, 10}), unturned(), "1"), "shown");
  const Mesh island = both(hollow, block({4.5, 4.5, 4.5}, {5.5, 5.5, 5.5}));
  EXPECT_TRUE(says(answer(island, cored, unturned(), "0.5"), "lies outside"));
  EXPECT_EQ(answer(island, block({0, 0, 0}, {10, 10, 10}), unturned(), "1"), "shown");
  // Material in the blank's void, with a part of its own around nothing.
  const Mesh nested = both(cored, block({4.25, 4.25, 4.25}, {5.75, 5.75, 5.75}));
  EXPECT_EQ(answer(island, nested, unturned(), "0.25"), "shown");
}

TEST(SolidClearance, TurnedTrianglesMeanTheSame) {
  Mesh part = block({1, 1, 1}, {9, 9, 9}), blank = block({0, 0, 0}, {10, 10, 10});
  for (std::size_t t = 0; t < part.triangles.size(); t += 3)
    std::swap(part.triangles[t][0], part.triangles[t][1]);
  for (auto& t : blank.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(answer(part, blank, unturned(), "1"), "shown");
}

TEST(SolidClearance, WaysUpThroughEdgesAndCornersCountRight) {
  // Each way up from a corner of the small cubes meets corners, edges and upright faces of the others.
  Mesh blank = block({0, 0, 0}, {12, 12, 12});
  for (const double z : {3.0, 5.0, 7.0, 9.0}) cases::append(blank, block({1, 1, z}, {2, 2, z + 1}));
  EXPECT_EQ(answer(block({1, 1, 1}, {2, 2, 2}), blank, unturned(), "1"), "shown");
  EXPECT_TRUE(
      says(answer(block({1.25, 1.25, 3.25}, {1.75, 1.75, 3.75}), blank, unturned(), "0"), "lies outside"));
  // A vertex of the roof is right above.
  const Mesh house = [] {
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 4}};
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    return mesh;
  }();
  EXPECT_EQ(answer(block({0, 0, 0}, {0.5, 0.5, 0.5}), house, unturned({"2", "2", "1"}), "0.5"), "shown");
  EXPECT_EQ(answer(block({0, 0, 0}, {0.5, 0.5, 0.5}), house, unturned({"1.5", "1.5", "1"}), "0.5"), "shown");
  EXPECT_TRUE(says(answer(block({0, 0, 0}, {0.5, 0.5, 0.5}), house, unturned({"0", "0", "3"}), "0.5"),
                   "lies outside"));
}

TEST(SolidClearance, AnUprightSeamIsNotCrossed) {
  // The edge from (0, 0, 0) to (0, 0, 4) has a corner in its middle on one side, and a triangle without area.
  Mesh blank = block({0, 0, 0}, {4, 4, 4});
  blank.vertices.push_back({0, 0, 2});
  ASSERT_EQ(blank.triangles[4], (solid::Triangle{0, 1, 4}));
  blank.triangles[4] = {0, 1, 8};
  blank.triangles.push_back({8, 1, 4});
  blank.triangles.push_back({0, 8, 4});
  ASSERT_EQ(cases::checked(blank).triangles.size(), 14u);
  EXPECT_TRUE(says(answer(block({0, 0, -3}, {1, 1, -1}), blank, unturned(), "0.5"), "lies outside"));
  EXPECT_EQ(answer(block({1, 1, 1}, {3, 3, 3}), blank, unturned(), "1"), "shown");
}

TEST(SolidClearance, ContactsAreBounds) {
  const SolidMesh part = cases::checked(block({0, 0, 0}, {8, 8, 8})),
                  blank = cases::checked(block({0, 0, 0}, {10, 10, 10}));
  const auto pair = SolidPair::make(part, blank, solid_pose({"1", "0", "0", "1"}, {"9", "1", "1"}));
  ASSERT_TRUE(pair);
  const auto contact = [](const std::array<std::string, 3>& p, const std::array<std::string, 3>& q,
                          const std::string& distance) {
    SolidContact made;
    for (std::size_t k = 0; k < 3; ++k)
      made.part_point[k] = cases::decimal(p[k]), made.blank_point[k] = cases::decimal(q[k]);
    made.distance = cases::decimal(distance);
    return made;
  };
  // (x, y, z) goes to (9 - y, 1 + x, 1 + z).
  const auto bound = pair->bound_of(contact({"0", "3", "4"}, {"6", "0", "5"}, "1"), 1e-6);
  ASSERT_TRUE(bound) << bound.error().message;
  EXPECT_GE(*bound, 1);
  EXPECT_LE(*bound, 1 + 1e-12);
  const auto message = [&](const SolidContact& c) {
    const auto read = pair->bound_of(c, 1e-6);
    return read ? "a bound" : read.error().message;
  };
  EXPECT_TRUE(says(message(contact({"0.1", "3", "4"}, {"6", "0", "5"}, "1")), "off the part's surface"));
  EXPECT_TRUE(says(message(contact({"0", "3", "4"}, {"6", "0.5", "5"}, "0.5")), "off the blank's surface"));
  EXPECT_TRUE(says(message(contact({"0", "3", "4"}, {"6", "0", "5"}, "0.9")), "mm apart, not 0.9"));
  EXPECT_EQ(message(contact({"0.0000005", "3", "4"}, {"6", "0", "5"}, "1")), "a bound");
}

TEST(SolidClearance, SizesThatNoMachineHasAreRefused) {
  const Mesh cube = block({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(says(answer(cube, cube, unturned({"1e300", "0", "0"}), "1"), "is not within 1e+12 mm"));
}

TEST(SolidClearance, WorkIsBounded) {
  // Every triangle of a thin fan is near every other one, so that all pairs are looked at.
  Mesh fan;
  fan.vertices = {{0, 0, 0}, {0, 0, 9}};
  for (std::uint32_t k = 0; k < 1000; ++k) {
    fan.vertices.push_back({100, k * 1e-6, 5});
    fan.triangles.push_back({0, k + 2, (k + 1) % 1000 + 2});
    fan.triangles.push_back({1, k + 2, (k + 1) % 1000 + 2});
  }
  const SolidMesh part = cases::checked(fan);
  const auto pair = SolidPair::make(part, part, unturned({"0", "1e-9", "0"}));
  ASSERT_TRUE(pair);
  RunControl run;
  run.work_limit = 100'000;
  const auto said = stoppable(run, [&] { return pair->check(cases::decimal("0")); });
  ASSERT_FALSE(said);
  EXPECT_TRUE(said.error().out_of_work());
}

TEST(SolidGrowth, TwiceTheTrianglesTakeTwiceTheTime) {
  const auto seconds = [](std::uint32_t around) {
    Random random(7);
    const SolidMesh part = cases::checked(cases::ring(random, around, 20, 50, 9));
    const SolidMesh blank = cases::checked(block({-70, -70, -70}, {70, 70, 70}));
    Random again(7);
    const SolidMesh even = cases::checked(cases::ring(again, around, 20, 50, 10));
    double least = 1e9;
    for (int k = 0; k < 3; ++k) {
      const cases::Stopwatch watch;
      for (const SolidMesh* body : {&blank, &even}) {
        const auto pair = SolidPair::make(part, *body, unturned());
        EXPECT_FALSE(pair->check(cases::decimal("0.5")).fault);
      }
      least = std::min(least, watch.seconds());
    }
    return least;
  };
  const double once = seconds(100), twice = seconds(200);
  EXPECT_LT(twice, 3 * once + 0.02);
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_clearance_test
