// The allowance of a part in a blank of straight lines, held against what every pair of a point and an edge
// says, in numbers that doubles cannot tell apart; and the outlines that it is measured between.

#include "verify/locate/allowance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/verify_cases.hpp"

namespace lekalo::verify::verify_allowance_test {
namespace {

using verify_cases::Random;

Outline outline(Ring points) {
  Result<Outline> made = make_outline(std::move(points), "outline");
  EXPECT_TRUE(made) << made.error().message;
  return made ? *std::move(made) : Outline{};
}
Outline square(int from, int to) { return outline({{from, from}, {to, from}, {to, to}, {from, to}}); }

Interval measured(const Outline& blank, const Outline& part, const Pose& pose) {
  return allowance(blank, part, pose, working_precision(blank, part));
}
std::pair<double, double> ends(const Outline& blank, const Outline& part, const Pose& pose = {}) {
  const Interval found = measured(blank, part, pose);
  return {found.low_double(), found.high_double()};
}

// ---- what is known ----------------------------------------------------------------------------------------

TEST(Allowance, InAConvexBlankIsTheLeastDistanceFromALine) {
  const Outline part = square(40, 60);
  EXPECT_EQ(ends(square(0, 100), part), std::pair(40.0, 40.0));
  EXPECT_EQ(ends(square(0, 100), part, {{10, -20}, {}}), std::pair(20.0, 20.0));
  EXPECT_EQ(ends(square(0, 100), part, {{0, 45}, {}}), std::pair(-5.0, -5.0));
  EXPECT_EQ(ends(outline({{0, 0}, {100, 0}, {0, 75}}), outline({{10, 20}, {20, 20}, {10, 30}})),
            std::pair(10.0, 10.0));
  EXPECT_EQ(ends(outline({{0, 0}, {0, 300}, {400, 0}}), outline({{100, 100}, {200, 100}, {100, 200}})),
            std::pair(20.0, 20.0));
}

/// Its upper edge is dented by 3 in the middle.
Ring dented() { return {{0, 0}, {100, 0}, {100, 100}, {50, 97}, {0, 100}}; }

TEST(Allowance, InADentedBlankIsTheDistanceOfTheOutlines) {
  const std::pair to_the_dent(37.0, 37.0);
  EXPECT_EQ(ends(outline(dented()), square(40, 60)), to_the_dent);  // to an edge of the part
  EXPECT_EQ(ends(outline(dented()), outline({{45, 40}, {55, 40}, {50, 60}})), to_the_dent);  // to its corner
  EXPECT_EQ(ends(outline(dented()), square(30, 60)), std::pair(30.0, 30.0));
  // A point that the file has twice makes an edge without a length.
  Ring twice = dented();
  twice.insert(twice.begin() + 3, Point{50, 97});
  EXPECT_EQ(ends(outline(twice), outline({{45, 40}, {55, 40}, {50, 60}})), to_the_dent);
  twice = dented();
  twice.push_back({0, 100});
  EXPECT_EQ(ends(outline(twice), square(40, 60)), to_the_dent);
}

TEST(Allowance, BetweenADentAndItsHullThereIsNone) {
  EXPECT_EQ(ends(outline(dented()), outline({{10, 80}, {20, 80}, {20, 98}, {10, 98}})), std::pair(-1.0, 2.0));
  EXPECT_EQ(ends(outline(dented()), outline({{10, 80}, {20, 80}, {20, 97}, {10, 97}})), std::pair(0.0, 3.0));
  EXPECT_NEAR(ends(outline(dented()), outline({{10, 80}, {20, 80}, {20, 96}, {10, 96}})).first, 2.795, 1e-3);
}

TEST(Allowance, ThePrecisionGrowsWithTheWidestNumber) {
  EXPECT_EQ(working_precision(square(0, 100), square(1, 2)), 256 + 6 * 7);
  EXPECT_EQ(working_precision(square(0, 1), square(-1000, 2)), 256 + 6 * 10);
  EXPECT_EQ(working_precision(outline({{0, 0}, {1, 0}, {0, 1 << 20}}), square(0, 1)), 256 + 6 * 21);
  EXPECT_EQ(working_precision(outline({{0, 0}, {1 << 20, 0}, {0, 1}}), square(0, 1)), 256 + 6 * 21);
}

// ---- what doubles cannot tell apart -----------------------------------------------------------------------

/// A regular polygon of this radius, but for less than a step in each number.
Ring polygon(std::size_t corners, double radius) {
  Ring ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const double at = 2 * std::numbers::pi * (static_cast<double>(i) + 0.3) / static_cast<double>(corners);
    ring.push_back({Integer(std::round(radius * std::cos(at))), Integer(std::round(radius * std::sin(at)))});
  }
  return ring;
}
Integer some(Random& random, unsigned most) {
  return Integer(static_cast<long>(random.below(2 * most + 1)) - static_cast<long>(most));
}

/// Of all pairs of a corner of the part and an edge of the blank.
std::string by_lines(const Outline& blank, const Outline& part, const Pose& pose) {
  const Precision precision = working_precision(blank, part);
  std::optional<Interval> least;
  for (std::size_t j = 0; j < blank.hull.size(); ++j)
    for (const Point& v : part.points) {
      const Interval distance = line_distance(v, blank.corner(j), blank.side(j), pose, precision);
      least = least ? minimum(*least, distance) : distance;
    }
  return least->low_text() + " " + least->high_text();
}
std::string text_of(const Interval& interval) { return interval.low_text() + " " + interval.high_text(); }

/// A part like the blank, an eighth smaller: all of its corners are as near to the blank as the last digits
/// say.
TEST(Allowance, OfPairsThatDoublesCannotTellApartTheNearestCounts) {
  Random random(1);
  for (int round = 0; round < 12; ++round) {
    const double radius = round % 2 == 0 ? 1e20 : 1e9;
    const Point middle{some(random, 1000) * power_of_ten(22), some(random, 1000) * power_of_ten(22)};
    Ring blank = polygon(23, radius), part = blank;
    for (Point& p : part) p = {p.x * 7 / 8 + some(random, 9), p.y * 7 / 8 + some(random, 9)};
    for (Point& p : blank) p = {p.x + middle.x, p.y + middle.y};
    const Outline in = outline(blank), of = outline(part);
    ASSERT_TRUE(in.convex());
    const Pose pose{{middle.x + some(random, 9), middle.y + some(random, 9)},
                    round % 3 == 0 ? Decimal{} : Decimal{some(random, 99), -15}};
    EXPECT_EQ(text_of(measured(in, of, pose)), by_lines(in, of, pose)) << round;
  }
}

/// Far from the blank each edge of the part that runs along one of the blank has two corners as far away.
TEST(Allowance, OfAPartFarAwayTheNearestPairCounts) {
  Random random(2);
  const Ring ring = polygon(12, 1e6);
  for (int round = 0; round < 12; ++round) {
    Ring part = ring;
    for (Point& p : part)
      p = {p.x * power_of_ten(6) + some(random, 9), p.y * power_of_ten(6) + some(random, 9)};
    const double along = 2 * std::numbers::pi * (round + 0.8) / 12;
    const Pose pose{{Integer(1e27 * std::cos(along)), Integer(1e27 * std::sin(along))}, {}};
    const Outline in = outline(ring), of = outline(part);
    EXPECT_EQ(text_of(measured(in, of, pose)), by_lines(in, of, pose)) << round;
  }
}

/// The squares of these sides are no doubles.
TEST(Allowance, SidesMayBeLongerThanSquaresOfDoubles) {
  const Integer long_side = Integer(1) << 600;
  const Outline blank = outline({{0, 0}, {4 * long_side, 0}, {0, 3 * long_side}});
  const Outline part =
      outline({{long_side, long_side}, {2 * long_side, long_side}, {long_side, 2 * long_side}});
  EXPECT_EQ(text_of(measured(blank, part, {})), by_lines(blank, part, {}));
}

Integer squared(const Point& p) { return dot(p, p); }
Fraction squared_distance(const Point& p, const Point& a, const Point& b) {
  const Point e = b - a, w = p - a;
  const Integer along = dot(w, e);
  if (along <= 0) return Fraction(squared(w));
  if (along >= squared(e)) return Fraction(squared(p - b));
  const Integer aside = cross(e, w);
  return Fraction(aside * aside) / Fraction(squared(e));
}
/// Of all pairs of a point of the one outline and an edge of the other.
std::string by_segments(const Outline& blank, const Outline& part, const Point& shift) {
  Ring placed;
  for (const Point& p : part.points) placed.push_back({p.x + shift.x, p.y + shift.y});
  std::optional<Fraction> least;
  for (const auto& [points, ring] :
       {std::pair<const Ring*, const Ring*>{&placed, &blank.points}, {&blank.points, &placed}})
    for (const Point& p : *points)
      for (std::size_t j = 0; j < ring->size(); ++j) {
        const Fraction one = squared_distance(p, (*ring)[j], (*ring)[(j + 1) % ring->size()]);
        if (!least || one < *least) least = one;
      }
  const Precision precision = working_precision(blank, part);
  return text_of(square_root(Interval(Integer(least->get_num()), precision) /
                             Interval(Integer(least->get_den()), precision)));
}

/// Between any two corners of the blank there is one more point, a little within the line.
TEST(Allowance, OfOutlinesThatDoublesCannotTellApartTheNearestPairCounts) {
  Random random(3);
  for (int round = 0; round < 24; ++round) {
    const double radius = round % 2 == 0 ? 1e20 : 1e9;
    const Ring corners = polygon(13, radius);
    Ring blank, part;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const Integer in = 1000 + (round % 4 < 2 ? Integer(0) : some(random, 999));
      const Point middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
      blank.push_back(a);
      blank.push_back(
          {middle.x - in * middle.x / Integer(radius), middle.y - in * middle.y / Integer(radius)});
      part.push_back({a.x * 7 / 8 + some(random, 9), a.y * 7 / 8 + some(random, 9)});
      if (round % 8 < 4) part.push_back({middle.x * 7 / 8, middle.y * 7 / 8});
    }
    std::rotate(blank.begin(), blank.begin() + round % 5, blank.end());
    if (round % 3 == 1) std::reverse(blank.begin(), blank.end());
    if (round % 3 == 2) std::reverse(part.begin(), part.end());
    const Outline in = outline(blank), of = outline(part);
    ASSERT_FALSE(in.convex());
    const Point shift{some(random, 9), some(random, 9)};
    EXPECT_EQ(text_of(measured(in, of, {shift, {}})), by_segments(in, of, shift)) << round;
  }
}

