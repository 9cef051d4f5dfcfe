#include "lekalo/io/formats/part_file.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lekalo::io::io_part_file_test {
namespace {

/// A page of 200 mm x 100 mm in millimetres, with nothing filled unless it is said.
std::string page(const std::string& content) {
  return R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" )"
         R"(width="200mm" height="100mm" viewBox="0 0 200 100"><g id="cut" fill="none" stroke="red">)" +
         content + "</g></svg>";
}
std::string square(double x, double y, double side, const std::string& more = "") {
  return fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" {}/>)", x, y, side, side, more);
}

PartsFile read(const std::string& content, const PartOptions& options = {}) {
  auto file = read_parts(page(content), "folder/side_panel.svg", options);
  EXPECT_TRUE(file.has_value()) << (file ? "" : file.error().message);
  return file ? *std::move(file) : PartsFile{};
}

std::string told(const PartsFile& file) {
  std::string text;
  for (const layout::Part& part : file.parts)
    text += fmt::format("{}={} \"{}\" {} holes {} marks, ", part.id, part.demand, part.name,
                        part.outline.polygon.loops() - 1, part.marks.size());
  return text;
}

std::string told_notices(const PartsFile& file) {
  std::string text;
  for (const std::string& notice : file.notices) text += notice + "\n";
  return text;
}

TEST(PartFile, PartsAreCalledAfterTheFileAndNamedByLayerAndLabel) {
  EXPECT_EQ(told(read(square(0, 0, 10) + square(20, 0, 11, "id='r1'") +
                      square(40, 0, 12, "id='r2' inkscape:label='lid'"))),
            "side_panel=1 \"cut\" 0 holes 0 marks, side_panel-2=1 \"cut, r1\" 0 holes 0 marks, "
            "side_panel-3=1 \"cut, lid\" 0 holes 0 marks, ");
}

TEST(PartFile, EqualOutlinesAreOnePartWantedAsOften) {
  const std::string hole = R"(<circle cx="5" cy="5" r="2"/>)", moved = R"(<circle cx="25.1" cy="5" r="2"/>)";
  EXPECT_EQ(told(read(square(0, 0, 10) + hole + square(20.1, 0, 10) + moved + square(40.3, 0, 10) +
                      square(60, 0, 10.001) + square(80.7, 0.1, 10))),
            "side_panel=2 \"cut\" 1 holes 0 marks, side_panel-2=2 \"cut\" 0 holes 0 marks, "
            "side_panel-3=1 \"cut\" 0 holes 0 marks, ");
  // A turned copy lies otherwise to the grain, so it stays a part of its own.
  EXPECT_EQ(told(read(R"(<path d="M0 0H20V10Z"/><path d="M50 0V20H40Z"/><path d="M80 0H100V10Z"/>)")),
            "side_panel=2 \"cut\" 0 holes 0 marks, side_panel-2=1 \"cut\" 0 holes 0 marks, ");
}

TEST(PartFile, ACrackThatClosesAlongATangentLeavesAPartOfLines) {
  // The arc runs back along the line before it, as a box maker draws the tip of a triangle: chords outside of
  // The arc leaves its corner along the line before it, and chords outside of it cross that line however fine
  // they are.
  const PartsFile file = read(R"(<path d="M0 0H20V10A10 10 0 0 1 22 4H40V12H0Z"/>)");
  ASSERT_EQ(file.parts.size(), 1u);
  EXPECT_TRUE(file.set_aside.empty());
  EXPECT_TRUE(file.parts[0].outline.curves.empty()) << "lines, within the tolerance that is told";
  EXPECT_NE(told_notices(file).find("1 parts became lines"), std::string::npos) << told_notices(file);
  EXPECT_NE(told_notices(file).find("outlines are within"), std::string::npos) << told_notices(file);
}

TEST(PartFile, ACrackThatChordsCloseLeavesNoHole) {
  // A box maker goes along the quarter of a corner and back: between chords beside the two arcs 0.05 mm of
  // the crack were left.
  const PartsFile file =
      read(R"(<path d="M0 0V20H40V10C40 10.056 39.955 10.1 39.9 10.1C39.955 10.1 40 10.056 40 10V0Z"/>)");
  EXPECT_EQ(told(file), "side_panel=1 \"cut\" 0 holes 1 marks, ");
  EXPECT_NE(told_notices(file).find("outlines are within"), std::string::npos) << told_notices(file);
}

TEST(PartFile, LinesThatBoundNothingAreMarksOfTheirPart) {
  const PartsFile file = read(square(0, 0, 10) + R"(<path d="M2 2H8" stroke="blue"/>)" + square(20, 0, 10) +
                              R"(<path d="M22 2H28" stroke="blue"/>)" + square(40, 0, 10) +
                              R"(<path d="M42 3H48"/><path d="M90 2H95"/>)");
  EXPECT_EQ(told(file), "side_panel=2 \"cut\" 0 holes 1 marks, side_panel-2=1 \"cut\" 0 holes 1 marks, ");
  ASSERT_EQ(file.set_aside.size(), 1u);
  EXPECT_NE(file.set_aside[0].find("lies on no part"), std::string::npos) << file.set_aside[0];
  EXPECT_NE(file.set_aside[0].find("(90, 98)"), std::string::npos) << file.set_aside[0];
  const geom::Edge& line = file.parts.at(0).marks.at(0).edges.at(0);
  EXPECT_EQ(line.from.x, 2);
  EXPECT_EQ(line.to.x, 8);
}

