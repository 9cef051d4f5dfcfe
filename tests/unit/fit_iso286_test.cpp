// Limits of ISO 286 as the makers have them: J. Wismeth, ITRechner (passungen.h), with the grades of
// Narayana, Kannaiah and Venkata Reddy, Machine Drawing, tables 15.1 to 15.3. The test
// differential.verify_iso286 holds them against the checker's, of another source.

#include "lekalo/fit/iso286.hpp"

#include <gtest/gtest.h>

namespace lekalo::fit_iso286_test {
namespace {

using fit::limits_of;

struct Printed {
  double size;
  const char* name;
  double lower, upper;
};

TEST(Iso286, LimitsArePrintedOnes) {
  // Machine Drawing, table 15.3, "P to ZC" and "A to N", sizes above 120, with its tables 15.1 and 15.2.
  for (const Printed& p : {Printed{18, "H8", 0, 27},   {18, "z8", 60, 87},        {20, "z8", 73, 106},
                           {30, "z8", 88, 121},        {30, "H8", 0, 33},         {20, "P7", -35, -14},
                           {280, "M6", -41, -9},       {130, "J7", -14, 26},      {130, "K8", -43, 20},
                           {130, "N9", -100, 0},       {260, "zc11", 1550, 1870}, {260, "ZC11", -1870, -1550},
                           {210, "X8", -457, -385},    {210, "V7", -339, -293},   {50, "k6", 2, 18},
                           {50, "k8", 0, 39},          {2, "j8", -6, 8},          {50, "js7", -12.5, 12.5},
                           {500, "a11", -2050, -1650}, {2, "cd6", -40, -34}}) {
    const auto found = limits_of(p.size, p.name);
    ASSERT_TRUE(found) << p.name;
    EXPECT_EQ(found->lower_um, p.lower) << p.size << p.name;
    EXPECT_EQ(found->upper_um, p.upper) << p.size << p.name;
  }
}

// The source of the module gives 40 and 121 um to H8/z8 "at 18". They are the extremes over the sizes from 18
// to 30.
TEST(Iso286, FortyAndHundredTwentyOneBelongToTheWholeRangeAbove18) {
  EXPECT_EQ(fit::read_fit("18H8/z8")->least_um, 33);
  EXPECT_EQ(fit::read_fit("18H8/z8")->greatest_um, 87);
  EXPECT_EQ(fit::read_fit("18.001H8/z8")->least_um, 40);
  EXPECT_EQ(fit::read_fit("30H8/z8")->greatest_um, 121);
}

TEST(Iso286, WhatTheTablesLackIsRefusedWithTheWayOut) {
  for (const char* text : {"18H8/t7", "501H7/p6", "0H7/p6", "18CD8/p6", "20K9/h6", "18H8/y6", "1H14/p6"}) {
    const auto fit = fit::read_fit(text);
    ASSERT_FALSE(fit) << text;
    EXPECT_EQ(fit.error().code, ErrorCode::bad_input);
    EXPECT_NE(fit.error().message.find("--interference"), std::string::npos) << fit.error().message;
  }
  for (const char* text : {"", "18", "18H8", "H8/z8", "18z8/H8", "18H8z8", "18H/z8", "18H19/z8", "18H08/z8",
                           "18Hh8/z8", "18H8/", "18W8/z8", "18H8/zd8", "18H8/z8 "})
    EXPECT_FALSE(fit::read_fit(text)) << text;
}

}  // namespace
}  // namespace lekalo::fit_iso286_test
