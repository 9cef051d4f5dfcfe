#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "verify/origin/drawing.hpp"

/// The lines and arcs that stand for the curves of drawings, and how far they are off.
namespace lekalo::verify::verify_curves_test {
namespace {

using Poles = std::array<std::array<double, 2>, 4>;
using Pieces = std::vector<CurvePiece>;

Vec point(double x, double y) { return {just(x), just(y)}; }

/// The pieces that a maker makes of a curve; none where it is not read.
template <class Draw>
Pieces made(double off, const Draw& draw) {
  ReadDrawing drawing;
  CurveMaker maker(drawing, off);
  draw(maker);
  maker.done("", false);
  return drawing.curves.empty() || !drawing.not_read.empty() ? Pieces() : drawing.curves[0].pieces;
}
Pieces cubic(const Poles& p, double off) {
  return made(off, [&](CurveMaker& maker) {
    maker.cubic({}, {point(p[0][0], p[0][1]), point(p[1][0], p[1][1]), point(p[2][0], p[2][1]),
                     point(p[3][0], p[3][1])});
  });
}
bool is_one_line(const Pieces& pieces) { return pieces.size() == 1 && !pieces[0].side.arc; }
Pieces arc(const Affine& map, const Span& radius, const Vec& first, const Vec& last, Sweep sweep,
           double off = 1) {
  return made(off, [&](CurveMaker& maker) {
    maker.arc(map, {point(0, 0), radius, first, last, sweep, {}, {}});
  });
}

TEST(VerifyCurves, WhatHasNoLengthDrawsNothingAndWhatOverflowsDoes) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  const Vec right = point(1, 0);
  const auto line = [](const Affine& map, const Vec& from, const Vec& to) {
    return made(1, [&](CurveMaker& maker) { maker.line(map, from, to); }).size();
  };
  EXPECT_EQ(arc({}, just(kLeast), right, right, Sweep::full).size(), 0U);
  EXPECT_EQ(arc({}, just(4 * kLeast), right, right, Sweep::full).size(), 1U);
  EXPECT_EQ(line({}, point(3, 4), point(3, 4)), 0U);
  EXPECT_EQ(line({}, point(3, 4), point(3, 4 + 1e-12)), 1U);
  // Nobody knows how far apart they are there.
  const Affine huge{point(1e200, 0), point(0, 1e200), point(0, 0)};
  EXPECT_EQ(line(huge, point(1e200, 0), point(3e200, 0)), 1U);
  EXPECT_EQ(arc({}, {std::numeric_limits<double>::max(), kInfinity}, right, right, Sweep::full).size(), 1U);
}

TEST(VerifyCurves, ABezierCurveIsOffItsChordByItsBendsOrItsPoles) {
  // Where a pole is before the beginning or behind the end the bends count, else how far aside the poles are.
  struct Case {
    Poles poles;
    double off;
  };
  const std::vector<Case> cases{
      {{{{0, 0}, {-1, 0}, {2, 0}, {3, 0}}}, 3},     {{{{3, 0}, {2, 0}, {-1, 0}, {0, 0}}}, 3},
      {{{{0, 0}, {1, 0}, {4, 0}, {3, 0}}}, 3},      {{{{0, 0}, {1, 1}, {2, -0.5}, {3, 0}}}, 1},
      {{{{0, 0}, {1, -0.5}, {2, 1}, {3, 0}}}, 1},   {{{{0, 0}, {2, 0.5}, {2, 0.25}, {4, 0}}}, 0.5},
      {{{{0, 0}, {0.25, 0}, {4, 0}, {4.25, 0}}}, 0}};
  for (const Case& c : cases) {
    const Pieces pieces = cubic(c.poles, 4);
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_NEAR(pieces[0].off, c.off, 1e-12);
    EXPECT_NEAR(pieces[0].side.from.x.low, c.poles[0][0], 1e-12);
    EXPECT_NEAR(pieces[0].side.to.x.low, c.poles[3][0], 1e-12);
    if (pieces[0].off < 1e-9) continue;
    // A distance that is just met is enough.
    EXPECT_TRUE(is_one_line(cubic(c.poles, pieces[0].off)));
    EXPECT_FALSE(is_one_line(cubic(c.poles, step_down(pieces[0].off))));
  }
  EXPECT_EQ(cubic({{{0, 0}, {1, 1}, {-1, 1}, {0, 0}}}, 100).size(), 0U) << "a loop within the distance";
}

TEST(VerifyCurves, ABezierCurveIsOffItsArcByTheSpreadOfItsDistancesFromTheCentre) {
  struct Case {
    Poles poles;
    const char* arc;
  };
  const std::vector<Case> cases{
      {{{{10, 0}, {9.9, 5.6}, {6.3, 9.9}, {0, 10}}}, "0.40280 0.40280 9.56005 0.13820"},
      {{{{10, 0}, {10, 8.4}, {0, 13}, {-6, 8}}}, "-0.01979 -0.03958 9.95674 0.29951"},
      {{{{0, 10}, {5.7, 10.5}, {9.3, 5.1}, {10, 0}}}, "-0.29237 -0.29237 10.32068 0.39157"},
      {{{{10, 0}, {9.3, 6.1}, {5.8, 9.2}, {0, 10}}}, "-0.43490 -0.43490 10.37686 0.21563"},
      {{{{10, 0}, {10.9, 9}, {0.9, 13.2}, {-6, 8}}}, "0.41294 0.82587 9.72287 0.46815"},
      {{{{0, 10}, {4.9, 9.1}, {10.1, 4.7}, {10, 0}}}, "-1.73542 -1.73542 11.94060 0.30936"},
      {{{{10, 0}, {9.4, 5}, {4.7, 9.9}, {0, 10}}}, "-1.55699 -1.55699 11.72571 0.19697"},
      {{{{10, 0}, {9.9, 8.8}, {0.6, 13.3}, {-6, 8}}}, "0.22859 0.45718 9.76457 0.24149"},
      {{{{0, 10}, {5.5, 10.3}, {9.9, 5.1}, {10, 0}}}, "-0.16034 -0.16034 10.20163 0.15154"},
      {{{{10, 0}, {10.9, 6.4}, {6.1, 10.4}, {0, 10}}}, "1.46310 1.46310 8.60314 0.26593"},
      {{{{10, 0}, {9.7, 7.7}, {0.2, 12.2}, {-6, 8}}}, "-0.47771 -0.95542 10.45422 0.26814"},
      {{{{0, 10}, {6, 9.8}, {10.6, 5.3}, {10, 0}}}, "0.41690 0.41690 9.58770 0.22866"},
      {{{{10, 0}, {10.8, 6.1}, {4.6, 9.5}, {0, 10}}}, "-0.02902 -0.02902 10.07872 0.48441"},
      {{{{10, 0}, {10.7, 8.1}, {1.5, 12.8}, {-6, 8}}}, "0.15126 0.30251 9.86101 0.48536"},
      {{{{0, 10}, {4.7, 10.2}, {10.5, 5.1}, {10, 0}}}, "-0.36474 -0.36474 10.40836 0.29694"}};
  for (const Case& c : cases) {
    const Pieces pieces = cubic(c.poles, 1);
    ASSERT_EQ(pieces.size(), 1U);
    const Side& side = pieces[0].side;
    EXPECT_EQ(fmt::format("{:.5f} {:.5f} {:.5f} {:.5f}", side.centre.x.low, side.centre.y.low,
                          side.radius.low, pieces[0].off),
              c.arc);
    EXPECT_EQ(cubic(c.poles, pieces[0].off).size(), 1U);
    EXPECT_GT(cubic(c.poles, step_down(pieces[0].off)).size(), 1U);
  }
}

TEST(VerifyCurves, AnArcOfAnEllipseIsHalvedUntilItsChordsAreNear) {
  const Affine map{point(2, 0), point(0, 1), point(0, 0)};
  const Vec right = point(1, 0), up = point(0, 1), left = point(-1, 0), down = point(0, -1);
  const double turn = 1.5708 * length(right - up).high;
  const double reach = (just(8) * (length(map.x) + length(map.y))).high, off = turn * turn * reach / 8;
  EXPECT_EQ(arc(map, just(8), right, up, Sweep::less, off).size(), 1U);
  EXPECT_EQ(arc(map, just(8), right, up, Sweep::less, step_down(off)).size(), 2U);
  EXPECT_EQ(arc(map, just(8), right, left, Sweep::half, 1e9).size(), 2U);
  EXPECT_EQ(arc(map, just(8), right, right, Sweep::full, 1e9).size(), 4U);
  EXPECT_EQ(arc(map, just(8), right, down, Sweep::more, 1e9).size(), 2U);
}

TEST(VerifyCurves, AMapKeepsCirclesButForItsShare) {
  int exact = 0;
  for (int k = -40; k < 10; ++k) {
    const Affine map{point(1, 0), point(0x1p-36 * (1 + k * 0x1p-53), 1), point(0, 0)};
    const double off = length(map.y - Vec{-map.x.y, map.x.x}).high, most = 0x1p-36 * length(map.x).low;
    const Pieces pieces = arc(map, just(1), point(1, 0), point(0, 1), Sweep::less);
    ASSERT_FALSE(pieces.empty());
    EXPECT_EQ(pieces[0].side.arc, off <= most) << k;
    exact += off == most ? 1 : 0;
  }
  EXPECT_GT(exact, 0);
}

TEST(VerifyCurves, AFlatArcIsALineAsFarAsItsOwnHeightGoes) {
  const auto bulge = [](const Decimal& of) {
    return made(1, [&](CurveMaker& maker) { maker.bulge({}, point(0, 0), point(10, 0), of); });
  };
  // The smallest double that is not below 9.9999999999999995e-8 is 1e-7.
  EXPECT_TRUE(bulge({Integer("99999999999999995"), -24})[0].side.arc);
  EXPECT_FALSE(bulge({Integer("99999999999998"), -21})[0].side.arc);
  EXPECT_FALSE(bulge({-9, -8})[0].side.arc);
  EXPECT_NEAR(bulge({-9, -8})[0].off, 9e-7, 1e-9);
  // The second one has no length here, and the first keeps its own height.
  const Affine upright{point(0, 0), point(0, 1), point(0, 0)};
  const Pieces two = made(1, [&](CurveMaker& maker) {
    maker.bulge(upright, point(0, 0), point(0, 1000), {9, -8});
    maker.bulge(upright, point(0, 1000), point(10, 1000), {9, -8});
  });
  ASSERT_EQ(two.size(), 1U);
  EXPECT_NEAR(two[0].off, 4.5e-5, 1e-9);
}

TEST(VerifyCurves, TwentyThousandStrokesAreTheMost) {
  const auto strokes = [](double count) {
    // The count is rounded up, so that half a stroke less leaves no doubt.
    const double turn = 360 * 0.0174533 / (count - 4.5), off = turn * turn * (8 + 7) / 8;
    return made(off,
                [](CurveMaker& maker) { maker.ellipse({}, point(0, 0), point(8, 0), point(0, 7), 0, 360); })
        .size();
  };
  EXPECT_EQ(strokes(20'000), 20'000U);
  EXPECT_EQ(strokes(20'001), 0U);
}

}  // namespace
}  // namespace lekalo::verify::verify_curves_test
