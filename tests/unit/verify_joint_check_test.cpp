#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "verify/drawn/drawn_file.hpp"
#include "verify/profile/joint_check.hpp"

/// Joints between stretches of a contour, and what comes into them, as lines that are written down.
namespace lekalo::verify::verify_joint_check_test {
namespace {

constexpr double kKerf = 1, kWidth = 0.5, kSlack = 0.05;

Strokes way(const std::vector<Place>& places) {
  Strokes strokes;
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    strokes.push_back(line_between(places[i], places[i + 1]));
  return strokes;
}
/// A square of 20 mm, counter-clockwise about the origin or clockwise.
ContourRing square(bool is_hole = false) {
  const std::vector<Place> outer{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}, {-10, -10}};
  return ContourRing({way(is_hole ? std::vector<Place>(outer.rbegin(), outer.rend()) : outer)}, 0.05);
}
/// Around it, half a kerf outside or, of a hole, inside: from a place on the lower side to another.
ContourStretch around(double from, double to, double out, std::size_t line = 3) {
  return {line, way({{from, -out}, {out, -out}, {out, out}, {-out, out}, {-out, -out}, {to, -out}})};
}
FoundJoints found(const std::vector<ContourStretch>& stretches, bool is_hole = false) {
  ProfileWords words;
  words.kerf_mm = kKerf, words.joint_width_mm = kWidth;
  return joints_of_contour(stretches, square(is_hole), is_hole, "it", words, kSlack);
}
std::string said(const std::vector<ContourStretch>& stretches, bool is_hole = false) {
  std::string text;
  for (const std::string& finding : found(stretches, is_hole).findings) text += finding + "\n";
  return text;
}

TEST(VerifyJointCheck, AJointIsARectangleOutInTheWaste) {
  const FoundJoints outside = found({around(1, -0.5, 10.5)});
  ASSERT_EQ(outside.findings, std::vector<std::string>());
  ASSERT_EQ(outside.joints.size(), 1U);
  EXPECT_EQ(outside.joints[0].line, 3U);
  const std::array<Place, 4> wanted{Place{0, -10.5}, {0.5, -10.5}, {0.5, -11.5}, {0, -11.5}};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(length(outside.joints[0].corners[i] - wanted[i]), 0, 1e-12) << i;
  // The same in a hole, whose waste lies inside, and with the cut in the other direction.
  const FoundJoints inside = found({around(1, -0.5, 9.5)}, true);
  ASSERT_EQ(inside.findings, std::vector<std::string>());
  EXPECT_NEAR(length(inside.joints[0].corners[2] - Place{0.5, -8.5}), 0, 1e-12);
  ContourStretch back = around(1, -0.5, 10.5);
  std::reverse(back.edges.begin(), back.edges.end());
  for (Stroke& edge : back.edges) std::swap(edge.from, edge.to);
  const FoundJoints turned = found({back});
  ASSERT_EQ(turned.findings, std::vector<std::string>());
  EXPECT_NEAR(length(turned.joints[0].corners[2] - Place{0, -11.5}), 0, 1e-12);
}

TEST(VerifyJointCheck, AJointIsAsWideAsStatedWithinTheRoundingOfWords) {
  for (const double off : {-0.0049, 0.0049}) EXPECT_EQ(said({around(1 + off, -0.5, 10.5)}), "");
  for (const double off : {-0.0051, 0.0051})
    EXPECT_NE(said({around(1 + off, -0.5, 10.5)}).find("line 3: the cut along it ends 0."),
              std::string::npos);
}

TEST(VerifyJointCheck, EachStretchFollowsOneOther) {
  const auto lower = [](std::size_t line) {
    return ContourStretch{line, way({{1, -10.5}, {10.5, -10.5}, {10.5, 10.5}, {1, 10.5}})};
  };
  const ContourStretch upper{7, way({{-0.5, 10.5}, {-10.5, 10.5}, {-10.5, -10.5}, {-0.5, -10.5}})};
  EXPECT_EQ(said({lower(3), upper}), "");
  EXPECT_EQ(said({upper, lower(3)}), "");
  EXPECT_EQ(found({lower(3), upper}).joints.size(), 2U);
  EXPECT_EQ(said({lower(3), lower(5), upper}), "line 5: two cuts along it end before the same place\n");
  // Without the second the first ends where nothing goes on, as near as that may be.
  EXPECT_NE(said({lower(3)}), "");
  // Three stretches: each looks for the nearest beginning, wherever that stands in the program.
  const ContourStretch first{1, way({{1, -10.5}, {10.5, -10.5}, {10.5, -0.5}})},
      second{2, way({{10.5, 1}, {10.5, 10.5}, {1, 10.5}})};
  for (const std::vector<ContourStretch>& order :
       {std::vector<ContourStretch>{first, second, upper}, {second, first, upper}, {upper, second, first}}) {
    EXPECT_EQ(said(order), "");
    EXPECT_EQ(found(order).joints.size(), 3U);
  }
}

TEST(VerifyJointCheck, AllButTheJointsIsCut) {
  // Stretches that have joints between them, but leave the contour on the way: at the side, and by how much.
  const auto dented = [](double from, double to, double in) {
    return ContourStretch{3, way({{1, -10.5},
                                  {10.5, -10.5},
                                  {10.5, from},
                                  {10.5 + in, from},
                                  {10.5 + in, to},
                                  {10.5, to},
                                  {10.5, 10.5},
                                  {-10.5, 10.5},
                                  {-10.5, -10.5},
                                  {-0.5, -10.5}})};
  };
  EXPECT_EQ(said({dented(-3, 3, 0.04)}), "");
  const std::string away = said({dented(-3, 3, 0.06)});
  EXPECT_EQ(away, "it is not cut near (10.0000, -2.5000)\n");
  EXPECT_NE(said({dented(-9.9, -9.1, 0.5)}), "") << "the first millimetre";
  EXPECT_NE(said({dented(9.1, 9.9, 0.5)}), "") << "the last one";
  // Along a side the middle of each millimetre is looked at.
  EXPECT_EQ(said({dented(-2.9, -2.1, 0.5)}), "it is not cut near (10.0000, -2.5000)\n");
  EXPECT_EQ(said({dented(-2.4, -1.6, 0.5)}), "");
  // A hole is looked at on its inside.
  const ContourStretch inside{3, way({{1, -9.5},
                                      {9.5, -9.5},
                                      {9.5, -3},
                                      {9.3, -3},
                                      {9.3, 3},
                                      {9.5, 3},
                                      {9.5, 9.5},
                                      {-9.5, 9.5},
                                      {-9.5, -9.5},
                                      {-0.5, -9.5}})};
  EXPECT_EQ(said({inside}, true), "it is not cut near (10.0000, 2.5000)\n");
}

TEST(VerifyJointCheck, BordersBelongToWhatIsTrue) {
  ProfileWords words;
  words.kerf_mm = kKerf, words.joint_width_mm = kWidth;
  const auto says_with = [&](const ContourStretch& stretch, double slack) {
    const FoundJoints it = joints_of_contour({stretch}, square(), false, "it", words, slack);
    return it.findings.empty() ? "" : it.findings[0];
  };
  // A quarter beside the middle of the kerf, all along a side.
  ContourStretch beside = around(1, -0.5, 10.5);
  beside.edges[1].from.x = beside.edges[1].to.x = beside.edges[0].to.x = beside.edges[2].from.x = 10.75;
  EXPECT_EQ(says_with(beside, 0.25), "");
  EXPECT_NE(says_with(beside, 0.249), "");
  // What is within the slack and half of a joint's gap of it may be uncut: here the middle at x = -1.5.
  const ContourStretch short_of{3, way({{1, -10.5},
                                        {10.5, -10.5},
                                        {10.5, 10.5},
                                        {-10.5, 10.5},
                                        {-10.5, -10.5},
                                        {-2, -10.5},
                                        {-2, -12},
                                        {-0.5, -12},
                                        {-0.5, -10.5}})};
  EXPECT_EQ(says_with(short_of, 0.25), "");
  EXPECT_NE(says_with(short_of, 0.249), "");
  // A kerf that is no wider than a line, and a joint that is nothing.
  words.kerf_mm = 0, words.joint_width_mm = 0;
  ContourStretch thin = around(0.005, 0, 10);
  EXPECT_EQ(says_with(thin, 0.25), "");
  thin.edges[0].from.x = 0.0050001;
  EXPECT_NE(says_with(thin, 0.25), "");
}

TEST(VerifyJointCheck, RoundCornersAreAllThatAKerfNeeds) {
  Strokes round{
      line_between({1, -10.5}, {10, -10.5}),    arc_about({10, -10.5}, {10.5, -10}, {10, -10}, true),
      line_between({10.5, -10}, {10.5, 10}),    arc_about({10.5, 10}, {10, 10.5}, {10, 10}, true),
      line_between({10, 10.5}, {-10, 10.5}),    arc_about({-10, 10.5}, {-10.5, 10}, {-10, 10}, true),
      line_between({-10.5, 10}, {-10.5, -10}),  arc_about({-10.5, -10}, {-10, -10.5}, {-10, -10}, true),
      line_between({-10, -10.5}, {-0.5, -10.5})};
  EXPECT_EQ(said({{3, round}}), "");
}

TEST(VerifyJointCheck, WhereNoKerfCanGoNothingIsLookedAt) {
  // A contour with a notch of 0.6 mm, which a kerf of 1 mm passes by.
  const ContourRing notched({way({{-10, -10},
                                  {10, -10},
                                  {10, -0.3},
                                  {6, -0.3},
                                  {6, 0.3},
                                  {10, 0.3},
                                  {10, 10},
                                  {-10, 10},
                                  {-10, -10}})},
                            0.05);
  ProfileWords words;
  words.kerf_mm = kKerf, words.joint_width_mm = kWidth;
  EXPECT_TRUE(
      joints_of_contour({around(1, -0.5, 10.5)}, notched, false, "it", words, kSlack).findings.empty());
}

TEST(VerifyJointCheck, AKerfOrADiscStaysOutOfAJoint) {
  const FoundJoint joint{3, {Place{0, 0}, {2, 0}, {2, 3}, {0, 3}}};
  const auto leaves = [&](Place from, Place to, double radius = 0.5) {
    return leaves_joint(line_between(from, to), radius, joint);
  };
  // Beside each side, within the rounding of words.
  for (const double near : {0.494, 0.496}) {
    const bool free = near > 0.495;
    EXPECT_EQ(leaves({-near, -9}, {-near, 9}), free) << near;
    EXPECT_EQ(leaves({2 + near, -9}, {2 + near, 9}), free) << near;
    EXPECT_EQ(leaves({-9, -near}, {9, -near}), free) << near;
    EXPECT_EQ(leaves({-9, 3 + near}, {9, 3 + near}), free) << near;
    EXPECT_EQ(leaves({-near, 1}, {-near, 1}), free) << "a disc " << near;
    EXPECT_EQ(leaves({-near, 1}, {-9, 1}), free) << "its end " << near;
    EXPECT_EQ(leaves({1, 3 + near}, {1, 99}), free) << near;
    EXPECT_EQ(leaves({1, -near}, {1, -99}), free) << near;
    EXPECT_EQ(leaves({2 + near, 1}, {99, 1}), free) << near;
  }
  EXPECT_TRUE(leaves({-0.5, -9}, {-0.5, 9}, 0.505)) << "just as far as the rounding lets it";
  EXPECT_FALSE(leaves({-9, 1}, {9, 1})) << "across";
  EXPECT_FALSE(leaves({-9, 1}, {9, 1}, 0)) << "across, as thin as a line";
  EXPECT_FALSE(leaves({-9, 1}, {1, 1}, 0)) << "into it";
  EXPECT_FALSE(leaves({1, 1.5}, {9, 1.5}, 0)) << "out of it";
  EXPECT_FALSE(leaves({0.9, 1.5}, {1.1, 1.5}, 1));
  EXPECT_FALSE(leaves({2.2, 3.2}, {2.2, 3.2})) << "a disc at the far corner";
  EXPECT_TRUE(leaves({-40, 1}, {-9, 1}));
  EXPECT_TRUE(leaves({30, 40}, {50, 60}, 20));
  EXPECT_FALSE(leaves({-40, 1}, {-9, 1}, 9.1)) << "a disc that is larger than the joint";
  EXPECT_FALSE(leaves({-60, 1}, {60, 1.5}, 0.5)) << "what begins far away";
}

}  // namespace
}  // namespace lekalo::verify::verify_joint_check_test
