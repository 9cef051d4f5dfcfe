#include <algorithm>
#include <tuple>

#include "e2e/cli_run.hpp"
#include "support/layout_texts.hpp"
#include "support/places.hpp"

/// `lekalo export` for machines and other programs, as a person runs it. What is in the files is tested in
/// tests/unit/io_layout_export_test.cpp and those of nc/profile.hpp.
namespace lekalo::test::cli_export_test {
namespace {

using cases::add_part;
using cases::outline_json;
using cases::place;
using cases::rectangle;

/// Two sheets of a hundred, two plates on the first and one on the second.
Json plates() {
  Json layout = cases::empty_layout();
  layout["stocks"][0]["count"] = 2;
  add_part(layout, "plate", outline_json(rectangle(0, 0, 30, 20), {rectangle(5, 5, 10, 10)}));
  place(layout, "plate", 10, 10);
  place(layout, "plate", 50, 10);
  place(layout, "plate", 10, 10)["copy"] = 1;
  layout["kits"] = {{{"id", "pair"}, {"demand", 2}, {"pieces", {{{"part", "plate"}, {"count", 2}}}}}};
  return layout;
}

const Words kCut{"--format", "gcode", "--kerf", "0.3", "--feed", "2000", "--lead-in", "1"};

TEST(CliExport, EveryFormIsWrittenAndTheSameTwice) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates().dump());
  const std::vector<std::pair<Words, std::string>> forms{
      {{"--format", "dxf", "--unit", "inch"}, "  0\nSECTION\n"},
      {{"--format", "svg"}, "<?xml"},
      {{"--format", "pdf"}, "%PDF-"},
      {Words{"--format", "hpgl", "--sheet", "s#2"}, "IN;PA;"},
      {kCut + Words{"--sheet", "s#1", "--post", "fanuc"}, "%\nO0001"}};
  for (const auto& [words, begins] : forms) {
    const Ran first = run(folder.path(), Words{"export", "plates.json"} + words);
    ASSERT_EQ(first.status, 0) << first.err;
    EXPECT_EQ(first.out.rfind(begins, 0), 0U) << first.out.substr(0, 40);
    const Ran second = run(folder.path(), Words{"export", "plates.json", "-o", "out"} + words);
    ASSERT_EQ(second.status, 0) << second.err;
    EXPECT_EQ(second.out, "");
    EXPECT_NE(second.err.find("Written: out\n"), std::string::npos);
    EXPECT_EQ(read_bytes(folder / "out"), first.out);
  }
}

TEST(CliExport, SheetsAreFilesOfTheirOwnAllOrNone) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates().dump());
  const Ran ran = run(folder.path(), Words{"export", "plates.json", "-o", "cut.nc"} + kCut);
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.err.find("Written: cut-1.nc, sheet s#1\n"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("note: sheet s#1: 4 cuts"), std::string::npos) << ran.err;
  EXPECT_EQ(folder.files().size(), 3U);
  const std::string first = read_bytes(folder / "cut-1.nc");
  EXPECT_EQ(std::count(first.begin(), first.end(), '('), 6) << first;  // name, kerf, four contours
  const Ran without = run(folder.path(), Words{"export", "plates.json"} + kCut);
  EXPECT_EQ(without.status, 2);
  EXPECT_NE(without.err.find("for example --sheet s#1"), std::string::npos) << without.err;
  EXPECT_EQ(without.out, "");
  // One of the names is taken by a folder: none is written.
  fs::create_directory(folder / "plot-2.plt");
  const Ran blocked = run(folder.path(), {"export", "plates.json", "--format", "hpgl", "-o", "plot.plt"});
  EXPECT_EQ(blocked.status, 5) << blocked.err;
  EXPECT_FALSE(fs::exists(folder / "plot-1.plt"));
  // Nor is the layout itself replaced.
  write_bytes(folder / "plates-1.json", plates().dump());
  const Ran replaced =
      run(folder.path(), {"export", "plates-1.json", "--format", "hpgl", "-o", "plates.json"});
  EXPECT_EQ(replaced.status, 2) << replaced.err;
  EXPECT_EQ(read_bytes(folder / "plates-1.json"), plates().dump());
}

TEST(CliExport, WhatCannotBeCutWritesNothingAndNamesBoth) {
  const TemporaryFolder folder;
  Json layout = plates();
  place(layout, "plate", 10, 30.2);
  write_bytes(folder / "plates.json", layout.dump());
  const Ran ran = run(folder.path(), Words{"export", "plates.json", "-o", "cut.nc"} + kCut);
  EXPECT_EQ(ran.status, 3);
  EXPECT_NE(ran.err.find("plates.json: sheet s#1: placements 1 and 4 are too near for the kerf of 0.3 mm"),
            std::string::npos)
      << ran.err;
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_EQ(folder.files().size(), 1U);
}

