// Distances of sides and outlines where one term of the formulas decides alone.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/sticking_out.hpp"
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
        EXPECT_NEAR(length(shorter.to - shorter.from).low / length(end - begin).low, 1.0 / 16, 0.01);
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

// ---- at the very bound: sides made by hand, whose enclosures touch ----------------------------------------

constexpr double kLeast = std::numeric_limits<double>::denorm_min();

TEST(VerifyDistance, ADirectionAlongTheEndOfAnArc) {
  const Side upper = quarter(0, 5);
  Side arc = upper;
  arc.first = {just(1), just(0)}, arc.last = {just(0), just(1)};
  bool met = false, left = false;
  for (int k = -20; k <= 20; ++k) {
    const Vec direction{just(1), just(k * kLeast)};
    const Span turn = cross(arc.first, direction);
    met = met || turn.low == 0, left = left || turn.high == 0;
    EXPECT_EQ(surely_faces(arc, direction), turn.low >= 0) << k;
    EXPECT_EQ(may_face(arc, direction), turn.high >= 0) << k;
  }
  EXPECT_TRUE(met && left);
}

TEST(VerifyDistance, AnEndWithoutBlurIsAsFarAsItIs) {
  const Side side = straight(0, 0, 4, 0);
  const Vec p{just(-3), just(4)};
  EXPECT_EQ(distance(p, side).low, length(side.from - p).low);
  EXPECT_EQ(distance(p, side).high, length(side.from - p).high);
  Side blurred = quarter(0, 5);
  blurred.off = 0.25;
  EXPECT_NEAR(distance({just(8), just(-4)}, blurred).low, 4.75, 1e-12);
  blurred.off = 100;
  EXPECT_EQ(distance({just(8), just(-4)}, blurred).low, 0);
}

TEST(VerifyDistance, CircleAndLineThatMayTouch) {
  Side circle = full(0, 0, 5);
  const Side line = straight(-20, 5, 20, 5);
  // The line's distance from the centre, as it is enclosed.
  const Vec along = line.to - line.from;
  const Span height = absolute(cross(along, circle.centre - line.from) / length(along));
  circle.radius = {4, height.low};
  EXPECT_LT(distance(line, circle).high, 1.01) << "outside, or tangent";
  circle.radius = {4, step_up(height.low)};
  EXPECT_EQ(distance(line, circle).low, 0);
  EXPECT_GT(distance(line, circle).high, 1.01);
  circle.radius = {height.high, 6};
  EXPECT_GT(distance(line, circle).high, 0) << "not surely across";
  circle.radius = {step_up(height.high), 6};
  EXPECT_EQ(distance(line, circle).high, 0);
  expect(distance(straight(-20, 3, 20, 3), full(0, 0, 5)), 0, 0);
}

TEST(VerifyDistance, CirclesThatMayTouch) {
  // The ends are on the far sides.
  Side a = full(0, 0, 1);
  a.from = a.to = {just(-1), just(0)};
  Side b = full(2, 0, 1);
  const double parts = (a.radius + b.radius).high;
  bool met = false;
  for (double x = 2; x < 2 + 1e-14; x = step_up(x)) {
    b.centre = {just(x), just(0)}, b.from = b.to = {just(x + 1), just(0)};
    const double apart = length(b.centre - a.centre).low;
    met = met || apart == parts;
    EXPECT_EQ(distance(a, b).high < 0.5, apart >= parts) << x;
  }
  EXPECT_TRUE(met);
}

TEST(VerifyDistance, CentresThatCountAsOne) {
  const Side a = full(0, 0, 1);
  Side b = full(0, 0, 1024);
  bool met = false;
  const auto lowered = [&](double x) {
    b.centre = {just(x), just(0)};
    const Span apart = length(b.centre - a.centre);
    met = met || apart.low == 1e-13 * a.radius.high;
    return apart;
  };
  // The smaller radius counts. Centres in one put the distance two of theirs lower, others one.
  for (double x = 1e-13; x < 1.00000000000001e-13; x = step_up(x)) (void)lowered(x);
  EXPECT_TRUE(met);
  b = full(0, 0, 1.5);
  for (double x = 1e-13; x < 1.00000000000001e-13; x = step_up(x)) {
    const Span apart = lowered(x);
    const bool one = !(apart.low > 1e-13 * a.radius.high);
    EXPECT_EQ(distance(a, b).low < 0.5 - 1.5e-13, one) << x;
  }
  b = full(1e-11, 0, 8);
  EXPECT_GT(distance(full(0, 0, 0.25), b).low, 7.75 - 1.2e-11);
  expect(distance(full(0, 0, 5), full(0, 0, 5.5)), 0.5, 1e-13);
}

