#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lekalo/io/dxf/dxf.hpp"

/// Texts of DXF drawings: TEXT, MTEXT, and ATTRIB of an INSERT.
namespace lekalo::io::io_dxf_texts_test {
namespace {

std::string groups(std::initializer_list<std::pair<int, std::string>> list) {
  std::string text;
  for (const auto& [code, value] : list) text += fmt::format("{}\n{}\n", code, value);
  return text;
}

Drawing read(const std::string& entities, const std::string& blocks = "") {
  const std::string file = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n" +
                           (blocks.empty() ? "" : "0\nSECTION\n2\nBLOCKS\n" + blocks + "0\nENDSEC\n") +
                           "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
  auto drawing = parse_dxf(file, "a.dxf");
  EXPECT_TRUE(drawing.has_value()) << (drawing ? "" : drawing.error().message);
  return drawing ? *std::move(drawing) : Drawing{};
}

/// "letters at x,y height degrees" and what is unusual, a line for each.
std::string told(const Drawing& drawing) {
  std::string text;
  for (const ReadText& one : drawing.texts) {
    const auto round = [](double v) { return std::round(v * 1000) / 1000 + 0.0; };
    text += fmt::format("{} at {},{} {} {}", one.text, round(one.at.x), round(one.at.y), round(one.height),
                        round(one.degrees));
    if (round(one.width_factor) != 1) text += fmt::format(" wide {}", round(one.width_factor));
    if (one.mirrored) text += " backwards";
    if (one.anchor != ReadText::Anchor::left)
      text += one.anchor == ReadText::Anchor::middle ? " middle" : " right";
    text += fmt::format(" on {}{}\n", one.layer.name, one.layer.colour);
  }
  return text;
}

const std::string kText = groups({{0, "TEXT"}, {8, "T"}, {62, "1"}, {10, "5"}, {20, "7"}, {40, "2"}});

TEST(DxfTexts, ATextHasItsPlaceHeightAngleAndColour) {
  EXPECT_EQ(told(read(kText + groups({{1, "A-7"}, {50, "30"}}))), "A-7 at 5,7 2 30 on T#ff0000\n");
  EXPECT_EQ(told(read(kText + groups({{1, "%%c8 %%p0.1 90%%d 100%%"}, {41, "0.8"}}))),
            "Ø8 ±0.1 90° 100%% at 5,7 2 0 wide 0.8 on T#ff0000\n");
  EXPECT_EQ(told(read(kText + groups({{1, "x"}, {71, "2"}}))), "x at 5,7 2 0 backwards on T#ff0000\n");
  EXPECT_EQ(told(read(kText + groups({{1, "x"}, {71, "4"}}))), "x at 5,7 2 180 backwards on T#ff0000\n");
  EXPECT_EQ(told(read(kText + groups({{1, "\\U+0416\\U+0443\\U+043a"}}))), "Жук at 5,7 2 0 on T#ff0000\n");
}

TEST(DxfTexts, AnchorsAreWhereTheFileSays) {
  const auto anchored = [](const char* across, const char* upward) {
    return told(
        read(kText + groups({{1, "x"}, {72, across}, {73, upward}, {11, "20"}, {21, "30"}, {50, "90"}})));
  };
  EXPECT_EQ(anchored("1", "0"), "x at 20,30 2 90 middle on T#ff0000\n");
  EXPECT_EQ(anchored("2", "3"), "x at 22,30 2 90 right on T#ff0000\n");
  EXPECT_EQ(anchored("0", "2"), "x at 21,30 2 90 on T#ff0000\n");
  EXPECT_EQ(anchored("4", "0"), "x at 21,30 2 90 middle on T#ff0000\n");
  EXPECT_EQ(anchored("5", "0"), fmt::format("x at 5,7 2 {} on T#ff0000\n", 56.889)) << "from point to point";
}

TEST(DxfTexts, AnMtextIsItsLines) {
  const std::string mtext =
      groups({{0, "MTEXT"}, {8, "0"}, {10, "10"}, {20, "20"}, {40, "3"}, {41, "0"}, {71, "1"}});
  EXPECT_EQ(told(read(mtext + groups({{3, "{\\fArial|b0;one}\\Pt"}, {1, "wo \\S1/2; \\{x\\}"}}))),
            "one at 10,17 3 0 on 0\ntwo 1/2 {x} at 10,12 3 0 on 0\n");
  // The direction of the x axis may stand for an angle; columns have codes of their own behind 75.
  EXPECT_EQ(told(read(mtext + groups({{1, "up"}, {11, "0"}, {21, "1"}, {75, "1"}, {50, "77"}}))),
            "up at 13,20 3 90 on 0\n");
  EXPECT_EQ(told(read(groups({{0, "MTEXT"},
                              {8, "0"},
                              {10, "0"},
                              {20, "0"},
                              {40, "21"},
                              {41, "60"},
                              {71, "8"},
                              {1, "II III IIIIIII"}}))),
            "II III at 0,35 21 0 middle on 0\nIIIIIII at 0,0 21 0 middle on 0\n");
}

TEST(DxfTexts, BlocksTakeTheirTextsAlong) {
  const std::string block =
      groups({{0, "BLOCK"}, {2, "B"}, {70, "0"}, {10, "0"}, {20, "0"}}) +
      groups({{0, "TEXT"}, {8, "0"}, {62, "0"}, {10, "1"}, {20, "0"}, {40, "2"}, {1, "in"}}) +
      groups({{0, "ATTDEF"}, {8, "0"}, {10, "1"}, {20, "0"}, {40, "2"}, {1, "no"}}) + groups({{0, "ENDBLK"}});
  const std::string insert =
      groups({{0, "INSERT"}, {8, "L"}, {62, "3"}, {66, "1"}, {2, "B"}, {10, "100"}, {20, "50"}});
  const std::string attribute = groups({{0, "ATTRIB"},
                                        {8, "A"},
                                        {10, "101"},
                                        {20, "52"},
                                        {40, "4"},
                                        {1, "N7"},
                                        {2, "TAG"},
                                        {70, "0"},
                                        {74, "2"},
                                        {11, "101"},
                                        {21, "52"}}) +
                                groups({{0, "SEQEND"}});
  EXPECT_EQ(told(read(insert + groups({{41, "2"}, {42, "2"}, {50, "90"}}) + attribute, block)),
            "N7 at 101,50 4 0 on A\nin at 100,52 4 90 on L#00ff00\n");
  EXPECT_EQ(told(read(insert + groups({{41, "-1"}, {42, "1"}}), block)),
            "in at 99,50 2 0 backwards on L#00ff00\n");
  EXPECT_EQ(told(read(insert + groups({{41, "1"}, {42, "3"}, {70, "2"}, {44, "10"}}), block)),
            "in at 101,50 6 0 wide 0.333 on L#00ff00\nin at 111,50 6 0 wide 0.333 on L#00ff00\n");
}

TEST(DxfTexts, WhatDrawsNothingIsCounted) {
  const Drawing drawing =
      read(groups({{0, "TEXT"}, {8, "T"}, {10, "5"}, {20, "7"}, {40, "0"}, {1, "x"}}) +
           groups({{0, "ATTRIB"}, {8, "T"}, {10, "5"}, {20, "7"}, {40, "1"}, {70, "1"}, {1, "x"}}) +
           groups({{0, "TEXT"}, {8, "T"}, {40, "1"}, {1, "x"}}) + kText + groups({{1, "  "}}));
  EXPECT_TRUE(drawing.texts.empty());
  std::string unread;
  for (const Unread& one : drawing.unread) unread += fmt::format("{} {}, ", one.name, one.count);
  EXPECT_EQ(unread, "ATTRIB (invisible) 1, TEXT (damaged) 1, TEXT (of no height) 1, ");
  ASSERT_EQ(drawing.damaged.size(), 1U);
  EXPECT_NE(drawing.damaged[0].find("has no place"), std::string::npos) << drawing.damaged[0];
}

}  // namespace
}  // namespace lekalo::io::io_dxf_texts_test
