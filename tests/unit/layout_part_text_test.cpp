#include "lekalo/layout/part_text.hpp"

#include <gtest/gtest.h>

namespace lekalo::layout::layout_part_text_test {
namespace {

using geom::Point;

PartText text(const std::string& letters) {
  PartText one;
  one.text = letters;
  one.height = 21;  // so that a unit of the font is a millimetre
  return one;
}

void expect_near(Point a, Point b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
}

// The letter I of the font is one stroke from top to bottom, 4 units from its beginning, and 8 wide.
TEST(PartText, StrokesStandWhereTheTextSays) {
  PartText one = text("I");
  one.at = {100, 200};
  auto strokes = text_strokes(one);
  ASSERT_EQ(strokes.size(), 1U);
  expect_near(strokes[0].front(), {104, 221});
  expect_near(strokes[0].back(), {104, 200});
  one.degrees = 90;
  expect_near(text_strokes(one)[0].front(), {79, 204});
  one.degrees = 0, one.mirrored = true;
  expect_near(text_strokes(one)[0].front(), {96, 221});
  one.mirrored = false, one.width_factor = 2;
  expect_near(text_strokes(one)[0].front(), {108, 221});
}

TEST(PartText, AnchorsAreEndsAndMiddle) {
  PartText one = text("II");
  EXPECT_DOUBLE_EQ(text_length(one), 16);
  expect_near(text_middle(one), {8, 10.5});
  one.anchor = TextAnchor::middle;
  expect_near(text_strokes(one)[0].back(), {-4, 0});
  expect_near(text_middle(one), {0, 10.5});
  one.anchor = TextAnchor::right;
  expect_near(text_strokes(one)[1].back(), {-4, 0});
  one.mirrored = true;
  expect_near(text_strokes(one)[1].back(), {4, 0});
}

TEST(PartText, ALetterThatIsMissingIsARectangle) {
  EXPECT_TRUE(has_all_letters(text("Деталь № 7")));
  EXPECT_FALSE(has_all_letters(text("a中")));
  const auto strokes = text_strokes(text("中"));
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_EQ(strokes[0].size(), 5U);
  EXPECT_TRUE(text_strokes(text(" ")).empty());
}

}  // namespace
}  // namespace lekalo::layout::layout_part_text_test