/// A part in a corner of a blank of many points, so that most of them are out of question.
TEST(Allowance, AmongManyPointsTheNearestPairIsFoundWhereverItIs) {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    Ring blank = polygon(40, 1e6), part = polygon(60, 2e5);
    for (std::size_t i = 1; i < blank.size(); i += 2) {
      const Point &a = blank[i - 1], &b = blank[(i + 1) % blank.size()];
      blank[i] = {(a.x + b.x) / 2 * 99 / 100, (a.y + b.y) / 2 * 99 / 100};
    }
    for (Point& p : part) p = {p.x + some(random, 99), p.y + some(random, 99)};
    const double way = random.uniform(0, 6.28), far = random.uniform(0, 7.7e5);
    const Point shift{Integer(far * std::cos(way)), Integer(far * std::sin(way))};
    const Outline in = outline(blank), of = outline(part);
    EXPECT_EQ(text_of(measured(in, of, {shift, {}})), by_segments(in, of, shift)) << round;
    const Outline hull = outline(polygon(40, 1e6));
    EXPECT_EQ(text_of(measured(hull, of, {shift, {}})), by_lines(hull, of, {shift, {}})) << round;
  }
}

// ---- outlines ---------------------------------------------------------------------------------------------

TEST(Outlines, HaveAHullOfTheirStrictCornersAndTheDentsOfItsEdges) {
  // Points of a rectangle's sides are no corners, and of equal points the first is one.
  const Outline one = outline({{4, 0}, {8, 0}, {8, 3}, {8, 6}, {8, 6}, {4, 5}, {0, 6}, {0, 3}, {0, 0}});
  EXPECT_EQ(one.hull, (std::vector<std::size_t>{8, 1, 3, 6}));
  EXPECT_TRUE(one.counter_clockwise);
  EXPECT_TRUE(one.dents == (std::vector<Integer>{0, 0, 8, 0}));
  EXPECT_FALSE(one.convex());
  const Outline back = outline({{0, 0}, {0, 6}, {4, 5}, {8, 6}, {8, 0}});
  EXPECT_EQ(back.hull, (std::vector<std::size_t>{0, 4, 3, 1}));
  EXPECT_FALSE(back.counter_clockwise);
  EXPECT_TRUE(back.dents == (std::vector<Integer>{0, 0, 8, 0}));
  EXPECT_TRUE(outline({{0, 0}, {5, 0}, {0, 5}}).convex());
}

