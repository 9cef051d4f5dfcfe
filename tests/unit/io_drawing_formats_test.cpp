// Every recogniser of files asks one list of formats.

#include "lekalo/io/formats/drawing_formats.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "lekalo/io/formats/any_layout.hpp"
#include "lekalo/io/formats/outline_file.hpp"

namespace lekalo::io::io_drawing_formats_test {
namespace {

std::vector<FileFormat> all_formats() {
  std::vector<FileFormat> all{kPointsFormat, kJsonFormat, kPlyFormat, kStlFormat, kObjFormat};
  for (const DrawingFormat& format : drawing_formats()) all.push_back(format.file);
  return all;
}

TEST(DrawingFormats, NoEndingAndNoFirstByteBelongsToTwoFormats) {
  std::set<std::string_view> endings;
  std::set<char> bytes;
  for (const FileFormat& format : all_formats()) {
    for (const std::string_view ending : format.endings) {
      if (ending.empty()) continue;
      EXPECT_EQ(ending.front(), '.') << format.name;
      EXPECT_TRUE(endings.insert(ending).second) << ending;
    }
    for (const char byte : format.first_bytes) EXPECT_TRUE(bytes.insert(byte).second) << byte;
  }
}

TEST(DrawingFormats, EachIsFoundByItsEndingsAndItsFirstBytes) {
  for (const DrawingFormat& format : drawing_formats()) {
    for (const std::string_view ending : format.file.endings) {
      if (ending.empty()) continue;
      EXPECT_EQ(drawing_format_by_ending("a" + std::string(ending)), &format) << ending;
    }
    for (const char byte : format.file.first_bytes)
      EXPECT_EQ(drawing_format_by_content(std::string("\xef\xbb\xbf\n ") + byte), &format)
          << format.file.name;
  }
  EXPECT_EQ(drawing_format_by_ending("a.DXF"), &drawing_formats().front());
  for (const char* const name : {"", "dxf", "a.json", "a.", "folder.dxf/a"})
    EXPECT_EQ(drawing_format_by_ending(name), nullptr) << name;
  for (const char* const bytes : {"", " \n", "{", "?"})
    EXPECT_EQ(drawing_format_by_content(bytes), nullptr) << bytes;
}

TEST(DrawingFormats, ARefusalNamesAllOfThem) {
  const auto none = read_any_layout("?", "a.bin");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find(drawing_names(", ", " and ") + " drawings"), std::string::npos);
}

TEST(DrawingFormats, OutlinesAreReadByTheReaderThatTheEndingNames) {
  for (const DrawingFormat& format : drawing_formats()) {
    const auto said = format.parse("?", "a", std::nullopt);
    ASSERT_FALSE(said);
    const std::string name = "a" + std::string(format.file.endings[0]);
    const auto read = read_outline("?", name, {});
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message, name + said.error().message.substr(1));
  }
}

}  // namespace
}  // namespace lekalo::io::io_drawing_formats_test
