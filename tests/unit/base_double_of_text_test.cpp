#include "lekalo/base/double_of_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lekalo::base_double_of_text_test {
namespace {

TEST(DoubleOfText, ReadsDecimalsToTheNearestDouble) {
  EXPECT_EQ(double_of_text("0"), 0.0);
  EXPECT_EQ(double_of_text("-12.5e-1"), -1.25);
  EXPECT_EQ(double_of_text(".5"), 0.5);
  EXPECT_EQ(double_of_text("5."), 5.0);
  EXPECT_EQ(double_of_text("1E+3"), 1000.0);
  EXPECT_EQ(double_of_text("9007199254740993"), 9007199254740992.0);  // a tie goes to even
  EXPECT_EQ(double_of_text("9007199254740993.000000000000000000001"), 9007199254740994.0);
  EXPECT_EQ(double_of_text("4.9406564584124654e-324"), 0x1p-1074);
  EXPECT_TRUE(std::signbit(double_of_text("-0.0").value()));
}

TEST(DoubleOfText, RefusesWhatIsNoDecimal) {
  for (const char* text :
       {"", "-", ".", "+1", " 1", "1 ", "0x10", "inf", "nan", "1e", "1e+", "1,5", "1..2", "--1"})
    EXPECT_FALSE(double_of_text(text).has_value()) << text;
}

TEST(DoubleOfText, RefusesWhatIsBeyondDoubles) {
  for (const char* text : {"1e999", "-2e308", "1e-999", "-1e-400"})
    EXPECT_FALSE(double_of_text(text).has_value()) << text;
  EXPECT_EQ(double_of_text("0e999"), 0.0);
  EXPECT_EQ(double_of_text("0.000e-999"), 0.0);
}

}  // namespace
}  // namespace lekalo::base_double_of_text_test