TEST(VerifyDistance, LinesOfNextToNoLengthAreNotDecidedByUnderflow) {
  const auto by_hand = [](double x0, double y0, double x1, double y1) {
    return side_between({just(x0), just(y0)}, {just(x1), just(y1)});
  };
  int undecided = 0;
  for (int k = 1; k < 40; ++k) {
    const double s = k * 1e-82;
    const Side across = by_hand(-s, 0, s, 0), up = by_hand(0, -s, 0, s), over = by_hand(-s, s / 2, s, s / 2);
    const Span turn = cross(across.to - across.from, up.from - across.from),
               other = cross(across.to - across.from, up.to - across.from), product = turn * other;
    undecided += product.high == 0 ? 1 : 0;
    EXPECT_EQ(distance(across, up).high == 0, product.high < 0) << k;
    const Span beside = cross(across.to - across.from, over.from - across.from);
    if (!((beside * beside).low > 0)) {
      EXPECT_EQ(distance(across, over).low, 0) << k;
    }
    if ((beside * beside).low > 0) {
      EXPECT_GT(distance(across, over).low, 0) << k;
    }
  }
  EXPECT_GT(undecided, 0);
}

TEST(VerifyDistance, CarriersApart) {
  const auto circles = [](const Side& a, const Side& b) {
    EXPECT_EQ(carriers_apart(a, b), carriers_apart(b, a));
    return carriers_apart(a, b);
  };
  EXPECT_TRUE(circles(full(0, 0, 5), full(1, 0, 2)));
  EXPECT_TRUE(circles(full(0, 0, 5), full(9, 0, 2)));
  EXPECT_FALSE(circles(full(0, 0, 5), full(6, 0, 2)));
  EXPECT_FALSE(circles(full(0, 0, 5), full(3, 0, 2)));
  EXPECT_FALSE(circles(full(0, 0, 5), full(0, 0, 5)));
  Side a = full(0, 0, 5), b = full(9, 0, 2);
  b.off = 2.5;
  EXPECT_FALSE(circles(a, b));
  // At the bound.
  a.off = b.off = 0;
  bool met_within = false, met_beside = false;
  for (double r = 1; r < 1 + 1e-15; r = step_up(r))
    for (double x = 0.5; x < 0.5 + 2e-15; x = step_up(x)) {
      a.radius = just(r), b.radius = just(0.5), b.centre = a.centre + Vec{just(x), just(0)};
      const Span none = just(0.0) + just(0.0), apart = length(b.centre - a.centre);
      const double within = (absolute(a.radius - b.radius) - none).low;
      met_within = met_within || within == apart.high;
      EXPECT_EQ(circles(a, b), within > apart.high) << r << ' ' << x;
      b.centre = a.centre + Vec{just(x + 1), just(0)};
      const double reach = (a.radius + b.radius + none).high, beside = length(b.centre - a.centre).low;
      met_beside = met_beside || beside == reach;
      EXPECT_EQ(circles(a, b), beside > reach) << r << ' ' << x;
    }
  EXPECT_TRUE(met_within && met_beside);
  // A line beside a circle.
  EXPECT_TRUE(circles(full(0, 0, 5), straight(-9, 6, 9, 6)));
  EXPECT_FALSE(circles(full(0, 0, 5), straight(-9, 4, 9, 4)));
  EXPECT_FALSE(circles(full(0, 0, 5), straight(-9, 5, 9, 5)));
  bool met_tangent = false;
  for (double r = 5; r < 5 + 2e-14; r = step_up(r))
    for (double y = 5; y < 5 + 2e-14; y = step_up(y)) {
      a.radius = just(r), a.centre = {just(0), just(0)};
      const Side line = side_between({just(-9), just(y)}, {just(9), just(y)});
      const Vec along = line.to - line.from;
      const double height = squared(cross(along, a.centre - line.from)).low,
                   reach = ((squared(along.x) + squared(along.y)) * squared(a.radius + just(0.0))).high;
      met_tangent = met_tangent || height == reach;
      EXPECT_EQ(circles(a, line), height > reach) << r << ' ' << y;
    }
  EXPECT_TRUE(met_tangent);
  EXPECT_TRUE(circles(straight(1, 1, 1, 3), straight(0, 0, 4, 0)));
  // Lines: either may have the other on one side.
  EXPECT_TRUE(circles(straight(0, 0, 4, 0), straight(1, 1, 1, 3)));
  EXPECT_TRUE(circles(straight(0, 0, 4, 0), straight(1, -1, 1, -3)));
  EXPECT_FALSE(circles(straight(0, 0, 4, 0), straight(1, -1, 1, 3)));
  EXPECT_FALSE(circles(straight(0, 0, 4, 0), straight(2, 0, 6, 0)));
}

