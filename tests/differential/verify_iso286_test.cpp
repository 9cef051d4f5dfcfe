// Limits of ISO 286. Makers and checker have tables from different sources, and code of their own; here every
// class at every size is compared. The sources differ in few entries, which a third decides: see
// docs/design/fit.md, "Limits".

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cmath>
#include <string>

#include "lekalo/fit/iso286.hpp"
#include "verify/fit/iso286.hpp"

namespace lekalo::verify_iso286_test {
namespace {

using fit::limits_of;

constexpr std::array kZones{"a", "b", "c", "cd", "d", "e", "ef", "f", "fg", "g", "h", "js", "j",  "k",
                            "m", "n", "p", "r",  "s", "t", "u",  "v", "x",  "y", "z", "za", "zb", "zc"};

std::string capital(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

TEST(VerifyIso286, MakersAndCheckerHaveTheSameLimits) {
  int known = 0;
  for (const double size :
       {0.5,   1.0,   2.0,   3.0,   3.001, 6.0,   8.0,   10.0,  12.0,  14.0,  16.0,  18.0,  19.0,
        24.0,  25.0,  30.0,  35.0,  40.0,  45.0,  50.0,  60.0,  65.0,  70.0,  80.0,  90.0,  100.0,
        110.0, 120.0, 130.0, 140.0, 150.0, 160.0, 170.0, 180.0, 190.0, 200.0, 210.0, 225.0, 240.0,
        250.0, 260.0, 280.0, 300.0, 315.0, 330.0, 355.0, 400.0, 420.0, 450.0, 475.0, 500.0})
    for (const std::string zone : kZones)
      for (const std::string& letters : {zone, capital(zone)})
        for (int grade = -1; grade <= 18; ++grade) {
          const std::string name = letters + (grade < 0 ? "01" : std::to_string(grade));
          const auto ours = limits_of(size, name);
          const auto theirs = verify::iso286_limits(size, name);
          ASSERT_EQ(ours.has_value(), theirs.has_value()) << size << name;
          if (!ours) continue;
          ++known;
          ASSERT_EQ(ours->lower_um, theirs->lower) << size << name;
          ASSERT_EQ(ours->upper_um, theirs->upper) << size << name;
          ASSERT_LT(ours->lower_um, ours->upper_um) << size << name;
        }
  EXPECT_GT(known, 30000);
}

TEST(VerifyIso286, ClassesThatAreNoneHaveNoLimits) {
  for (const char* name : {"",    "8",   "H",   "h",    "H08", "H8 ", " H8", "Hh8", "hH8", "JSs8", "jS8",
                           "Js8", "H19", "H02", "H1e1", "w8",  "W8",  "i8",  "l8",  "o8",  "q8",   "zd8",
                           "ZD8", "Za8", "zA8", "zz8",  "t7",  "y6",  "v6",  "T7",  "CD8", "EF8",  "FG8",
                           "Cd8", "cD8", "z",   "Z",    "J9",  "j9",  "J5",  "j4",  "K-8", "H+8",  "H8/z8"}) {
    EXPECT_EQ(verify::iso286_limits(12, name), std::nullopt) << name;
  }
  for (const double size : {0.0, -1.0, 500.001, 1e9, static_cast<double>(NAN)})
    EXPECT_EQ(verify::iso286_limits(size, "H7"), std::nullopt) << size;
  for (const double size : {1e-9, 1.0, 500.0}) EXPECT_TRUE(verify::iso286_limits(size, "H7")) << size;
}

}  // namespace
}  // namespace lekalo::verify_iso286_test