TEST(Outlines, RunOnceAroundTheirHull) {
  const auto refused = [](Ring points) {
    const auto made = make_outline(std::move(points), "x");
    return made ? "" : made.error().message;
  };
  EXPECT_EQ(refused({{0, 0}, {3, 0}, {3, 3}, {0, 3}}), "");
  EXPECT_EQ(refused({{0, 3}, {3, 3}, {3, 0}, {0, 0}}), "");
  EXPECT_EQ(refused({{3, 3}, {3, 0}, {0, 0}, {0, 3}}), "");
  EXPECT_EQ(refused({{3, 0}, {3, 3}, {0, 3}, {0, 0}}), "");
  EXPECT_EQ(refused({{0, 0}, {2, 2}, {1, 1}}), "x: the contour has no area");
  const std::string crossed = "x: the contour does not run once around its convex hull";
  EXPECT_EQ(refused({{0, 0}, {3, 3}, {3, 0}, {0, 3}}), crossed);
  EXPECT_EQ(refused({{0, 0}, {3, 0}, {0, 3}, {3, 3}}), crossed);
  EXPECT_EQ(refused({{0, 3}, {2, -2}, {-3, 1}, {3, 1}, {-2, -2}}), crossed);
}

TEST(Outlines, TheLowestCornerIsFoundFromAnyOther) {
  const Outline one = outline(polygon(11, 1000));
  for (const Point& direction : polygon(17, 50))
    for (std::size_t start = 0; start < 23; ++start) {
      const std::size_t low = lowest_corner(one, direction, start);
      ASSERT_LT(low, 11U);
      for (std::size_t j = 0; j < 11; ++j)
        EXPECT_GE(sgn(cross(direction, one.corner(j) - one.corner(low))), 0) << start;
    }
  // Two corners are as low.
  EXPECT_EQ(lowest_corner(square(0, 10), {1, 0}, 1), 1U);
  EXPECT_EQ(lowest_corner(square(0, 10), {1, 0}, 4), 0U);
}