TEST(VerifyDistance, LinesWhoseEndsMayLieOnTheOthersLine) {
  bool met_low = false, met_high = false;
  const Side flat = side_between({just(0), just(0)}, {just(1), just(0)});
  for (const bool swapped : {false, true})
    for (int k = -20; k <= 20; ++k) {
      const Vec near{just(0.5), just(k * kLeast)}, far{just(0.5), just(k < 0 ? -1 : 1)};
      const Side up = swapped ? side_between(far, near) : side_between(near, far);
      const Span turn = cross(flat.to - flat.from, near - flat.from);
      met_low = met_low || turn.low == 0, met_high = met_high || turn.high == 0;
      EXPECT_EQ(carriers_apart(flat, up), turn.low > 0 || turn.high < 0) << k;
    }
  EXPECT_TRUE(met_low && met_high);
}

TEST(VerifyDistance, PointsOfASideAreOnIt) {
  const std::vector<Side> sides{straight(1, 2, 5, 7), full(2, -1, 5), quarter(0, 5),
                                quarter(1, 5),        quarter(2, 5),  quarter(3, 5)};
  for (const Side& side : sides) {
    const std::vector<Vec> points = points_of(side);
    EXPECT_GT(points.size(), 1U);
    for (const Vec& p : points) EXPECT_LT(distance(p, side).high, 1e-13);
  }
}

TEST(VerifyDistance, TheNearestSideOfAnOutlineCounts) {
  const Shape outline = shape(box(0, 0, 8, 4));
  for (const auto& [x, y, wanted] :
       std::vector<std::array<double, 3>>{{4, 1, 1}, {7, 2, 1}, {4, 3.5, 0.5}, {0.25, 2, 0.25}})
    expect(distance(Vec{just(x), just(y)}, outline), wanted, 1e-14);
  expect(distance(straight(3, 1, 3, 2.5), outline), 1, 1e-14);
}

// ---- how far a piece is from a side, and a part sticks out ------------------------------------------------

/// An arc about a centre from an angle on, by a turn, with its chord left out.
Side arc_by_angles(double cx, double cy, double r, double from, double turn) {
  const double x0 = cx + r * std::cos(from), y0 = cy + r * std::sin(from),
               x1 = cx + r * std::cos(from + turn), y1 = cy + r * std::sin(from + turn);
  return shape("[" + arc(x0, y0, x1, y1, cx, cy) + ", " + line(x1, y1, x0, y0) + "]").sides[0];
}
std::vector<Vec> along(const Side& piece) {
  std::vector<Side> parts{piece};
  for (int depth = 0; depth < 4; ++depth) {
    std::vector<Side> finer;
    for (const Side& part : parts)
      for (const Side& half : halves(part)) finer.push_back(half);
    parts = finer;
  }
  std::vector<Vec> points;
  for (const Side& part : parts) points.push_back(part.from);
  return points;
}

TEST(VerifyDistance, NoPointOfAPieceIsFartherThanTheBound) {
  Random random(3);
  const auto uniform = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  for (int i = 0; i < 300; ++i) {
    const double turn = i % 3 == 0 ? uniform(0.2, 3) : uniform(3.3, 6);
    const Side side = i % 5 == 0 ? straight(uniform(-5, 0), uniform(-5, 5), uniform(1, 5), uniform(-5, 5))
                                 : arc_by_angles(0, 0, 5, uniform(0, 6), turn);
    const double x = uniform(-8, 8), y = uniform(-8, 8);
    const Side piece = i % 2 == 0 ? straight(x, y, x + uniform(0.1, 2), y + uniform(-2, 2))
                                  : arc_by_angles(x, y, uniform(0.5, 3), uniform(0, 6), uniform(0.2, 0.8));
    const double bound = farthest(piece, corners_of(piece), side);
    double most = 0;
    for (const Vec& p : along(piece)) most = std::max(most, distance(p, side).low);
    EXPECT_GE(bound, most) << i;
  }
}

