#include "verify/origin/near.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "verify/shape/stretch.hpp"

/// How the checker shows that curves run along others, and how much it looks for that.
namespace lekalo::verify::verify_near_test {
namespace {

Vec at(double x, double y) { return {just(x), just(y)}; }
CurvePiece line(double x, double y, double to_x, double to_y) {
  return {side_between(at(x, y), at(to_x, to_y))};
}
CurvePiece circle(double radius) {
  Side side;
  side.arc = true, side.sweep = Sweep::full, side.radius = just(radius);
  side.centre = at(0, 0), side.first = side.last = at(1, 0), side.from = side.to = at(radius, 0);
  return {side};
}
struct Looked {
  std::optional<Vec> far;
  std::size_t work = 0;
};
Looked look(const CurvePiece& piece, const CurvePiece& other, double reach, std::size_t most_work = 1000) {
  Looked looked;
  looked.far = CurvePieces({other}).first_not_within({piece}, reach, looked.work, most_work);
  return looked;
}

TEST(VerifyNear, APieceIsWithinUpToTheVeryReach) {
  const CurvePiece piece = line(0, 0, 1, 0), other = line(0, 1, 1, 1);
  const double apart =
      (just(farthest(piece.side, corners_of(piece.side), other.side)) + just(0) + just(0)).high;
  Looked looked = look(piece, other, apart);
  EXPECT_FALSE(looked.far);
  EXPECT_EQ(looked.work, 1U);
  EXPECT_TRUE(look(piece, other, step_down(apart)).far);
  CurvePiece loose = other;
  loose.more = 0.5;
  EXPECT_FALSE(look(piece, loose, 0.75).far);
  EXPECT_TRUE(look(piece, loose, 0.375).far);
}

TEST(VerifyNear, WhatIsNotShownIsHalvedSixtyTimesOrUntilTheWorkIsDone) {
  // The end at (1, 0) is farther than half from the diagonal, whose box holds it.
  const CurvePiece piece = line(0, 0, 1, 0), other = line(0, 0, 1, 1);
  Looked looked = look(piece, other, 0.5);
  EXPECT_EQ(looked.work, 61U);
  EXPECT_NEAR(looked.far.value().x.low, 1, 1e-15);
  looked = look(piece, other, 0.5, 0);
  EXPECT_EQ(looked.work, 1U);
  EXPECT_EQ(looked.far.value().x.low, 0);
  // One look is no more than one, so the halves are looked at, too.
  EXPECT_EQ(look(piece, other, 0.5, 1).work, 2U);
}

TEST(VerifyNear, ALongPieceIsLookedAtOnceWhateverLiesInItsBox) {
  std::vector<CurvePiece> others{line(0, 0, 1000, 1000)};
  for (int k = 1; k < 1000; ++k) others.push_back(line(k, k + 0.25, k + 0.5, k - 0.25));
  std::size_t work = 0;
  EXPECT_FALSE(CurvePieces(others).first_not_within({others[0]}, 1e-6, work, 0));
  EXPECT_EQ(work, 1U);
}

TEST(VerifyNear, CirclesAreLookedAtInPartsOfLessThanHalfATurn) {
  EXPECT_FALSE(look(circle(5), circle(5.5), 0.75).far);
  EXPECT_TRUE(look(circle(5), circle(6), 0.75).far);
}

TEST(VerifyNear, PiecesNearAPointAreCalled) {
  CurvePiece piece = line(0, 0, 1, 0);
  const auto called = [&](const Vec& p, double reach) {
    std::vector<std::size_t> all;
    CurvePieces({piece}).each_near(p, reach, [&](std::size_t k) { all.push_back(k); });
    return all.size();
  };
  EXPECT_EQ(called(at(0.5, 0), 0), 1U);
  EXPECT_EQ(called(at(0.5, 1), 0.75), 0U);
  piece.off = 0.125, piece.more = 0.125;
  EXPECT_EQ(called(at(0.5, 1), 0.75), 1U);
  EXPECT_EQ(called(at(0.5, 1.125), 0.75), 0U);
  EXPECT_FALSE(CurvePieces({piece}).surely_away(at(0.5, 1), 0.75));
  EXPECT_TRUE(CurvePieces({piece}).surely_away(at(0.5, 2), 0.75));
}

}  // namespace
}  // namespace lekalo::verify::verify_near_test
