// Distances of sides and outlines where one term of the formulas decides alone.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lekalo/base/random.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/stretch.hpp"

namespace lekalo::verify::verify_distance_test {
namespace {

Shape shape(const std::string& outer) {
  std::string complaint;
  const std::string text = R"({"outer": )" + outer + "}";
  const auto json = parse_json(text, "shape");
  EXPECT_TRUE(json.has_value());
  Shape made = read_shape(*json, "shape", complaint);
  EXPECT_EQ(complaint, "");
  return made;
}
std::string arc(double x0, double y0, double x1, double y1, double cx, double cy, bool ccw = true) {
  return fmt::format(R"({{"arc": {{"from": [{}, {}], "to": [{}, {}], "centre": [{}, {}], "ccw": {}}}}})", x0,
                     y0, x1, y1, cx, cy, ccw);
}
std::string line(double x0, double y0, double x1, double y1) {
  return fmt::format(R"({{"line": {{"from": [{}, {}], "to": [{}, {}]}}}})", x0, y0, x1, y1);
}
std::string circle(double x, double y, double r) { return "[" + arc(x + r, y, x + r, y, x, y) + "]"; }
std::string box(double x0, double y0, double x1, double y1) {
  return "[" + line(x0, y0, x1, y0) + ", " + line(x1, y0, x1, y1) + ", " + line(x1, y1, x0, y1) + ", " +
         line(x0, y1, x0, y0) + "]";
}
/// A quarter of a circle about the origin from angle q / 4 of a turn, with its chord.
Side quarter(int q, double r, double cx = 0) {
  const double x[] = {r, 0, -r, 0}, y[] = {0, r, 0, -r};
  const int n = (q + 1) % 4;
  return shape("[" + arc(cx + x[q], y[q], cx + x[n], y[n], cx, 0) + ", " +
               line(cx + x[n], y[n], cx + x[q], y[q]) + "]")
      .sides[0];
}
Side full(double x, double y, double r) { return shape(circle(x, y, r)).sides[0]; }
Side straight(double x0, double y0, double x1, double y1) {
  return shape("[" + line(x0, y0, x1, y1) + ", " + line(x1, y1, x0, y0) + "]").sides[0];
}
void expect(Span found, double wanted, double width = 5e-14) {
  EXPECT_LE(found.low, wanted);
  EXPECT_GE(found.high, wanted);
  EXPECT_LE(found.high - found.low, width);
}

TEST(VerifyDistance, CirclesInEachOtherAndApart) {
  for (const bool swapped : {false, true}) {
    const auto of = [&](const Side& a, const Side& b) { return swapped ? distance(b, a) : distance(a, b); };
    expect(of(full(0, 3, 5), full(0, 0, 12)), 4);
    expect(of(full(4, 0, 5), full(0, 3, 12)), 2);
    expect(of(full(0, 0, 1), full(3, 4, 2)), 2);
    // The nearest points face away from the ends of both arcs.
    const Side bowl = shape("[" + arc(-4, -3, 4, -3, 0, 0) + ", " + line(4, -3, -4, -3) + "]").sides[0];
    expect(of(bowl, full(0, -2, 1)), 2, 1e-13);
  }
}

TEST(VerifyDistance, ArcsAboutOneCentre) {
  expect(distance(full(0, 0, 5), full(0, 0, 7)), 2);
  expect(distance(quarter(0, 5), quarter(0, 7)), 2);
  // No direction in common: the ends are nearest, and the enclosure is not of the radii's difference.
  expect(distance(quarter(0, 5), quarter(2, 7)), std::hypot(5, 7), 1e-13);
  expect(distance(quarter(0, 5), quarter(2, 5)), std::hypot(5, 5), 1e-13);
  // Centres as near as rounding makes them count as one, and the distance is as much lower.
  const Span near = distance(full(0, 0, 10), full(1e-13, 0, 12));
  EXPECT_LE(near.low, 2 - 1e-13);
  EXPECT_GE(near.high, 2 - 1e-13);
}

TEST(VerifyDistance, ALineThatEntersOrLeavesACircle) {
  for (const double from : {-10.0, 10.0}) {
    EXPECT_EQ(distance(straight(from, 0.3, 0, 0.3), full(0, 0, 5)).low, 0);
    EXPECT_EQ(distance(straight(0, 0.3, from, 0.3), full(0, 0, 5)).low, 0);
    EXPECT_EQ(distance(full(0, 0, 5), straight(0, 0.3, from, 0.3)).low, 0);
  }
  // Through the part of the circle that is not there.
  const Span missed = distance(straight(-10, 0.3, 0, 0.3), quarter(0, 5));
  EXPECT_GT(missed.low, 1);
}

Enclosure clearance(const std::string& part, const std::string& blank, const std::string& hole,
                    double x = 0) {
  const std::string of_part = fmt::format(R"({{"outer": {}}})", part),
                    of_blank = fmt::format(R"({{"outer": {}, "holes": [{}]}})", blank, hole);
  const auto made = verify_clearance({"part", of_part}, {"blank", of_blank}, {x, 0, 0, false});
  EXPECT_TRUE(made.has_value()) << made.error().message;
  return made.value_or(Enclosure{});
}
void expect(Enclosure found, double wanted, double width) {
  expect(Span{found.low, found.high}, wanted, width);
}

TEST(VerifyDistance, AHoleOfTheBlankUnderThePart) {
  // Outlines meet nowhere; the deepest point is the one farthest from the hole's outline.
  expect(clearance(box(0, 0, 10, 10), box(-5, -5, 15, 15), circle(5, 5, 1)), -1, 3e-9);
  // Holes of two sides: half a disc, a lens.
  const std::string half = "[" + arc(3, 5, 7, 5, 5, 5) + ", " + line(7, 5, 3, 5) + "]";
  expect(clearance(box(0, 0, 10, 10), box(-5, -5, 15, 15), half), -1, 3e-9);
  const std::string lens = "[" + arc(5, 1, 5, 9, 2, 5) + ", " + arc(5, 9, 5, 1, 8, 5) + "]";
  expect(clearance(box(0, 0, 10, 10), box(-5, -5, 15, 15), lens), -2, 3e-9);
  // A slot of even width, where the deepest points are a line.
  expect(clearance(box(0, 0, 10, 10), box(-5, -5, 15, 15), box(2, 4, 8, 5)), -0.5, 3e-9);
}

TEST(VerifyDistance, APointOfAnArcDecidesBetweenTwoSides) {
  // What sticks out most is inside an arc of the part, where a corner and an arc of the blank are equally
  // near: found by halving tens of times. Once the enclosures of the halves grew with each, until the arc's
  // centre counted as a point of it and the clearance was -1.398.
  const std::string part = "[" + line(3, -1, 7, -1) + ", " + arc(7, -1, 7, 1, 7, 0, false) + ", " +
                           line(7, 1, 3, 1) + ", " + arc(3, 1, 3, -1, 3, 0, false) + "]";
  const std::string upper = "[" + line(4, 5, 7, 5) + ", " + line(7, 5, 7, 9) + ", " + line(7, 9, 3, 9) +
                            ", " + line(3, 9, 3, 5) + ", " + line(3, 5, 2, 5) + ", " + arc(2, 5, 2, 3, 2, 4) +
                            ", " + line(2, 3, 4, 3) + ", " + arc(4, 3, 4, 5, 4, 4) + "]";
  const std::string lower = "[" + line(5, -1, 9, -1) + ", " + arc(9, -1, 9, 1, 9, 0, false) + ", " +
                            line(9, 1, 5, 1) + ", " + arc(5, 1, 5, -1, 5, 0, false) + "]";
  const auto made = verify_clearance(
      {"part", fmt::format(R"({{"outer": {}}})", part)},
      {"blank", fmt::format(R"({{"pieces": [{{"outer": {}}}, {{"outer": {}}}]}})", upper, lower)},
      {6.952077129028055, 5.3652510632374053, -1.7197086347324939, false});
  ASSERT_TRUE(made.has_value()) << made.error().message;
  expect(*made, -1.2862606717008, 2e-9);
}

TEST(VerifyDistance, HalvesOfArcsStayAsNarrowAsTheArc) {
  Random random(1, 8);
  for (int i = 0; i < 50; ++i) {
    Side side = full(3, -4, 5);
    for (int depth = 0; depth < 45; ++depth) {
      const auto two = halves(side);
      const Vec end = side.sweep == Sweep::full ? side.from : side.to;
      // Each begins where the other ends, on the circle, and the ends stay.
      EXPECT_EQ(two[0].last.x.low, two[1].first.x.low);
      EXPECT_EQ(two[0].first.y.high, side.first.y.high);
      EXPECT_EQ(two[1].last.y.high, side.last.y.high);
      const Span radius = length(two[0].to - side.centre);
      EXPECT_LT(radius.high - radius.low, 1e-13) << depth;
      EXPECT_LE(length(two[1].to - end).low, 0);
      side = two[random.below(2)];
    }
    EXPECT_LT(length(side.to - side.from).high, 1e-10);
  }
}

TEST(VerifyDistance, CutsBesideAPointAndNearAnEndMakeUpTheWhole) {
  for (const bool ccw : {true, false}) {
    const std::string outline = ccw ? "[" + arc(5, 0, 0, 5, 0, 0) + ", " + line(0, 5, 5, 0) + "]"
                                    : "[" + arc(0, 5, 5, 0, 0, 0, false) + ", " + line(5, 0, 0, 5) + "]";
    const Shape made = shape(outline);
    for (const Side& side : made.sides) {
      const Vec begin = side.arc ? side.centre + side.first * side.radius : side.from;
      const Vec end = side.arc ? side.centre + side.last * side.radius : side.to;
      const auto joined = [&](const std::array<Side, 2>& two) {
        EXPECT_LT(length(two[0].from - begin).high, 1e-13);
        EXPECT_LT(length(two[0].to - two[1].from).high, 1e-13);
        EXPECT_LT(length(two[1].to - end).high, 1e-13);
        if (!side.arc) return;
        EXPECT_EQ(two[0].first.x.low, side.first.x.low);
        EXPECT_EQ(two[0].last.x.low, two[1].first.x.low);
        EXPECT_EQ(two[0].last.y.high, two[1].first.y.high);
        EXPECT_EQ(two[1].last.y.low, side.last.y.low);
      };
      // Off the curve, but beside its first third.
      const Vec beside{just(side.arc ? 6 : 3), just(side.arc ? 3 : 1)};
      const auto cut = cut_beside(side, beside);
      ASSERT_TRUE(cut);
      joined(*cut);
      const Vec foot = side.arc ? unit(beside) * just(5) : Vec{just(3.5), just(1.5)};
      EXPECT_LT(length((*cut)[0].to - foot).high, 1e-13);
      for (const double outside : {-1.0, 7.0})
        EXPECT_FALSE(cut_beside(side, {just(outside), just(6 - outside)})) << outside;
      EXPECT_FALSE(cut_beside(side, {just(-6), just(-6)}) && side.arc);
      if (side.arc) {
        EXPECT_FALSE(cut_beside(side, side.centre));
        EXPECT_FALSE(cut_beside(side, begin));
        EXPECT_FALSE(cut_beside(side, end));
      }
      for (const bool first : {true, false}) {
        const auto off = with_end_cut_off(side, first);
        joined(off);
        const Side &shorter = off[first ? 0 : 1], &longer = off[first ? 1 : 0];
        EXPECT_NEAR(length(shorter.to - shorter.from).low / length(end - begin).low, 1.0 / 256, 1e-3);
        EXPECT_GT(length(longer.to - longer.from).low, 0.9 * length(end - begin).low);
      }
    }
  }
}

TEST(VerifyDistance, ADivisorThatMayBeZeroSaysNothing) {
  for (const Span by : {Span{0, 1}, Span{-1e-300, 2}, Span{-2, -1}}) {
    const Span quotient = just(1) / by;
    EXPECT_LT(quotient.low, -1e308);
    EXPECT_GT(quotient.high, 1e308);
  }
}

TEST(VerifyDistance, ADiscInADisc) {
  for (const double x : {0.0, 0.5, 1.25, 2.0}) {
    const Enclosure found = clearance(circle(0, 0, 5), circle(0, 0, 12), circle(0, 11.5, 0.25), x);
    const double wanted = std::min(7 - x, std::hypot(x, 11.5) - 5.25);
    expect(found, wanted, 1e-13);
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_distance_test