TEST(CliExport, WrongCommandLinesAreRefusedInOneSentence) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates().dump());
  const std::vector<std::pair<Words, std::string>> wrong{
      {{"--format", "gcode"}, "--kerf is missing"},
      {{"--format", "gcode", "--kerf", "inf", "--feed", "1"}, "--kerf inf"},
      {{"--format", "dxf", "--kerf", "1"}, "--kerf has no meaning for the form dxf"},
      {{"--kerf", "1"}, "--kerf has no meaning for the form layout"},
      {{"--format", "pdf", "--sheet", "s"}, "--sheet has no meaning for the form pdf"},
      {{"--format", "svg", "--sheet", "t"}, "there is no sheet t"},
      {{"--format", "hpgl", "--only", "CUTS"}, "the layers are CUT"},
      {{"--format", "plt"}, "layout, placements, dxf, svg, pdf, labels, hpgl"}};
  for (const auto& [words, says] : wrong) {
    const Ran ran = run(folder.path(), Words{"export", "plates.json"} + words);
    EXPECT_EQ(ran.status, 2) << says;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_EQ(ran.out, "");
  }
}

TEST(CliExport, LabelsAreOnePdfAndWhatIsWrongIsOneSentence) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates().dump());
  Json empty = plates();
  empty["placements"] = Json::array();
  write_bytes(folder / "empty.json", empty.dump());
  const Words labels{"export", "plates.json", "--format", "labels"};
  const Ran sheet = run(folder.path(), labels + Words{"--label-sheet", "A4:3x8", "-o", "labels.pdf"});
#ifndef LEKALO_WITH_QR
  EXPECT_EQ(sheet.status, 5);
  EXPECT_NE(sheet.err.find("libqrencode-dev"), std::string::npos) << sheet.err;
  GTEST_SKIP() << "built without libqrencode";
#endif
  ASSERT_EQ(sheet.status, 0) << sheet.err;
  EXPECT_EQ(sheet.err, "Written: labels.pdf\n");
  EXPECT_EQ(read_bytes(folder / "labels.pdf"),
            run(folder.path(), labels + Words{"--label-sheet", "A4:3x8"}).out);
  const std::vector<std::tuple<Words, int, std::string>> wrong{
      {labels + Words{"--label-size", "12x12"}, 2, "plates.json: labels of 12 x 12 mm are too small"},
      {labels + Words{"--label-sheet", "A4:20x40"}, 2, "of which the paper takes"},
      {labels + Words{"--label-size", "62"}, 2, "--label-size 62: has to be"},
      {labels + Words{"--label-sheet", "B4:1x1"}, 2, "--label-sheet B4:1x1: has to be"},
      {labels + Words{"--label-gap", "3"}, 2, "--label-gap has a meaning for sheets of labels alone"},
      {labels + Words{"--kerf", "1"}, 2, "--kerf has no meaning for the form labels"},
      {{"export", "plates.json", "--label-size", "62x29"},
       2,
       "--label-size has no meaning for the form layout"},
      {{"export", "plates.json", "--format", "pdf", "--label-remnant", "9"},
       2,
       "no meaning for the form pdf"},
      {{"export", "empty.json", "--format", "labels"}, 3, "empty.json: nothing is placed"}};
  for (const auto& [words, status, says] : wrong) {
    const Ran ran = run(folder.path(), words + Words{"-o", "wrong.pdf"});
    EXPECT_EQ(ran.status, status) << says;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  }
  EXPECT_FALSE(fs::exists(folder / "wrong.pdf"));
}

TEST(CliExport, TheProgramPassesOurOwnReaderAndLocate) {
  const TemporaryFolder folder;
  write_plate(folder);
  Json layout = cases::empty_layout();
  add_part(layout, "plate", outline_json(rectangle(0, 0, 60, 30), {rectangle(20, 10, 10, 10)}));
  place(layout, "plate", 5, 5);
  write_bytes(folder / "layout.json", layout.dump());
  ASSERT_EQ(run(folder.path(), Words{"export", "layout.json", "-o", "cut.nc"} + kCut).status, 0);
  const Ran ran = run(folder.path(), kLocatePlate + Words{"--nc", "cut.nc", "--nc-out", "moved.nc"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(read_bytes(folder / "moved.nc").find("G2 "), std::string::npos);
}

}  // namespace
}  // namespace lekalo::test::cli_export_test