TEST(PartFile, WhatIsFilledBesideLinesThatAreNotIsEngraving) {
  const std::string filled = "stroke='none' fill='black'";
  const PartsFile file =
      read(square(0, 0, 30) + square(5, 5, 6, filled) + square(15, 5, 6) + square(60, 0, 5, filled));
  EXPECT_EQ(told(file), "side_panel=1 \"cut\" 1 holes 1 marks, ");
  EXPECT_EQ(file.set_aside.size(), 1u) << "a filled shape beside all plates";
  // A page that is filled holds lines, so it is none of it; and where all is filled nothing is engraving.
  EXPECT_EQ(told(read(square(0, 0, 90, filled) + square(5, 5, 30))),
            "side_panel=1 \"cut\" 1 holes 0 marks, ");
  EXPECT_EQ(read(square(0, 0, 9, filled) + square(20, 5, 8, filled)).parts.size(), 2u);
}

TEST(PartFile, PartsInHolesOfAnotherColourAreTold) {
  // A square to be engraved around a round hole: by the lines alone the square is a hole, and the circle a
  // disc in it.
  const auto plate = [](const std::string& colour) {
    return square(0, 0, 30) + square(10, 10, 10, "stroke='" + colour + "'") +
           R"(<circle cx="15" cy="15" r="2"/>)";
  };
  const PartsFile doubted = read(plate("lime"));
  EXPECT_EQ(told(doubted), "side_panel=1 \"cut\" 1 holes 0 marks, side_panel-2=1 \"cut\" 0 holes 0 marks, ");
  EXPECT_EQ(told_notices(doubted),
            "folder/side_panel.svg: 1 part lies in a hole drawn in '#00ff00', the first is the circle at "
            "line 1, layer "
            "'cut'; if that is only engraved, name the others as the layers to take\n");
  PartOptions options;
  options.drawing.take = {"#ff0000"};
  EXPECT_EQ(told(read(plate("lime"), options)), "side_panel=1 \"cut\" 1 holes 0 marks, ");
  EXPECT_EQ(told_notices(read(plate("red"))), "");
}

TEST(PartFile, RowsOfLettersAreEngraving) {
  const std::string plate = square(0, 0, 100), o = square(10, 10, 5) + square(12, 12, 1);
  const std::string two = square(17, 10, 5) + square(24, 11, 4);
  EXPECT_EQ(told(read(plate + o + two + square(60, 60, 5))), "side_panel=1 \"cut\" 1 holes 4 marks, ");
  // Two cut-outs are no row, and a row without an island is one of holes.
  EXPECT_EQ(told(read(plate + o + square(17, 10, 5))),
            "side_panel=1 \"cut\" 2 holes 0 marks, side_panel-2=1 \"cut\" 0 holes 0 marks, ");
  EXPECT_EQ(told(read(plate + square(10, 10, 5) + two)), "side_panel=1 \"cut\" 3 holes 0 marks, ");
}

TEST(PartFile, EachThatIsSetAsideIsToldOnceAndOfMoreThanAThousandTheNumber) {
  const auto told_aside = [](int lines) {
    std::string content = square(0, 0, 10);
    for (int k = 0; k < lines; ++k) content += fmt::format(R"(<path d="M{} 50l0.05 2"/>)", 0.1 * k);
    const PartsFile file = read(content);
    EXPECT_EQ(file.set_aside.size(), static_cast<std::size_t>(lines));
    std::vector<std::string> aside;
    for (const std::string& notice : file.notices)
      if (notice.find("set aside: ") == 0) aside.push_back(notice);
    return aside;
  };
  EXPECT_EQ(told_aside(30).size(), 30u);
  const auto many = told_aside(1200);
  ASSERT_EQ(many.size(), 1001u);
  EXPECT_EQ(many.back(), "set aside: 200 more");
}

TEST(PartFile, DamagedElementsAreOnTheListAndRefusedWhereItIsStrict) {
  const std::string content = square(0, 0, 10) + R"(<path id="p9" d="M 1 1 L x"/>)";
  const PartsFile file = read(content);
  EXPECT_EQ(file.parts.size(), 1u);
  ASSERT_EQ(file.set_aside.size(), 1u);
  EXPECT_NE(file.set_aside[0].find("path 'p9'"), std::string::npos);
  PartOptions strict;
  strict.drawing.strict = true;
  const auto refused = read_parts(page(content), "a.svg", strict);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("path 'p9'"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::io::io_part_file_test
