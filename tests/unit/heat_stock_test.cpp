#include "lekalo/heat/stock.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lekalo::heat::heat_stock_test {
namespace {

TEST(HeatStock, SidesAndCornerAreRead) {
  const auto plain = read_stock("120x100x20");
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->width, 120);
  EXPECT_EQ(plain->depth, 100);
  EXPECT_EQ(plain->thickness, 20);
  EXPECT_FALSE(plain->corner);
  const auto placed = read_stock("60.5x50x20@-10,2.5");
  ASSERT_TRUE(placed && placed->corner);
  EXPECT_EQ(*placed->corner, (std::array{-10.0, 2.5}));
}

TEST(HeatStock, OtherWordsAreNone) {
  for (const char* wrong :
       {"", "120", "120x100", "120x100x20x3", "0x100x20", "-1x100x20", "120x100x20@", "120x100x20@3",
        "120x100x20@3,", "120x100x20@3,4,5", "1e6x100x20", "axbxc", "120X100X20", "nanx1x1"})
    EXPECT_FALSE(read_stock(wrong)) << wrong;
}

TEST(HeatStock, ThePocketLiesInTheMiddleUnlessACornerIsSaid) {
  const StockBox middle = stock_box(*read_stock("120x100x20"), {35, 20});
  EXPECT_EQ(middle.low_x, -25);
  EXPECT_EQ(middle.high_x, 95);
  EXPECT_EQ(middle.low_y, -30);
  EXPECT_EQ(middle.high_y, 70);
  const StockBox placed = stock_box(*read_stock("120x100x20@1,2"), {35, 20});
  EXPECT_EQ(placed.low_x, 1);
  EXPECT_EQ(placed.high_y, 102);
}

TEST(HeatStock, TheDistanceFromItsBorderIsPositiveInside) {
  const StockBox box{0, 0, 10, 6, 5};
  EXPECT_EQ(box.inside(5, 3), 3);
  EXPECT_EQ(box.inside(1, 3), 1);
  EXPECT_EQ(box.inside(12, 3), -2);
  EXPECT_EQ(box.inside(13, 10), -5);
}

}  // namespace
}  // namespace lekalo::heat::heat_stock_test
