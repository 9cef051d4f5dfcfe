// Feeds as programs say them.

#include "lekalo/nc/program_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace lekalo::nc::nc_program_writer_test {
namespace {

TEST(NcProgramWriter, UsualFeedsHaveTheUsualDecimals) {
  const ProgramWriter mm(posts().front(), LengthUnit::millimetre, 4),
      inch(posts().front(), LengthUnit::inch, 5);
  EXPECT_EQ(mm.feed(600, 2), " F600.0");
  EXPECT_EQ(mm.feed(0.5, 2), " F0.5");
  EXPECT_EQ(inch.feed(600, 2), " F23.62");
  EXPECT_EQ(inch.feed(600, 3), " F23.622");
}

TEST(NcProgramWriter, NoFeedIsRoundedAway) {
  const ProgramWriter mm(posts().front(), LengthUnit::millimetre, 4),
      inch(posts().front(), LengthUnit::inch, 5);
  EXPECT_EQ(inch.feed(0.1, 2), " F0.0039");
  EXPECT_EQ(mm.feed(0.02, 2), " F0.02");
  for (double feed = 1e-3; feed < 1e6; feed *= 1.37) {
    EXPECT_NEAR(std::stod(mm.feed(feed, 2).substr(2)), feed, 0.01 * feed);
    for (const int decimals : {2, 3})
      EXPECT_NEAR(25.4 * std::stod(inch.feed(feed, decimals).substr(2)), feed, 0.01 * feed) << decimals;
  }
}

}  // namespace
}  // namespace lekalo::nc::nc_program_writer_test
