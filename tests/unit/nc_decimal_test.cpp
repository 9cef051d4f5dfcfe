#include "lekalo/nc/decimal.hpp"

#include <gtest/gtest.h>

namespace lekalo::nc_decimal_test {
namespace {

using namespace nc;
using lekalo::LengthUnit;

std::string round_trip(std::string_view text) {
  const auto parsed = parse_decimal(text).value;
  return parsed ? format_decimal(parsed->digits, parsed->decimals) : "none";
}

TEST(NcDecimal, ReadsPlainNumbersWithTheirDecimals) {
  EXPECT_EQ(round_trip("0"), "0");
  EXPECT_EQ(round_trip("12.50"), "12.50");
  EXPECT_EQ(round_trip("+.5"), "0.5");
  EXPECT_EQ(round_trip("-7."), "-7");
  EXPECT_EQ(round_trip("-0.0"), "0.0");
  EXPECT_EQ(round_trip("000000000000000000000001.5"), "1.5");
  EXPECT_EQ(round_trip("999999999999999999"), "999999999999999999");
}

TEST(NcDecimal, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "+", "-", ".", "1.2.3", "1e5", "--1", "1-", "1 2"})
    EXPECT_EQ(round_trip(text), "none") << text;
  EXPECT_EQ(parse_decimal("1.2.3").fault, DecimalFault::malformed);
  EXPECT_EQ(parse_decimal("1234567890123456789").fault, DecimalFault::too_long);
  EXPECT_EQ(parse_decimal("0.0000000000000000001").fault, DecimalFault::too_long);
}

TEST(NcDecimal, KnowsWholeNumbers) {
  EXPECT_EQ(parse_decimal("54.0").value->whole(), 54);
  EXPECT_EQ(parse_decimal("-3").value->whole(), -3);
  EXPECT_FALSE(parse_decimal("59.3").value->whole().has_value());
}

TEST(NcDecimal, MeasuresLengthsExactly) {
  const Grains millimetre = quantum(LengthUnit::millimetre, 0);
  EXPECT_EQ(to_grains(*parse_decimal("25.4").value, LengthUnit::millimetre),
            to_grains(*parse_decimal("1").value, LengthUnit::inch));
  EXPECT_EQ(to_grains(*parse_decimal("0.1").value, LengthUnit::millimetre) * 10, millimetre);
  EXPECT_EQ(quantum(LengthUnit::millimetre, kMaxDecimals), 10);
  EXPECT_EQ(quantum(LengthUnit::inch, kMaxDecimals), 254);
  EXPECT_EQ(static_cast<double>(millimetre), kGrainsPerMillimetre);
}

TEST(NcDecimal, WritesFixedDecimalsAndNoNegativeZero) {
  EXPECT_EQ(format_decimal(0, 5), "0.00000");
  EXPECT_EQ(format_decimal(-5, 5), "-0.00005");
  EXPECT_EQ(format_decimal(-1234567, 5), "-12.34567");
  EXPECT_EQ(format_decimal(42, 0), "42");
}

}  // namespace
}  // namespace lekalo::nc_decimal_test
