#include "lekalo/base/line_font.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace lekalo::base_line_font_test {
namespace {

std::u32string letters_of(std::string_view text) {
  std::u32string letters;
  while (!text.empty()) letters += take_code_point(text);
  return letters;
}

TEST(LineFont, LettersOfLatinAndCyrillicAreThere) {
  const std::string alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789.,:;!?()[]{}<>/\\|+-*=_^~'\"#$%&@`"
      "АБВГДЕЁЖЗИЙКЛМНОПРСТУФХЦЧШЩЪЫЬЭЮЯабвгдеёжзийклмнопрстуфхцчшщъыьэюяÄÖÜäöüß°±×Øø№µ";
  for (const char32_t code : letters_of(alphabet)) {
    const auto letter = line_letter(code);
    ASSERT_TRUE(letter.has_value()) << static_cast<unsigned>(code);
    EXPECT_GT(letter->width, 0);
    ASSERT_FALSE(letter->strokes.empty()) << static_cast<unsigned>(code);
    for (const auto& stroke : letter->strokes) EXPECT_GE(stroke.size(), 2U) << static_cast<unsigned>(code);
  }
  EXPECT_TRUE(line_letter(U' ')->strokes.empty());
}

TEST(LineFont, CapitalsStandOnTheBaselineAndAreOneHigh) {
  for (const char32_t code : letters_of("ABEHIKLMNTXZАБВГЕЖИКМНПТХЧШЫЬЯ")) {
    int low = 100, high = -100;
    const auto letter = line_letter(code);
    ASSERT_TRUE(letter.has_value());
    for (const auto& stroke : letter->strokes)
      for (const auto& [x, y] : stroke) low = std::min(low, y), high = std::max(high, y);
    EXPECT_EQ(low, 0) << static_cast<unsigned>(code);
    EXPECT_EQ(high, kLineFontCapital) << static_cast<unsigned>(code);
  }
}

TEST(LineFont, LettersThatAreMissingAreNone) {
  EXPECT_FALSE(line_letter(U'中'));
  EXPECT_FALSE(line_letter(0));
  EXPECT_FALSE(line_letter(0x7f));
  EXPECT_FALSE(line_letter(0xfffd));
}

TEST(LineFont, CodePointsAreTakenOneByOne) {
  EXPECT_EQ(letters_of("aЖ中\xf0\x9f\x91\x9e"), U"aЖ中\U0001f45e");
  EXPECT_EQ(letters_of("\xff\xc3"), U"\xfffd\xfffd");
  EXPECT_EQ(letters_of("\xe4\xb8z"), U"\xfffd\xfffdz");
}

}  // namespace
}  // namespace lekalo::base_line_font_test
