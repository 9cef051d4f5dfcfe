#include <gtest/gtest.h>

#include <string>

#include "lekalo/draw/picture.hpp"
#include "support/cases.hpp"

namespace lekalo::test::picture_png_test {
namespace {

draw::PictureOfRings& rings(draw::LocatePicture& picture) {
  return std::get<draw::PictureOfRings>(picture.outlines);
}

draw::LocatePicture example() {
  const auto one = cases::published_examples()[0];
  draw::LocatePicture picture;
  picture.title = "lekalo locate";
  picture.part_name = "part.csv";
  picture.blank_name = "blank.csv";
  picture.status = "optimal";
  rings(picture).part = one.part().vertices();
  rings(picture).blank = one.blank().vertices();
  picture.result = {3.645792, 15.392857, 0, 0.94692};
  picture.upper_bound = 0.94693;
  rings(picture).contacts = {{2, 1, 0}, {3, 3, 0}, {9, 8, 0}};
  return picture;
}

std::string png(const draw::LocatePicture& picture, int width = 1600) {
  auto bytes = draw::picture_png(picture, width);
  EXPECT_TRUE(bytes.has_value());
  return bytes ? *bytes : "";
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = (value << 8) | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

TEST(PicturePng, IsAPngOfTheWidthAskedFor) {
  for (const int width : {1600, 100, 833}) {
    const std::string bytes = png(example(), width);
    ASSERT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    ASSERT_EQ(bytes.substr(12, 4), "IHDR");
    EXPECT_EQ(big_endian(bytes, 16), static_cast<std::uint32_t>(width));
    EXPECT_NEAR(big_endian(bytes, 20), width * 160.0 / 250.0, 0.51);
    EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND");
  }
  EXPECT_GT(png(example()).size(), 20'000u);
}

TEST(PicturePng, GivesTheSameBytesEveryTime) { EXPECT_EQ(png(example()), png(example())); }

TEST(PicturePng, RefusesAWidthThatCannotBeDrawn) {
  for (const int width : {-1, 0, 99, 20'001}) {
    const auto refused = draw::picture_png(example(), width);
    ASSERT_FALSE(refused.has_value()) << width;
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
    EXPECT_NE(refused.error().message.find(std::to_string(width)), std::string::npos);
  }
}

TEST(PicturePng, DrawsCyrillicLettersAndNotBoxes) {
  // Without letters of its own a font shows the same box for each.
  draw::LocatePicture one = example(), other = example();
  one.part_name = "гггг";
  other.part_name = "дддд";
  EXPECT_NE(png(one), png(other)) << "no font with Cyrillic letters is installed (package fonts-dejavu-core)";
}

TEST(PicturePng, ShowsWhatThePictureHolds) {
  draw::LocatePicture moved = example(), without_contacts = example();
  moved.result.x += 0.5;
  rings(without_contacts).contacts.clear();
  const std::string before = png(example());
  EXPECT_NE(png(moved), before);
  EXPECT_NE(png(without_contacts), before);
}

TEST(PicturePng, NamesMayHoldAnything) {
  draw::LocatePicture picture = example();
  picture.part_name = std::string("a\xff\x01") + "\xed\xa0\x80" + std::string(500, 'W');
  EXPECT_EQ(png(picture).substr(1, 3), "PNG");
}

}  // namespace
}  // namespace lekalo::test::picture_png_test