/// The edge across which the one reaches outside the other, or none.
std::optional<std::size_t> across(const Outline& inner, const Outline& outer) {
  std::size_t culprit = 99;
  return lies_inside(inner, outer, culprit) ? std::nullopt : std::optional(culprit);
}

TEST(Outlines, LieInsideWhereNoEdgeOfTheOuterOneEnters) {
  const Outline ten = square(0, 10);
  EXPECT_EQ(across(ten, ten), std::nullopt);
  EXPECT_EQ(across(square(2, 8), ten), std::nullopt);
  EXPECT_EQ(across(ten, square(2, 8)), 0U);
  EXPECT_EQ(across(ten, outline({{0, 0}, {10, 0}, {10, 9}, {0, 9}})), 2U);
  EXPECT_EQ(across(ten, outline({{0, 9}, {10, 9}, {10, 0}, {0, 0}})), 0U);
  EXPECT_EQ(across(square(12, 18), ten), 0U);  // beside it nothing winds around
  EXPECT_EQ(across(square(-8, -2), ten), 0U);
  // A dent may touch the hull in a corner and along an edge, but not come in.
  const auto with_dent = [](Integer x, Integer y) {
    return outline({{-5, -5}, {15, -5}, {15, 15}, {x, y}, {-5, 15}});
  };
  EXPECT_EQ(across(ten, with_dent(5, 10)), std::nullopt);
  EXPECT_EQ(across(ten, with_dent(5, 9)), 2U);
  EXPECT_EQ(across(ten, outline({{-5, -5}, {15, -5}, {15, 15}, {8, 10}, {2, 10}, {-5, 15}})), std::nullopt);
  EXPECT_EQ(across(ten, outline({{-5, -5}, {15, -5}, {15, 15}, {10, 10}, {0, 10}, {-5, 15}})), std::nullopt);
  EXPECT_EQ(across(ten, outline({{-5, -5}, {15, -5}, {15, 15}, {12, 9}, {-2, 9}, {-5, 15}})), 3U);
  EXPECT_EQ(across(ten, outline({{-5, -5}, {-5, 15}, {-2, 9}, {12, 9}, {15, 15}, {15, -5}})), 2U);
}

