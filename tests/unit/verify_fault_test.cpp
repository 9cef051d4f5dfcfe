// What verify_clearance refuses, each sentence; and parts that touch their blank, where nothing may be lost.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "lekalo/verify/verify.hpp"

namespace lekalo::verify::verify_fault_test {
namespace {

std::string line(const std::string& from, const std::string& to) {
  return fmt::format(R"({{"line": {{"from": [{}], "to": [{}]}}}})", from, to);
}
std::string arc(const std::string& from, const std::string& to, const std::string& centre, bool ccw = true) {
  return fmt::format(R"({{"arc": {{"from": [{}], "to": [{}], "centre": [{}], "ccw": {}}}}})", from, to,
                     centre, ccw);
}
std::string polygon(const std::vector<std::string>& points) {
  std::string text;
  for (std::size_t i = 0; i < points.size(); ++i)
    text += (i == 0 ? "" : ", ") + line(points[i], points[(i + 1) % points.size()]);
  return "[" + text + "]";
}
std::string box(const char* x0, const char* y0, const char* x1, const char* y1) {
  const auto at = [](const char* x, const char* y) { return std::string(x) + ", " + y; };
  return polygon({at(x0, y0), at(x1, y0), at(x1, y1), at(x0, y1)});
}
std::string circle(double x, double y, double r) {
  const std::string from = fmt::format("{}, {}", x + r, y);
  return "[" + arc(from, from, fmt::format("{}, {}", x, y)) + "]";
}
std::string region(const std::string& outer, const std::vector<std::string>& holes = {}) {
  std::string list;
  for (const std::string& hole : holes) list += (list.empty() ? "" : ", ") + hole;
  return fmt::format(R"({{"units": "mm", "outer": {}, "holes": [{}]}})", outer, list);
}
const std::string kBlank = region(box("-50", "-50", "50", "50"));

std::string refusal(const std::string& part, const Placement& at = {}) {
  const auto made = verify_clearance({"part.json", part}, {"blank.json", kBlank}, at);
  return made ? "" : made.error().message;
}

// ---- sentences --------------------------------------------------------------------------------------------

TEST(VerifyFault, EverySentenceOfTheReader) {
  const std::string square = box("0", "0", "1", "1");
  const std::vector<std::pair<std::string, std::string>> table{
      {"{", "part.json"},
      {R"({"units": "cm", "outer": )" + square + "}", "are not mm or inch"},
      {R"({"units": "mm", "pieces": []})", "has no edges"},
      {R"({"units": "mm", "outer": 5})", "is not a list of edges"},
      {region(polygon({"0, 0, 0", "1, 0", "1, 1"})), "is not two numbers"},
      {region(polygon({"0", "1, 0", "1, 1"})), "is not two numbers"},
      {region(polygon({"0, 0", "1, \"a\"", "1, 1"})), "not a decimal number"},
      {region(polygon({"0, 0", "1000000001, 0", "1, 1"})), "farther than 1000000000 mm from the origin"},
      {R"({"units": "inch", "outer": )" + box("0", "0", "40000000", "1") + "}", "farther than"},
      {region(R"([{"line": {"from": [0, 0], "to": [1, 0]}, "arc": {}}])"), "is a line and an arc"},
      {region("[" + line("0, 0", "1, 0") + ", " + line("1.0000000000000003, 0", "0, 0") + "]"),
       "does not begin where the edge before it ends"},
      {region("[" + line("0, 0", "1, 0") + ", " + line("1, 0", "1, 1") + "]"), "is not closed"},
      {region(polygon({"0, 0", "0, 0", "1, 1"})), "has no length"},
      {region(R"([{"arc": {"from": [1, 0], "to": [1, 0], "centre": [0, 0], "ccw": 1}}])"),
       "ccw is neither true nor false"},
      {region("[" + arc("1, 0", "2, 0", "0, 0") + ", " + line("2, 0", "1, 0") + "]"),
       "is an arc that is a full circle or nothing"},
      {region("[" + arc("0, 0", "0, 0", "0, 0") + "]"), "is an arc without a radius"},
  };
  for (const auto& [part, sentence] : table)
    EXPECT_NE(refusal(part).find(sentence), std::string::npos) << refusal(part);
}

TEST(VerifyFault, EverySentenceAboutOutlines) {
  const std::string square = box("0", "0", "10", "10");
  const std::string two = R"({{"units": "mm", "pieces": [{{"outer": {}}}, {{"outer": {}}}]}})";
  const std::vector<std::pair<std::string, std::string>> table{
      {region(polygon({"0, 0", "10, 0", "10, 10", "4, -5", "0, 10"})), "sides 0 and 2 meet"},
      {region(polygon({"0, 0", "10, 0", "4, 0", "4, 8"})), "side 1 runs back along side 0"},
      // Round the end of the list.
      {region(polygon({"10, 0", "4, 0", "4, 8", "0, 0"})), "side 0 runs back along side 3"},
      // Neighbours that meet again where they should not.
      {region("[" + arc("5, 0", "0, 5", "0, 0", false) + ", " + line("0, 5", "3, -9") + ", " +
              line("3, -9", "5, 0") + "]"),
       "sides 0 and 1 cross"},
      {region(square, {box("20", "0", "21", "1")}), "hole 0 of piece 0 is not inside it"},
      {region(square, {box("1", "1", "9", "9"), box("2", "2", "3", "3")}),
       "hole 1 of piece 0 lies in its hole 0"},
      {region(square, {box("5", "5", "10", "6")}), "meet, or cannot be told from it"},
      {region(square, {circle(8, 5, 2)}), "meet, or cannot be told from it"},
      {fmt::format(fmt::runtime(two), square, box("2", "2", "3", "3")), "lies in the material of piece 0"},
      {fmt::format(fmt::runtime(two), box("2", "2", "3", "3"), square), "lies in the material of piece 1"},
      {fmt::format(fmt::runtime(two), square, box("9", "9", "12", "12")), "meet, or cannot be told from it"},
      {fmt::format(fmt::runtime(two), square, square), "meet, or cannot be told from it"},
  };
  for (const auto& [part, sentence] : table)
    EXPECT_NE(refusal(part).find(sentence), std::string::npos) << sentence << "\n"
                                                               << refusal(part) << "\n"
                                                               << part;
  // In order: a piece in the hole of another, neighbours at a smooth joint, a hole close to its outline.
  EXPECT_EQ(refusal(fmt::format(R"({{"pieces": [{{"outer": {}, "holes": [{}]}}, {{"outer": {}}}]}})", square,
                                box("1", "1", "9", "9"), box("2", "2", "3", "3"))),
            "");
  EXPECT_EQ(refusal(region(square, {box("1e-9", "1", "9", "9")})), "");
  EXPECT_EQ(refusal(region("[" + line("0, -5", "10, -5") + ", " + arc("10, -5", "10, 5", "10, 0") + ", " +
                           line("10, 5", "0, 5") + ", " + arc("0, 5", "0, -5", "0, 0") + "]")),
            "");
}

TEST(VerifyFault, AnArcAndItsChordInFewDigitsAreInOrder) {
  EXPECT_EQ(refusal(region("[" + arc("3, -4", "3, 4.0000001", "0, 0") + ", " + line("3, 4.0000001", "3, -4") +
                           "]")),
            "");
  EXPECT_EQ(refusal(region("[" + line("3, 4.0000001", "3, -4") + ", " + arc("3, -4", "3, 4.0000001", "0, 0") +
                           "]")),
            "");
  EXPECT_EQ(refusal(region("[" + arc("3, -4", "3, 4.0009", "0, 0") + ", " +
                           arc("3, 4.0009", "3, -4", "6, 0.0001") + "]")),
            "");
}

TEST(VerifyFault, ACornerOnAnArcOfThreeSides) {
  // A half circle whose third corner, (3, 4), lies on the arc.
  const auto half = [](const char* corner) {
    return "[" + arc("5, 0", "-5, 0", "0, 0") + ", " + line("-5, 0", corner) + ", " + line(corner, "5, 0") +
           "]";
  };
  EXPECT_NE(refusal(region(half("3, 4"))).find("sides 0 and 1 meet"), std::string::npos)
      << refusal(region(half("3, 4")));
  EXPECT_EQ(refusal(region(half("3, 3"))), "");
  const auto arc_last = [](const char* corner) {
    return "[" + line("-5, 0", corner) + ", " + line(corner, "5, 0") + ", " + arc("5, 0", "-5, 0", "0, 0") +
           "]";
  };
  EXPECT_NE(refusal(region(arc_last("3, 4"))).find("meet, or cannot"), std::string::npos);
  EXPECT_EQ(refusal(region(arc_last("3, 3"))), "");
}

TEST(VerifyFault, PlacementsBeyondAllBoundsAreRefused) {
  const double infinity = std::numeric_limits<double>::infinity(),
               nan = std::numeric_limits<double>::quiet_NaN();
  const std::string square = region(box("0", "0", "1", "1"));
  for (const double wild : {infinity, -infinity, nan, 1.1e12, -1.1e12}) {
    EXPECT_NE(refusal(square, {wild, 0, 0, false}), "");
    EXPECT_NE(refusal(square, {0, wild, 0, false}), "");
    EXPECT_NE(refusal(square, {0, 0, wild, false}), "");
  }
  EXPECT_EQ(refusal(square, {30, 1e9, 1e9, true}), "");
}

TEST(VerifyFault, AnArcHasTheMeanRadiusOfItsEnds) {
  const std::string blank =
      region("[" + arc("0, -5", "0, 5.001", "0, 0") + ", " + line("0, 5.001", "0, -5") + "]");
  const auto made = verify_clearance(
      {"part.json", region(polygon({"3, 0.1", "3, -0.1", "4, -0.1", "4, 0.1"}))}, {"blank.json", blank}, {});
  ASSERT_TRUE(made.has_value()) << made.error().message;
  EXPECT_NEAR(made->low, 5.0005 - std::hypot(4, 0.1), 1e-12);
  EXPECT_NEAR(made->high, made->low, 1e-12);
}

// ---- touching ---------------------------------------------------------------------------------------------

Enclosure clearance(const std::string& part, const std::string& blank, double x = 0, double y = 0,
                    bool mirrored = false, double theta = 0) {
  const auto made = verify_clearance({"part.json", part}, {"blank.json", blank}, {x, y, theta, mirrored});
  EXPECT_TRUE(made.has_value()) << made.error().message;
  return made.value_or(Enclosure{-1e9, -1e9});
}
void expect_touches(const std::string& part, const std::string& blank, double x = 0, double y = 0,
                    bool mirrored = false) {
  const Enclosure found = clearance(part, blank, x, y, mirrored);
  EXPECT_EQ(found.low, 0) << part << "\n" << blank;
  EXPECT_EQ(found.high, 0);
}
/// Not inside: nobody may say 0.
void expect_less(const std::string& part, const std::string& blank, double x = 0, double y = 0,
                 bool mirrored = false) {
  EXPECT_LT(clearance(part, blank, x, y, mirrored).low, 0) << part << "\n" << blank;
}

const std::string kTenth = region(box("0.1", "0.1", "0.7", "0.3"));

TEST(Touching, APartInABlankOfItsOwnShape) {
  expect_touches(kTenth, kTenth);
  expect_touches(region(circle(0.1, 0.2, 3)), region(circle(0.1, 0.2, 3)));
  const std::string slotted =
      region(box("0", "0", "10", "10"), {circle(3, 3, 1), box("5", "5", "7.3", "8.1")});
  expect_touches(slotted, slotted);
  // Mirrored, moved there and back.
  const std::string triangle = region(polygon({"0, 0", "3, 0.1", "1, 2"})),
                    mirrored = region(polygon({"4, 0.5", "1, 0.6", "3, 2.5"}));
  expect_touches(triangle, mirrored, 4, 0.5, true);
  expect_less(triangle, mirrored, 4, 0.5, false);
}

TEST(Touching, ByASideACornerATangent) {
  const std::string blank = region(box("0", "0", "1", "1"));
  expect_touches(kTenth, region(box("0.1", "0", "1", "1")));
  expect_touches(region(polygon({"0, 0.5", "0.5, 0.25", "0.5, 0.75"})), blank);  // a corner on a side
  expect_touches(region(polygon({"0, 0", "0.5, 0.25", "0.25, 0.5"})), blank);    // a corner in a corner
  expect_touches(region(circle(0.5, 0.5, 0.5)), blank);                          // four tangents
  expect_touches(region(circle(1, 0, 1)), region(circle(0, 0, 2)));              // a circle in a circle
  expect_touches(region(box("-3", "-4", "3", "4")), region(circle(0, 0, 5)));    // corners on a circle
  expect_touches(region(box("0", "0", "4", "4"), {box("1", "1", "3", "3")}),
                 region(box("-1", "-1", "5", "5"), {circle(2, 2, 1)}));  // a core in a hole
  // A reflex corner of the blank on a side of the part.
  expect_touches(region(box("0", "0", "4", "2")),
                 region(polygon({"-1, -1", "9, -1", "9, 9", "6, 9", "2, 2", "1, 9", "-1, 9"})));
}

TEST(Touching, TheFiftiethDigitDecides) {
  const std::string blank = region(box("0", "0", "1", "1"));
  const std::string tiny = "00000000000000000000000000000000000000000000001";
  expect_touches(region(box("0", "0.2", "0.5", "0.5")), blank);
  expect_less(region(box(("-0." + tiny).c_str(), "0.2", "0.5", "0.5")), blank);
  // A line that would be tangent, and cuts the circle by as little.
  const auto cut = [](const std::string& y) {
    return region("[" + line("-1, " + y, "9, " + y) + ", " + line("9, " + y, "4, -9") + ", " +
                  line("4, -9", "-1, " + y) + "]");
  };
  const std::string disc_and_more =
      region(polygon({"-2, -10", "10, -10", "10, 11", "-2, 11"}), {circle(4, 5, 5)});
  expect_touches(cut("0"), disc_and_more);
  expect_less(cut("0." + tiny), disc_and_more);
}

TEST(Touching, WhatTouchesFromOutsideOrCrossesIsNotInside) {
  const std::string blank = region(box("0", "0", "1", "1"));
  expect_less(region(box("1", "0", "2", "1")), blank);  // side by side
  expect_less(region(circle(1.5, 0.5, 0.5)), blank);    // tangent from outside
  expect_less(region(circle(3, 0, 1)), region(circle(0, 0, 2)));
  expect_less(blank, region(box("0", "0", "1", "0.5")));  // the part is the larger
  expect_less(region(box("0", "0", "4", "4")), region(box("0", "0", "4", "4"), {box("1", "1", "3", "3")}));
  // The part is what fills the hole of the blank: its outline is all on the blank's.
  expect_less(region(box("1", "1", "3", "3")), region(box("0", "0", "4", "4"), {box("1", "1", "3", "3")}));
  expect_less(region(circle(2, 2, 1)), region(box("0", "0", "4", "4"), {circle(2, 2, 1)}));
  // Corners in corners, sides across.
  expect_less(region(polygon({"0, 0", "1, 1", "-1, 1"})), blank);
  expect_less(region(polygon({"0.5, 0", "1.5, 0.5", "0.5, 1"})), blank);
  // A corner on the circle, the sides beyond it.
  expect_less(region(polygon({"3, 4", "9, 0", "-3, 0"})), region(circle(0, 0, 5)));
  // Half circles on one circle, one turned away.
  const std::string right = region("[" + arc("0, -5", "0, 5", "0, 0") + ", " + line("0, 5", "0, -5") + "]"),
                    left = region("[" + arc("0, 5", "0, -5", "0, 0") + ", " + line("0, -5", "0, 5") + "]");
  expect_touches(right, right);
  expect_less(right, left);
  expect_touches(right, region(circle(0, 0, 5)));
  expect_less(region(circle(0, 0, 5)), right);
  // A slit runs into the part between the middles of all sides.
  expect_less(region(box("0", "0", "9", "5")),
              region(polygon({"0, 0", "10, 0", "10, 10", "1.2, 10", "1.1, 4", "1, 10", "0, 10"})));
  // Two pieces, one inside and one outside.
  expect_less(fmt::format(R"({{"pieces": [{{"outer": {}}}, {{"outer": {}}}]}})", box("0", "0", "0.2", "0.2"),
                          box("1", "0.5", "1.5", "0.8")),
              blank);
}

TEST(Touching, WhereFractionsDoNotHelpNothingIsClaimed) {
  // Turned by an angle nothing is rational.
  EXPECT_LT(clearance(kTenth, kTenth, 0, 0, false, 1e-300).low, 0);
  // An arc that touches and whose ends lie on two circles.
  const std::string odd =
      region("[" + arc("0, -5", "0, 5.0000001", "0, 0") + ", " + line("0, 5.0000001", "0, -5") + "]");
  EXPECT_LE(clearance(odd, odd).low, 0);
  EXPECT_GE(clearance(odd, odd).low, -1e-6);
  // Its mean circle reaches 4e-8 beyond the tangent of the one its first end lies on.
  expect_less(region("[" + arc("3, -4", "3, 4.0000001", "0, 0") + ", " + line("3, 4.0000001", "3, -4") + "]"),
              region(box("-9", "-9", "5", "9")));
  // One that touches nothing does no harm.
  expect_touches(region(box("-9", "-9", "9", "9"), {"[" + arc("1, 0", "-1.0000001, 0", "0, 0") + ", " +
                                                    line("-1.0000001, 0", "1, 0") + "]"}),
                 region(box("-9", "-9", "9", "9")));
}

TEST(Touching, ArcsThatCrossOrTouchInsideBoth) {
  // Plates bounded by an arc of a circle about (0, 0) and by lines left of it; by an arc of less than half a
  // turn, of half, and of more. Where the other's arc or line passes through is asked in every part of them.
  const auto cap = [](const char* from, const char* to, const std::vector<const char*>& corners) {
    std::string text = arc(from, to, "0, 0");
    const char* last = to;
    for (const char* corner : corners) text += ", " + line(last, corner), last = corner;
    return region("[" + text + ", " + line(last, from) + "]");
  };
  const std::string less = cap("3, -4", "3, 4", {"-9, 4", "-9, -4"}),
                    half = cap("0, -5", "0, 5", {"-9, 5", "-9, -5"}),
                    more = cap("-3, -4", "-3, 4", {"-9, 4", "-9, -4"});
  for (const std::string& blank : {less, half, more}) {
    expect_touches(blank, blank);
    expect_touches(region(box("-8", "-3", "4", "3")), blank);  // corners on the arc
    expect_less(region(box("-8", "-3", "4.5", "3")), blank);   // lines across the arc
    expect_less(region(box("-8", "-0.1", "5.1", "0.1")), blank);
    expect_touches(region(polygon({"-8, 0", "4, -3", "5, 0", "4, 3"})), blank);
    expect_touches(region(circle(2, 0, 3)), blank);  // a circle touches the arc
    expect_less(region(circle(3, 0, 3)), blank);     // and one crosses it
    expect_less(region("[" + arc("4, -1", "4, 1", "4, 0", false) + ", " + line("4, 1", "9, 1") + ", " +
                       line("9, 1", "9, -1") + ", " + line("9, -1", "4, -1") + "]"),
                blank);
  }
  // The part's own arcs, of each turn, about another centre, in a circle that holds and one that does not.
  for (const std::string& part : {less, half, more}) {
    expect_touches(part, region(box("-9", "-9", "9", "9")));
    expect_touches(part, region(box("-10", "-10", "5", "9")));  // tangent at (5, 0)
    expect_less(part, region(box("-10", "-10", "4.5", "9")));
    expect_less(
        part,
        region(polygon({"-10, -10", "9, -10", "9, -1", "4.9, -1", "4.9, 1", "9, 1", "9, 9", "-10, 9"})));
  }
  // Arcs of more than half a turn reach around: a line across each of their ends' sides.
  expect_less(more,
              region(polygon({"-10, -9", "9, -9", "9, 9", "0, 9", "0, 4.5", "-1, 4.5", "-1, 9", "-10, 9"})));
  expect_less(
      more,
      region(polygon({"-10, -9", "-1, -9", "-1, -4.5", "0, -4.5", "0, -9", "9, -9", "9, 9", "-10, 9"})));
}

TEST(Touching, CarriersThatMeetBesideTheSidesDoNoHarm) {
  const std::string blank = region(box("0", "0", "10", "10"));
  // The part touches below; its other sides' lines and circles meet the blank's beyond their ends.
  expect_touches(region(polygon({"4, 0", "6, 3", "5, 6"})), blank);
  expect_touches(region("[" + arc("3, 1", "3, 5", "3, 3") + ", " + line("3, 5", "2, 0") + ", " +
                        line("2, 0", "3, 1") + "]"),
                 blank);
  // A circle about (5, 5) tangent to the blank's lower side where the side is not: a notch.
  expect_touches(region("[" + arc("5, 0", "5, 10", "5, 5") + ", " + line("5, 10", "5, 0") + "]"), blank);
  expect_touches(region(circle(5, 5, 5)),
                 region(polygon({"0, 0", "4, 0", "4, -1", "6, -1", "6, 0", "10, 0", "10, 10", "0, 10"})));
  // Lines on one line that have nothing in common, and parallel ones.
  expect_touches(region(polygon({"1, 0", "2, 0", "2, 1", "1, 1"})),
                 region(polygon({"0, 0", "3, 0", "3, -1", "5, -1", "5, 0", "8, 0", "8, 8", "0, 8"})));
  // Circles about one centre.
  expect_touches(region(circle(0, 0, 2), {circle(0, 0, 1)}), region(circle(0, 0, 2)));
  expect_touches(region(circle(0, 0, 2), {circle(0, 0, 1)}), region(circle(0, 0, 2), {circle(0, 0, 0.5)}));
  expect_less(region(circle(0, 0, 2)), region(circle(0, 0, 2), {circle(0, 0, 1)}));
}

TEST(Touching, AnArcThatEndsOnALineThatItsCircleCrossesAgain) {
  // The circle about (0, 3) crosses the blank's lower side in (4, 0), where arcs begin, and in (-4, 0).
  const std::string blank = region(box("-9", "0", "9", "9"));
  expect_touches(region("[" + arc("4, 0", "5, 3", "0, 3") + ", " + line("5, 3", "4, 5") + ", " +
                        line("4, 5", "4, 0") + "]"),
                 blank);
  expect_touches(region("[" + arc("4, 0", "-4.8, 1.6", "0, 3") + ", " + line("-4.8, 1.6", "4, 0") + "]"),
                 blank);
  expect_touches(region("[" + arc("4, 0", "-4, 6", "0, 3") + ", " + line("-4, 6", "4, 0") + "]"), blank);
}

TEST(Touching, ManyPlacesOnOneSide) {
  // Teeth that touch the upper side of the blank, written in any order, and one that sticks out.
  std::vector<std::string> corners{"0, 5", "20, 5"};
  for (int x = 19; x > 0; x -= 2) {
    corners.push_back(fmt::format("{}, 10", x));
    corners.push_back(fmt::format("{}, 6", x - 1));
  }
  const std::string comb = region(polygon(corners));
  expect_touches(comb, region(box("-1", "0", "21", "10")));
  expect_touches(comb, region(polygon({"21, 10", "-1, 10", "-1, 0", "21, 0"})));
  expect_less(comb, region(polygon({"-1, 0", "21, 0", "21, 10", "12, 10", "11, 9", "10, 10", "-1, 10"})));
  // Corners all round a circle: each stretch between them is asked.
  const std::vector<std::string> on{"5, 0",  "4, 3",   "3, 4",   "0, 5",  "-3, 4", "-4, 3",
                                    "-5, 0", "-4, -3", "-3, -4", "0, -5", "3, -4", "4, -3"};
  expect_touches(region(polygon(on)), region(circle(0, 0, 5)));
  expect_touches(region(circle(0, 0, 5)), region(box("-9", "-9", "9", "5")));
  // The blank's hole is the polygon, and the part fills all but a disc: the circle's stretches lie outside
  // it.
  expect_touches(region(box("-9", "-9", "9", "9"), {circle(0, 0, 5)}),
                 region(box("-9", "-9", "9", "9"), {polygon(on)}));
  expect_less(region(box("-9", "-9", "9", "9"), {polygon(on)}),
              region(box("-9", "-9", "9", "9"), {circle(0, 0, 5)}));
}

TEST(Touching, AnOwnOutlineMovedOrMirroredIsAnother) {
  const std::string triangle = region(polygon({"0, 0", "3, 0.25", "1, 2"}));
  expect_touches(triangle, triangle);
  expect_less(triangle, triangle, 1, 0);
  expect_less(triangle, triangle, 0, 1);
  expect_less(triangle, triangle, 0, 0, true);
  const std::string with_arc =
                        region("[" + arc("0, -5", "0, 5", "0, 0") + ", " + line("0, 5", "0, -5") + "]"),
                    reversed = region("[" + line("0, -5", "0, 5") + ", " +
                                      arc("0, 5", "0, -5", "0, 0", false) + "]");
  expect_touches(with_arc, reversed);
  expect_less(with_arc, with_arc, 0, 0, true);
}

TEST(Touching, ASpikeThatOnlyItsTipTellsOf) {
  // The middles of all its sides lie in the blank. Beside the tip at the top the blank's arc is beyond one of
  // its ends' directions and before the other.
  const std::string more = region("[" + arc("-3, -4", "-3, 4", "0, 0") + ", " + line("-3, 4", "-9, 4") +
                                  ", " + line("-9, 4", "-9, -4") + ", " + line("-9, -4", "-3, -4") + "]");
  expect_less(region(polygon({"0, 5.1", "-1, 0", "1, 0"})), more);
  expect_less(region(polygon({"0, -5.1", "1, 0", "-1, 0"})), more);
  expect_touches(region(polygon({"0, 5", "-1, 0", "1, 0"})), more);
  // Of both places where the carriers meet, only the first is on both sides, or only the second: the way out
  // is a line, and the way back an arc.
  const std::string disc = region(circle(0, 0, 5));
  expect_less(region("[" + line("-1, 0", "0, 5.12") + ", " + arc("0, 5.12", "2.56, 0", "-3.84, 0", false) +
                     ", " + line("2.56, 0", "-1, 0") + "]"),
              disc);
  expect_less(region("[" + arc("-2.56, 0", "0, 5.12", "3.84, 0", false) + ", " + line("0, 5.12", "1, 0") +
                     ", " + line("1, 0", "-2.56, 0") + "]"),
              disc);
}

TEST(Touching, CirclesOfOneRadiusOrOneCentreAreNotOneCircle) {
  expect_less(region(circle(0, 0, 5)), region(circle(-0.5, 0, 5)));
  // The farthest points of both from their ends lie well, and centres are 1 apart.
  expect_less(region(circle(0, 0, 3)), region(circle(-1, 0, 3.5)));
  // Two about one centre that are nearer to each other than enclosures tell: nothing is claimed.
  const auto ring = [](const std::string& x) { return "[" + arc(x + ", 0", x + ", 0", "0, 0") + "]"; };
  const std::string two = ring("2"), more = ring("2.00000000000000000000000000001");
  EXPECT_LE(clearance(region(two), region(more)).low, 0);
  expect_less(region(more), region(two));
}

TEST(Touching, LinesThatAreParallelOrMeetInAnEndAreNotOneLine) {
  // A hole under the part, whose sides' middles lie in the boxes of the part's sides and beside these.
  const std::string diamond = region(polygon({"10, 0", "0, 10", "-10, 0", "0, -10"}));
  const auto blank = [](const std::vector<std::string>& hole) {
    return region(box("-10", "-10", "10", "10"), {polygon(hole)});
  };
  expect_less(diamond, blank({"5, 0", "0, 5", "-5, 0", "0, -5"}));
  // Each side of the hole runs towards a corner of the part.
  expect_less(diamond, blank({"4, 2", "-2, 4", "-4, -2", "2, -4"}));
}

TEST(Touching, AnEndOnTheCircleBesideTheArcDoesNotCutIt) {
  const std::string blank = region("[" + arc("0, -5", "0, 5", "0, 0") + ", " + line("0, 5", "-9, 5") + ", " +
                                   line("-9, 5", "-9, -5") + ", " + line("-9, -5", "0, -5") + "]");
  expect_touches(region(polygon({"3, 4", "0, 4.9", "-3, 4.9", "-3, 4"})), blank);
}

TEST(Touching, AnArcOfTheBlankWhoseEndsLieOnTwoCirclesClaimsNothing) {
  expect_less(region(circle(3, 0, 2)),
              region("[" + arc("3, -4", "3, 3.9999999", "0, 0") + ", " + line("3, 3.9999999", "-9, 4") +
                     ", " + line("-9, 4", "-9, -4") + ", " + line("-9, -4", "3, -4") + "]"));
}

TEST(Touching, ThePointsBesideASharedArcAreWithinWhatIsThin) {
  // Thinner than a quarter of its radius: what fills a hole is not in the blank.
  const std::string lens = "[" + arc("5, 0", "-5, 0", "0, -12") + ", " + arc("-5, 0", "5, 0", "0, 12") + "]";
  expect_less(region(lens), region(box("-9", "-9", "9", "9"), {lens}));
  expect_touches(region(lens),
                 region("[" + arc("6, 0", "-4, 0", "1, -12") + ", " + arc("-4, 0", "6, 0", "1, 12") + "]"), 1,
                 0);
  expect_touches(region(circle(0, 0, 3)), region(circle(1, 0, 3)), 1, 0);
}

TEST(Touching, WhatCannotBeToldEnclosesTheTruth) {
  // 1e-18 from the blank's side, turned by next to nothing.
  const Enclosure found =
      clearance(region(box("1", "2", "3", "4")), region(box("1", "0", "10", "10")), 1e-18, 0, false, 1e-200);
  EXPECT_LE(found.low, 1e-18);
  EXPECT_GE(found.high, 1e-18);
  EXPECT_EQ(refusal(region(box("0", "0", "1", "1")), {1e12, 0, 0, false}), "");
  EXPECT_EQ(refusal(region(box("0", "0", "1", "1")), {0, -1e12, 0, false}), "");
  EXPECT_EQ(refusal(region(box("0", "0", "1", "1")), {0, 0, 1e12, false}), "");
}

}  // namespace
}  // namespace lekalo::verify::verify_fault_test
