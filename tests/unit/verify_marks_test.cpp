#include <fmt/core.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/marked_layouts.hpp"

/// Lines and texts on parts in exports and programs, as the checker judges them.
namespace lekalo::verify::verify_marks_test {
namespace {

using cases::Json;

Json sample() {
  Json layout = cases::empty_layout();
  cases::add_marked_plate(layout, "plate");
  cases::place(layout, "plate", 80, 70, 90)["mirrored"] = true;
  return layout;
}

const std::vector<io::ExportWord> kLaser{
    {"kerf", "0.2"}, {"feed", "1000"}, {"speed", "900"}, {"engrave-feed", "3000"}, {"engrave-speed", "100"}};
const std::vector<io::ExportWord> kRouter{{"process", "router"},   {"kerf", "3"},           {"feed", "1000"},
                                          {"speed", "18000"},      {"depth", "6"},          {"plunge", "300"},
                                          {"engrave-feed", "900"}, {"engrave-depth", "0.3"}};

io::Exported exported(const Json& layout, const std::string& form, const std::vector<io::ExportWord>& words) {
  const auto document = io::read_layout(layout.dump(), "layout");
  if (!document) throw std::logic_error(document.error().message);
  const auto request = io::read_export_words(*io::export_form(form), words, "--");
  if (!request) throw std::logic_error(request.error().message);
  auto made = io::export_layout(document->document, "Sample", *request);
  if (!made) throw std::logic_error(made.error().message);
  return *std::move(made);
}

/// Findings, each on a line; nothing where all is true.
std::string told(const Result<ClaimReport>& report) {
  if (!report) return report.error().message;
  std::string text;
  for (const std::string& finding : report->findings) text += finding + "\n";
  return text;
}
std::string judged(const std::string& bytes, const Json& layout, const ExportWords& words = {}) {
  return told(verify_export({"e", bytes}, {"l.json", layout.dump()}, words));
}
Result<ClaimReport> program_report(const std::string& bytes, const Json& layout, double kerf) {
  ProfileWords words;
  words.kerf_mm = kerf;
  return verify_profile({"p.nc", bytes}, {"l.json", layout.dump()}, words);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error("test input: no " + what);
  return text.replace(at, what.size(), by);
}

TEST(VerifyMarks, WhatIsExportedIsTrue) {
  for (const char* form : {"dxf", "svg", "hpgl"})
    EXPECT_EQ(judged(exported(sample(), form, {}).files[0].bytes, sample()), "") << form;
  ExportWords without;
  without.only = {"CUT", "SHEET"};
  EXPECT_EQ(judged(exported(sample(), "dxf", {{"only", "CUT,SHEET"}}).files[0].bytes, sample(), without), "");
}

TEST(VerifyMarks, ALieInADrawingIsFound) {
  const std::string dxf = exported(sample(), "dxf", {}).files[0].bytes;
  EXPECT_NE(judged(replaced(dxf, "\nN7 ", "\nN8 "), sample()).find("is on no part"), std::string::npos);
  EXPECT_NE(judged(replaced(dxf, "AcDbEntity\n  8\nTXT\n", "AcDbEntity\n  8\nENG\n"), sample()), "");
  EXPECT_NE(judged(replaced(dxf, "\n 71\n     2\n", "\n 71\n     0\n"), sample()), "");
  for (const char* group : {" 60\n     1\n", " 67\n     1\n", "230\n-1.0\n", " 62\n     1\n", " 51\n20.0\n"})
    EXPECT_NE(judged(replaced(dxf, "\n 71\n     2\n", "\n" + std::string(group) + " 71\n     2\n"), sample()),
              "")
        << group;
  const std::string svg = exported(sample(), "svg", {}).files[0].bytes;
  EXPECT_NE(judged(replaced(svg, "a&lt;b", "a&gt;b"), sample()), "");
  EXPECT_NE(judged(replaced(svg, "stroke=\"#ff0000\"", "stroke=\"#00ff00\""), sample()), "");
  // Every mark and text is asked for, and nothing else is.
  for (const char* form : {"dxf", "svg", "hpgl"}) {
    Json more = sample();
    more["parts"][0]["marks"].push_back(
        {{"layer", "ENG"}, {"edges", Json::array({cases::line_json(20, 30, 22, 30)})}});
    EXPECT_NE(judged(exported(sample(), form, {}).files[0].bytes, more), "") << form;
    EXPECT_NE(judged(exported(more, form, {}).files[0].bytes, sample()), "") << form;
    Json moved = sample();
    moved["parts"][0]["texts"][0]["at"][0] = 5.2;
    EXPECT_NE(judged(exported(sample(), form, {}).files[0].bytes, moved), "") << form;
  }
}

TEST(VerifyMarks, AProgramEngravesBeforeItCuts) {
  for (const auto& [words, kerf] : {std::pair(kLaser, 0.2), std::pair(kRouter, 3.0)}) {
    const io::Exported made = exported(sample(), "gcode", words);
    const auto report = program_report(made.files[0].bytes, sample(), kerf);
    EXPECT_EQ(told(report), "") << made.files[0].bytes;
    ASSERT_TRUE(report.has_value());
    EXPECT_EQ(report->notes.back(),
              "5 of 7 lines and texts on the parts are engraved all along, and nothing else");
    EXPECT_NE(made.notes[0].find("5 lines and texts are engraved before them"), std::string::npos)
        << made.notes[0];
    EXPECT_NE(
        made.notes[0].find("2 lines and texts on the parts are not cut: 1 on layer '' (to be cut through, "
                           "but bounding nothing), 1 on layer 'a:b' (bends)"),
        std::string::npos)
        << made.notes[0];
  }
}

TEST(VerifyMarks, MarksMayHaveAToolOfTheirOwn) {
  std::vector<io::ExportWord> words = kRouter;
  words.insert(words.end(), {{"tool", "2"}, {"engrave-tool", "7"}, {"engrave-speed", "9000"}});
  const std::string two = exported(sample(), "gcode", words).files[0].bytes;
  EXPECT_EQ(told(program_report(two, sample(), 3)), "") << two;
  EXPECT_NE(two.find("\nT7 M6\nG43 H7\nG0 Z5.0000\nM3 S9000\n(MARKS"), std::string::npos) << two;
  EXPECT_NE(two.find("\nM5\nT2 M6\nG43 H2\nG0 Z5.0000\nM3 S18000\n(PLACEMENT"), std::string::npos) << two;
  // Another tool in the middle of the cuts has another width.
  const std::size_t last = two.rfind("(PLACEMENT");
  std::string changed = two;
  changed.insert(last, "M5\nT7 M6\nG43 H7\nG0 Z5\nM3 S18000\n");
  EXPECT_NE(told(program_report(changed, sample(), 3)).find(": tool 7 cuts, and line "), std::string::npos)
      << told(program_report(changed, sample(), 3));
  // One tool is changed to once; without marks there is none of theirs.
  words.back().second = "18000", words[words.size() - 2].second = "2";
  const std::string one = exported(sample(), "gcode", words).files[0].bytes;
  EXPECT_EQ(told(program_report(one, sample(), 3)), "");
  EXPECT_EQ(one.find("M6"), one.rfind("M6"));
  Json bare = sample();
  bare["parts"][0].erase("marks"), bare["parts"][0].erase("texts");
  words[words.size() - 2].second = "7";
  const std::string unmarked = exported(bare, "gcode", words).files[0].bytes;
  EXPECT_EQ(told(program_report(unmarked, bare, 3)), "");
  EXPECT_EQ(unmarked.find("T7"), std::string::npos);
  EXPECT_NE(unmarked.find("T2 M6"), std::string::npos);
}

TEST(VerifyMarks, WithoutWordsNothingIsEngraved) {
  const io::Exported made = exported(sample(), "gcode", {{"kerf", "0.2"}, {"feed", "1000"}});
  EXPECT_EQ(told(program_report(made.files[0].bytes, sample(), 0.2)), "");
  EXPECT_NE(made.notes[0].find("2 on layer 'ENG' (without words for engraving)"), std::string::npos)
      << made.notes[0];
}

TEST(VerifyMarks, AnyOtherCutInAPartIsRefused) {
  const std::string program = exported(sample(), "gcode", kLaser).files[0].bytes;
  Json bare = sample();
  bare["parts"][0].erase("marks");
  EXPECT_NE(told(program_report(program, bare, 0.2)).find("the cut begins in placement 1"),
            std::string::npos);
  Json bend = sample();
  bend["parts"][0]["marks"][0]["role"] = "bend";
  EXPECT_NE(told(program_report(program, bend, 0.2)).find("the cut begins in placement 1"),
            std::string::npos);
  Json moved = sample();
  moved["parts"][0]["texts"][0]["at"][0] = 5.05;
  EXPECT_NE(told(program_report(program, moved, 0.2)).find("the cut begins in placement 1"),
            std::string::npos);
}

TEST(VerifyMarks, AMarkAfterItsPartIsCutOutIsRefused) {
  const std::string program = exported(sample(), "gcode", kLaser).files[0].bytes;
  const std::size_t first = program.find("\nG0", program.find("(MARKS")), cuts = program.find("(PLACEMENT"),
                    end = program.rfind("\nM5\nG0");
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(cuts, std::string::npos);
  const std::string late = program.substr(0, first) + "\n" + program.substr(cuts, end + 1 - cuts) +
                           program.substr(first + 1, cuts - first - 1) + program.substr(end + 1);
  EXPECT_NE(
      told(program_report(late, sample(), 0.2)).find("a mark is engraved after the outline of placement"),
      std::string::npos)
      << late;
}

TEST(VerifyMarks, AMarkAsDeepAsTheCutsIsRefused) {
  const std::string program = exported(sample(), "gcode", kRouter).files[0].bytes;
  const std::string deeper = replaced(program, "Z-0.3", "Z-6");
  EXPECT_NE(told(program_report(deeper, sample(), 3)).find("a mark is engraved as deep as parts are cut out"),
            std::string::npos)
      << deeper;
}

TEST(VerifyMarks, WhatIsRecheckedOfEngravingsIsSaid) {
  const auto notes = [](const Json& layout, const std::vector<io::ExportWord>& words, double kerf) {
    const auto report = program_report(exported(layout, "gcode", words).files[0].bytes, layout, kerf);
    EXPECT_EQ(told(report), "");
    std::string text;
    for (const std::string& note : report->notes) text += note + "\n";
    return text;
  };
  const std::string power = "how deep the beam engraves follows from its power, which was not rechecked\n";
  EXPECT_NE(notes(sample(), kLaser, 0.2).find(power), std::string::npos);
  EXPECT_EQ(notes(sample(), kRouter, 3).find(power), std::string::npos) << "its depth was";
  Json one = sample();
  one["parts"][0].erase("texts");
  Json bare = one;
  bare["parts"][0].erase("marks");
  one["parts"][0]["marks"] = {
      {{"layer", "E"}, {"role", "engrave"}, {"edges", Json::array({cases::line_json(5, 5, 15, 5)})}}};
  EXPECT_NE(notes(one, kLaser, 0.2).find("1 of 1 lines and texts on the parts are engraved all along"),
            std::string::npos);
  EXPECT_EQ(notes(bare, kLaser, 0.2).find("engrave"), std::string::npos);
}

TEST(VerifyMarks, ARapidMotionEngravesNothing) {
  const std::string program = exported(sample(), "gcode", kLaser).files[0].bytes;
  const std::size_t mark = program.find("(MARKS"), cut = program.find("\nG1 X", mark);
  ASSERT_NE(cut, std::string::npos);
  std::string rapid = program;
  rapid.replace(cut, 4, "\nG0 ");
  EXPECT_NE(told(program_report(rapid, sample(), 0.2)).find("a rapid motion cuts"), std::string::npos)
      << rapid;
}

TEST(VerifyMarks, MarksThatLeaveTheirPartAreNotEngraved) {
  Json layout = sample();
  layout["parts"][0]["marks"] = {
      {{"layer", "OUT"}, {"edges", Json::array({cases::line_json(50, 30, 61, 30)})}},
      {{"layer", "EDGE"}, {"edges", Json::array({cases::line_json(50, 30, 60, 30)})}}};
  layout["parts"][0].erase("texts");
  const io::Exported made = exported(layout, "gcode", kLaser);
  EXPECT_EQ(told(program_report(made.files[0].bytes, layout, 0.2)), "");
  EXPECT_NE(made.notes[0].find("1 line or text is engraved before them"), std::string::npos) << made.notes[0];
  EXPECT_NE(made.notes[0].find("1 on layer 'OUT' (out of their part or into another)"), std::string::npos)
      << made.notes[0];
  // A small part in the hole of the plate, over which a line of the plate runs.
  layout["parts"][0]["marks"] =
      Json::array({{{"layer", "OVER"}, {"edges", Json::array({cases::line_json(42, 10, 58, 10)})}}});
  cases::add_part(layout, "small", cases::outline_json(cases::rectangle(0, 0, 4, 4)));
  cases::place(layout, "small", 68, 18);
  const io::Exported over = exported(layout, "gcode", kLaser);
  EXPECT_NE(over.notes[0].find("1 on layer 'OVER' (out of their part or into another)"), std::string::npos)
      << over.notes[0];
}

TEST(VerifyMarks, TextsWithLettersThatTheFontLacksAreNamed) {
  Json layout = sample();
  layout["parts"][0].erase("marks");
  layout["parts"][0]["texts"] =
      Json::array({{{"text", "中"}, {"at", {5, 5}}, {"height", 4}, {"layer", "T"}}});
  const io::Exported made = exported(layout, "gcode", kLaser);
  EXPECT_NE(
      made.notes[0].find("1 line or text on the parts is not cut: 1 on layer 'T' (with letters that the font "
                         "of single lines lacks)"),
      std::string::npos)
      << made.notes[0];
}

TEST(VerifyMarks, WordsOfEngravingThatDoNotGoTogetherAreRefused) {
  const auto refusal = [](std::vector<io::ExportWord> words) {
    words.insert(words.end(), {{"kerf", "0.2"}, {"feed", "1000"}});
    const auto read = io::read_export_words(io::ExportForm::gcode, words, "--");
    return read ? "taken" : read.error().message;
  };
  EXPECT_EQ(refusal({{"engrave-feed", "500"}}), "taken");
  EXPECT_EQ(refusal({{"engrave-speed", "500"}}),
            "--engrave-feed is missing: the speed of engraving in mm/min");
  EXPECT_EQ(refusal({{"engrave-feed", "500"}, {"speed", "900"}}),
            "--engrave-speed is missing: the power of the beam for engraving, beside that for cuts");
  EXPECT_EQ(refusal({{"engrave-feed", "500"}, {"process", "plasma"}}),
            "--engrave-feed has no meaning for torches and jets of water, which cut through: leave it out");
  EXPECT_EQ(refusal({{"engrave-feed", "500"}, {"engrave-depth", "1"}}),
            "--engrave-depth has a meaning for routers alone: --process router");
  const std::vector<io::ExportWord> router{
      {"process", "router"}, {"speed", "9000"}, {"depth", "3"}, {"plunge", "300"}, {"engrave-feed", "500"}};
  EXPECT_EQ(refusal(router), "--engrave-depth is missing: how deep a router engraves, in mm");
  std::vector<io::ExportWord> deep = router;
  deep.push_back({"engrave-depth", "3"});
  EXPECT_EQ(refusal(deep), "--engrave-depth 3: has to be less than the --depth of 3 mm, which cuts through");
}

}  // namespace
}  // namespace lekalo::verify::verify_marks_test
