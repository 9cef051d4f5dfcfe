// Written numbers on the grid of layouts, at the very bounds of every rule.

#include "verify/layout/grid_number.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace lekalo::verify::verify_grid_number_test {
namespace {

constexpr std::int64_t kOne = std::int64_t{1} << 52;
constexpr double kStep = 0x1p-20;

TEST(VerifyGridNumber, StepsAreTheNearestOrTheNextAbove) {
  EXPECT_EQ(steps_of(2.5 * kStep, ToStep::nearest, 1), 2) << "ties to even";
  EXPECT_EQ(steps_of(3.5 * kStep, ToStep::nearest, 1), 4);
  EXPECT_EQ(steps_of(2.25 * kStep, ToStep::up, 1), 3);
  EXPECT_EQ(steps_of(3 * kStep, ToStep::up, 1), 3);
  EXPECT_EQ(steps_of(-1, ToStep::nearest, 1), -(1 << 20)) << "the largest length itself";
  EXPECT_EQ(steps_of(std::nextafter(1, 2), ToStep::nearest, 1), std::nullopt);
}

TEST(VerifyGridNumber, APairIsATurnUpToTheVeryBound) {
  // 2^52 and 2^27: their squares are 2^104 + 2^54, which is 2^-50 too much.
  EXPECT_EQ(turn_of_pair(1, 0x1p-25), (GridTurn{kOne, 1 << 27}));
  EXPECT_EQ(turn_of_pair(1, -0x1p-25), (GridTurn{kOne, -(1 << 27)}));
  EXPECT_EQ(turn_of_pair(1, 0x1p-25 + 0x1p-52), std::nullopt);
  EXPECT_EQ(turn_of_pair(1 - 0x1p-51, 0), (GridTurn{kOne - 2, 0})) << "nearly as much too little";
  EXPECT_EQ(turn_of_pair(1 - 0x1.8p-51, 0), std::nullopt);
  EXPECT_EQ(turn_of_pair(1.5, 1.5), std::nullopt);
  EXPECT_EQ(turn_of_pair(0, 0), std::nullopt);
}

TEST(VerifyGridNumber, AnglesOfAnySizeHaveTheirNearestPair) {
  EXPECT_EQ(turn_of_degrees(0), (GridTurn{kOne, 0}));
  EXPECT_EQ(turn_of_degrees(-90), (GridTurn{0, -kOne}));
  EXPECT_EQ(turn_of_degrees(60).c, kOne / 2);
  EXPECT_EQ(turn_of_degrees(210).s, -kOne / 2);
  // So many degrees take more digits of pi than are tried first. The rest of the division by whole turns is
  // exact.
  for (const double degrees : {0x1p300, -0x1p300, 0x1.8p900})
    EXPECT_EQ(turn_of_degrees(degrees), turn_of_degrees(std::fmod(degrees, 360))) << degrees;
  // With the digits that are tried first one of the two numbers may be known, and the other not.
  for (int power = 120; power < 160; ++power)
    for (const double degrees : {std::ldexp(1, power), std::ldexp(1.25, power), std::ldexp(1.75, power)})
      ASSERT_EQ(turn_of_degrees(degrees), turn_of_degrees(std::fmod(degrees, 360))) << degrees;
}

TEST(VerifyGridNumber, ADirectionLiesBetweenTwoOthersCounterClockwise) {
  // Every direction in their order, of different lengths: the axes and what lies between them.
  const std::array<GridTurn, 9> round{
      {{3, 0}, {2, 1}, {1, 2}, {0, 5}, {-1, 1}, {-7, 0}, {-1, -1}, {0, -2}, {4, -1}}};
  const std::size_t n = round.size();
  for (std::size_t from = 0; from < n; ++from)
    for (std::size_t at = 0; at < n; ++at)
      for (std::size_t to = 0; to < n; ++to)
        EXPECT_EQ(lies_between(round[(from + at) % n], round[from], round[(from + to) % n]), at <= to)
            << from << " " << at << " " << to;
}

TEST(VerifyGridNumber, PlacesAreRoundedToTheNearestStepTiesToEven) {
  const GridTurn half{kOne / 2, 0};  // no turn, but exact halves
  struct Case {
    std::int64_t x, rounded;
  };
  for (const auto& [x, rounded] : std::initializer_list<Case>{
           {0, 0}, {1, 0}, {2, 1}, {3, 2}, {4, 2}, {5, 2}, {-1, 0}, {-2, -1}, {-3, -2}, {-4, -2}, {-5, -2}}) {
    EXPECT_EQ(placed({x, 0}, half, false, {0, 0}).x, rounded) << x;
    EXPECT_EQ(placed({0, x}, half, false, {0, 7}).y, rounded + 7) << x;
    EXPECT_EQ(placed({x, 0}, half, true, {0, 0}).x, -rounded) << x;
  }
  const GridTurn little_more{kOne / 2 + 1, 0}, little_less{kOne / 2 - 1, 0};
  EXPECT_EQ(placed({1, 5}, little_more, false, {0, 0}), (GridPoint{1, 3}));
  EXPECT_EQ(placed({3, -1}, little_less, false, {0, 0}), (GridPoint{1, 0}));
  EXPECT_EQ(placed({-1, -5}, little_more, false, {0, 0}), (GridPoint{-1, -3}));
  const GridTurn quarter{0, kOne};
  EXPECT_EQ(placed({3, 1}, quarter, false, {10, 20}), (GridPoint{9, 23}));
  EXPECT_EQ(placed({3, 1}, quarter, true, {10, 20}), (GridPoint{9, 17}));
}

}  // namespace
}  // namespace lekalo::verify::verify_grid_number_test