TEST(VerifyDistance, APieceBesideAnArcIsBoundedByItsCarrier) {
  for (const double turn : {1.0, 3.141592653589793, 4.5}) {
    const Side side = arc_by_angles(0, 0, 5, -turn / 2, turn);
    const Side outside = straight(6, -0.25, 6, 0.25), inside = straight(4, -0.25, 4, 0.25);
    EXPECT_NEAR(farthest(outside, corners_of(outside), side), std::hypot(6, 0.25) - 5, 1e-12) << turn;
    EXPECT_NEAR(farthest(inside, corners_of(inside), side), 1, 1e-12) << turn;
    // Beside one end alone: in one of the two half-planes of an arc, which suffices for a long one.
    for (const double sign : {1.0, -1.0}) {
      const double c = std::cos(turn / 2 + 0.5), s = sign * std::sin(turn / 2 + 0.5);
      const Side past = straight(6 * c, 6 * s, 6.1 * c, 6.1 * s);
      EXPECT_GT(farthest(past, corners_of(past), side), 2) << turn;
      const double c2 = std::cos(turn / 2 - 0.25), s2 = sign * std::sin(turn / 2 - 0.25);
      const Side within = straight(6 * c2, 6 * s2, 6.1 * c2, 6.1 * s2);
      EXPECT_NEAR(farthest(within, corners_of(within), side), 1.1, 1e-12) << turn;
    }
  }
  // The nearer end of a line that a piece lies behind, and the farthest point of an arc inside it.
  const Side line = straight(0, 0, 10, 0), behind = straight(-3, 0, -2, 0);
  EXPECT_NEAR(farthest(behind, corners_of(behind), line), 3, 1e-12);
  EXPECT_NEAR(farthest(arc_by_angles(0, 0, 2, -0.5, 1), {just(-1), just(0)}), 3, 1e-12);
}

TEST(VerifyDistance, CutsOnlyBetweenTheEnds) {
  const Side line = straight(0, 0, 4, 0);
  EXPECT_FALSE(cut_beside(line, {just(0), just(1)}));
  EXPECT_FALSE(cut_beside(line, {just(4), just(1)}));
  EXPECT_TRUE(cut_beside(line, {just(1), just(1)}));
}

TEST(VerifyDistance, PartsStickOutOfBlanksByWhatSamplesSay) {
  const auto with = [](const std::string& outer, const std::vector<std::string>& holes) {
    std::string list;
    for (const std::string& hole : holes) list += (list.empty() ? "" : ", ") + hole;
    std::string complaint;
    const std::string text = R"({"outer": )" + outer + R"(, "holes": [)" + list + "]}";
    return read_shape(*parse_json(text, "s"), "s", complaint);
  };
  const std::string lens = "[" + arc(5, 1, 5, 9, 2, 5) + ", " + arc(5, 9, 5, 1, 8, 5) + "]";
  const std::string half = "[" + arc(3, 5, 7, 5, 5, 5) + ", " + line(7, 5, 3, 5) + "]";
  struct Known {
    Shape part, blank;
    double out;
  };
  const std::string plate = box(0, 0, 10, 10), around = box(-5, -5, 15, 15);
  const std::vector<Known> table{
      {with(plate, {}), with(around, {lens}), 2},
      {with(plate, {}), with(around, {half}), 1},
      {with(plate, {}), with(around, {box(2, 4, 8, 5)}), 0.5},
      {with(plate, {}), with(around, {box(1, 1, 9, 9)}), 4},
      {with(plate, {}), with(around, {circle(5, 5, 3), box(0.5, 0.5, 1, 1)}), 3},
      {with(plate, {}), with(box(-5, -5, 8, 15), {}), 2},
      {with(plate, {circle(5, 5, 2)}), with(around, {circle(5, 5, 3)}), 1},
      {with(circle(5, 5, 5), {}), with(around, {box(4, 4, 6, 6)}), 1},
      {with(circle(0, 0, 4), {}), with(circle(3, 0, 5), {}), 2},
      {with(circle(0, 0, 4), {}), with(circle(30, 0, 5), {}), 29},
      {with(plate, {}), with(around, {}), 0},
  };
  for (std::size_t k = 0; k < table.size(); ++k) {
    const auto& [part, blank, out] = table[k];
    const Span found = sticking_out(part, blank, 1e-6);
    EXPECT_LE(found.low, out + 1e-9) << k;
    EXPECT_GE(found.high, out - 1e-9) << k;
    EXPECT_LE(found.high - found.low, 2.1e-6) << k;
    // Enough is enough, and no less.
    if (out == 0) {
      EXPECT_LE(sticking_out(part, blank, 1e-6, 0).high, 2.1e-6) << k;
    }
    if (out > 0) {
      EXPECT_GT(sticking_out(part, blank, 1e-6, out / 2).low, out / 2) << k;
    }
    const Span all = sticking_out(part, blank, 1e-6, out + 1);
    EXPECT_LE(all.high - all.low, 2.1e-6) << k;
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_distance_test