/// An edge past a corner is on the outside of no side as a whole.
TEST(Outlines, AnEdgePastACornerDoesNotEnter) {
  const auto cut = [](int by) {
    return outline({{-20, -20}, {20 + by, -20}, {-20, 20 + by}});  // its long edge is x + y = by
  };
  const Outline inner = square(-5, 5);
  EXPECT_EQ(across(inner, cut(10)), std::nullopt);  // through the corner
  EXPECT_EQ(across(inner, cut(11)), std::nullopt);
  EXPECT_EQ(across(inner, cut(9)), 1U);
  const Outline back = outline({{-20, 30}, {30, -20}, {-20, -20}});
  EXPECT_EQ(across(inner, back), std::nullopt);
  EXPECT_EQ(across(square(-5, 6), back), 0U);
}

/// The middle of three corners of the inner outline is as high as a point of the outer one.
TEST(Outlines, WindAroundWhatIsAsHighAsOneOfTheirPoints) {
  const Outline inner = outline({{0, 0}, {6, 0}, {0, 6}});  // its middle is (2, 2)
  for (const bool turned : {false, true}) {
    const auto ring = [&](Ring points) {
      if (turned) std::reverse(points.begin(), points.end());
      return outline(std::move(points));
    };
    EXPECT_EQ(across(inner, ring({{-9, -9}, {20, -9}, {20, 2}, {20, 20}, {-9, 20}, {-9, 2}})), std::nullopt);
    EXPECT_EQ(across(inner, ring({{-9, 2}, {7, -40}, {20, 2}, {7, 40}})), std::nullopt);
    EXPECT_EQ(across(inner, ring({{20, 2}, {30, -40}, {40, 2}, {30, 40}})), 0U);
    EXPECT_EQ(across(inner, ring({{-40, 2}, {-30, -40}, {-20, 2}, {-30, 40}})), 0U);
    EXPECT_EQ(across(inner, ring({{-9, 20}, {9, 20}, {9, 40}, {-9, 40}})), 0U);
    EXPECT_EQ(across(inner, inner), std::nullopt);
  }
  const Outline slanted = outline({{100, 100}, {200, 101}, {101, 200}});
  EXPECT_EQ(across(slanted, slanted), std::nullopt);
  const Outline thin = outline({{100, 100}, {200, 201}, {150, 151}});
  EXPECT_EQ(across(thin, thin), std::nullopt);
}

}  // namespace
}  // namespace lekalo::verify::verify_allowance_test
