#include "draw/paper/printed_number.hpp"
#include "lekalo/io/text/words.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "draw/paper/colour.hpp"
#include "lekalo/base/random.hpp"
#include "support/cases.hpp"

namespace lekalo::draw::picture_text_test {
using namespace io;
namespace {

double parsed(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

TEST(PictureText, KeepsUtf8AndReplacesWhatIsNot) {
  EXPECT_EQ(clean_text("лопатка № 7 葉 😀"), "лопатка № 7 葉 😀");
  EXPECT_EQ(clean_text("a\xff\xfe"
                       "b"),
            "a��b");
  EXPECT_EQ(clean_text("\xd0"), "�");                                     // cut off
  EXPECT_EQ(clean_text("\xc0\xaf"), "��");                                // overlong
  EXPECT_EQ(clean_text("\xed\xa0\x80").find("\xed"), std::string::npos);  // half a surrogate pair
  EXPECT_EQ(clean_text("a\tb\nc"), "a b c");
  EXPECT_EQ(clean_text(std::string_view("a\0b", 3)), "a�b");
  EXPECT_EQ(clean_text("a\u202E"
                       "b"),
            "a�b");
}

TEST(PictureText, EscapesMarkup) { EXPECT_EQ(xml_text("<a> & \"b'"), "&lt;a&gt; &amp; &quot;b&#39;"); }

TEST(PictureText, ShortensInTheMiddleToTheWidthAndKeepsTheEnding) {
  const std::string name = "an-extraordinarily-long-name-of-a-turbine-blade-0042.csv";
  const std::string text = shortened(name, 15);
  EXPECT_LE(text_width(text), 15);
  EXPECT_GT(text_width(text), 13);
  EXPECT_EQ(text.substr(0, 4), "an-e");
  EXPECT_TRUE(text.ends_with("0042.csv")) << text;
  EXPECT_NE(text.find("…"), std::string::npos);
  EXPECT_EQ(shortened("part.csv", 15), "part.csv");
  const std::string cyrillic = shortened("чрезвычайно-длинное-имя-лопатки-турбины.csv", 12);
  EXPECT_EQ(cyrillic, clean_text(cyrillic));
}

TEST(PictureText, FileNameIsWhatFollowsTheLastFolder) {
  EXPECT_EQ(file_name("/a/b/part.csv"), "part.csv");
  EXPECT_EQ(file_name("c:\\scans\\part.csv"), "part.csv");
  EXPECT_EQ(file_name("part.csv"), "part.csv");
  EXPECT_EQ(file_name("a/"), "a/");
}

TEST(PictureText, NumbersAreRoundedToTheSideAskedForWithinOneUnitOfTheLastDigit) {
  EXPECT_EQ(decimal(0.9469280196, 6, Rounding::down), "0.946928");
  EXPECT_EQ(decimal(0.9469279996, 6, Rounding::down), "0.946927");
  EXPECT_EQ(decimal(0.9469279996, 6, Rounding::up), "0.946928");
  EXPECT_EQ(decimal(0.9469280196, 6, Rounding::up), "0.946929");
  EXPECT_EQ(decimal(-2.25, 1, Rounding::down), "-2.3");
  EXPECT_EQ(decimal(-2.25, 1, Rounding::up), "-2.2");
  EXPECT_EQ(decimal(0.5, 6, Rounding::down), "0.500000");
  EXPECT_EQ(decimal(-0.0, 3), "0.000");
  EXPECT_EQ(decimal(0.0025, 3), "2.500e-03");  // too few digits would be left

  EXPECT_EQ(decimal(std::numeric_limits<double>::infinity(), 3), "–");
  Random random(cases::seed(), 3);
  for (int i = 0; i < 20'000; ++i) {
    const double scale = std::pow(10.0, random.uniform(-12, 9));
    const double value = scale * random.uniform(-1, 1);
    const int decimals = decimals_for(scale);
    const double last = std::max(std::pow(10.0, -decimals), 1.1e-3 * std::abs(value));
    const double down = parsed(decimal(value, decimals, Rounding::down));
    const double up = parsed(decimal(value, decimals, Rounding::up));
    EXPECT_LE(down, value);
    EXPECT_GE(up, value);
    EXPECT_LE(up - down, 2.001 * last) << value << ' ' << decimals;
  }
}

TEST(PictureText, ShortNumbersNeverLookSmallerThanTheyAre) {
  EXPECT_EQ(short_number_up(0), "0");
  EXPECT_EQ(short_number_up(1.584), "1.6");
  EXPECT_EQ(short_number_up(1.61), "1.7");
  EXPECT_EQ(short_number_up(3.01e-13), "3.1e-13");
  Random random(cases::seed(), 4);
  for (int i = 0; i < 20'000; ++i) {
    const double value = std::pow(10.0, random.uniform(-15, 9));
    const double shown = parsed(short_number_up(value));
    EXPECT_GE(shown, value);
    EXPECT_LE(shown, 1.11 * value);
  }
}

TEST(PictureText, LengthsOfAScaleUseAPowerOfTenWhereMillimetresWouldBeLong) {
  EXPECT_EQ(length_scale(0.2, 1.4).text_with_unit(0.6), "0.6 mm");
  EXPECT_EQ(length_scale(20, 20).text_with_unit(20), "20 mm");
  EXPECT_EQ(length_scale(2e-6, 2e-6).text_with_unit(2e-6), "2·10⁻⁶ mm");
  EXPECT_EQ(length_scale(5e6, 2e7).text_with_unit(1.5e7), "1.5·10⁷ mm");
  for (const double value : {1.0, 2.0, 5.0, 1e-7, 2e9, 5e3})
    EXPECT_DOUBLE_EQ(round_length(value * 1.2), value);
}

double luminance(Colour c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(c.red / 255.0) + 0.7152 * linear(c.green / 255.0) + 0.0722 * linear(c.blue / 255.0);
}

TEST(PictureColour, GetsDarkerWithEveryStepFromThinToThick) {
  for (int i = 1; i < kColourSteps; ++i) {
    EXPECT_LT(luminance(scale_colour(i)), luminance(scale_colour(i - 1))) << i;
  }
  EXPECT_GT(scale_colour(0).red, 2 * scale_colour(0).blue);
  EXPECT_GT(scale_colour(kColourSteps - 1).blue, 2 * scale_colour(kColourSteps - 1).red);
}

TEST(PictureColour, StepsCoverTheRangeEvenlyAndClamp) {
  EXPECT_EQ(scale_step(1, 1, 3), 0);
  EXPECT_EQ(scale_step(2, 1, 3), kColourSteps / 2);
  EXPECT_EQ(scale_step(3, 1, 3), kColourSteps - 1);
  EXPECT_EQ(scale_step(-5, 1, 3), 0);
  EXPECT_EQ(scale_step(50, 1, 3), kColourSteps - 1);
}

}  // namespace
}  // namespace lekalo::draw::picture_text_test
