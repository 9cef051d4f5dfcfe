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
      {{"--format", "hpgl", "--overcut", "1"},
       "--overcut has a meaning for knives alone: --process drag-knife or tangential-knife"},
      {{"--format", "hpgl", "--process", "drag-knife"}, "--blade-offset is missing"},
      {{"--format", "hpgl", "--process", "tangential-knife", "--blade-offset", "1"},
       "--blade-offset has a meaning for drag knives alone"},
      {{"--format", "hpgl", "--process", "laser"}, "--process laser has a meaning for the form gcode alone"},
      {{"--format", "gcode", "--process", "drag-knife"},
       "--process drag-knife has a meaning for the form hpgl alone"},
      {{"--format", "gcode", "--blade-offset", "1"}, "--blade-offset has no meaning for the form gcode"},
      {{"--format", "hpgl", "--process", "drag-knife", "--blade-offset", "nan"}, "--blade-offset nan"},
      {{"--format", "plt"}, "layout, placements, dxf, svg, pdf, labels, hpgl"}};
  for (const auto& [words, says] : wrong) {
    const Ran ran = run(folder.path(), Words{"export", "plates.json"} + words);
    EXPECT_EQ(ran.status, 2) << says;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_EQ(ran.out, "");
  }
}

#ifndef LEKALO_WITH_QR

TEST(CliExport, LabelsOfABuildWithoutQrCodesAreOneSentence) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates().dump());
  const Ran ran = run(folder.path(), {"export", "plates.json", "--format", "labels", "-o", "labels.pdf"});
  EXPECT_EQ(ran.status, 5);
  EXPECT_NE(ran.err.find("libqrencode-dev"), std::string::npos) << ran.err;
  EXPECT_EQ(folder.files().size(), 1U);
}

#else

TEST(CliExport, LabelsAreOnePdfAndWhatIsWrongIsOneSentence) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates().dump());
  Json empty = plates();
  empty["placements"] = Json::array();
  write_bytes(folder / "empty.json", empty.dump());
  const Words labels{"export", "plates.json", "--format", "labels"};
  const Ran sheet = run(folder.path(), labels + Words{"--label-sheet", "A4:3x8", "-o", "labels.pdf"});
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

#endif

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

const Words kSteel{"--format",   "gcode", "--processes", "shop.json",
                   "--material", "steel", "--thickness", "2"};

Json shop() {
  return Json::parse(R"({"format": "lekalo-process/1", "processes": [
    {"material": "steel", "thickness_mm": 2, "process": "laser", "kerf_mm": 0.2, "feed_mm_per_min": 3000,
     "speed": 900, "pierce_s": 0.3, "lead_in_mm": 1.5},
    {"material": "steel", "thickness_mm": 4, "process": "plasma", "kerf_mm": 0.8, "feed_mm_per_min": 2500,
     "lead_in_mm": 4, "lead": "arc",
     "holes": [{"up_to_diameter_mm": 11, "lead_in_mm": 1, "feed_share": 0.4}]},
    {"material": "birch", "thickness_mm": 6, "process": "router", "post": "grbl", "kerf_mm": 2,
     "feed_mm_per_min": 1500, "speed": 18000, "depth_mm": 6.2, "plunge_mm_per_min": 300},
    {"material": "birch", "thickness_mm": 6, "process": "laser", "kerf_mm": 0.3, "feed_mm_per_min": 400}]})");
}

TEST(CliExport, AProcessOfAFileWritesWhatItsWordsWrite) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates().dump());
  write_bytes(folder / "shop.json", shop().dump());
  const auto program = [&](const Words& words) {
    const Ran ran = run(folder.path(), Words{"export", "plates.json", "--sheet", "s#1"} + words);
    EXPECT_EQ(ran.status, 0) << ran.err;
    return ran.out;
  };
  const Words line{"--format", "gcode",   "--kerf", "0.2",      "--feed",
                   "3000",     "--speed", "900",    "--pierce", "0.3"};
  EXPECT_EQ(program(kSteel), program(line + Words{"--lead-in", "1.5"}));
  EXPECT_EQ(program(kSteel + Words{"--lead-in", "0.5", "--post", "fanuc", "--unit", "inch"}),
            program(line + Words{"--lead-in", "0.5", "--post", "fanuc", "--unit", "inch"}));
  EXPECT_EQ(program({"--format", "gcode", "--processes", "shop.json", "--material", "birch", "--thickness",
                     "6.0", "--process", "router"}),
            program({"--format", "gcode", "--process", "router", "--post", "grbl", "--kerf", "2", "--feed",
                     "1500", "--speed", "18000", "--depth", "6.2", "--plunge", "300"}));
  const Ran told =
      run(folder.path(), Words{"export", "plates.json", "--sheet", "s#1", "-o", "cut.nc"} + kSteel);
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_NE(told.err.find("note: the process is entry 1 of shop.json: steel, 2 mm (laser)\n"),
            std::string::npos)
      << told.err;
}

TEST(CliExport, AProcessForAnotherMaterialThanThatOfTheSheetIsTold) {
  const TemporaryFolder folder;
  Json layout = plates();
  write_bytes(folder / "shop.json", shop().dump());
  const auto said = [&](const Json& material, const Json& thickness) {
    layout["stocks"][0]["material"] = material, layout["stocks"][0]["thickness"] = thickness;
    write_bytes(folder / "plates.json", layout.dump());
    const Ran ran =
        run(folder.path(), Words{"export", "plates.json", "--sheet", "s#1", "-o", "cut.nc"} + kSteel);
    EXPECT_EQ(ran.status, 0) << ran.err;
    return ran.err;
  };
  EXPECT_EQ(said("steel", 2).find("and the process is for"), std::string::npos);
  EXPECT_NE(said("birch", 2).find("note: stock s is of birch, 2 mm, and the process is for steel, 2 mm\n"),
            std::string::npos);
  EXPECT_NE(
      said("steel", 2.5).find("note: stock s is of steel, 2.5 mm, and the process is for steel, 2 mm\n"),
      std::string::npos);
}

TEST(CliExport, HolesThatAreCutSlowerAreSaidAndConfirmed) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates().dump());
  write_bytes(folder / "shop.json", shop().dump());
  const Words steel{"export",    "plates.json", "--sheet", "s#1",         "--format", "gcode", "--processes",
                    "shop.json", "--material",  "steel",   "--thickness", "4",        "-o",    "cut.nc"};
  for (const Words& more :
       {Words{}, Words{"--unit", "inch"}, Words{"--post", "fanuc"}, Words{"--lead", "line"}}) {
    const Ran ran = run(folder.path(), steel + more);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.err.find("; 2 holes are up to 11 mm in diameter, cut at 1000 mm/min with a lead of 1 mm"),
              std::string::npos)
        << ran.err;
    const std::string program = read_bytes(folder / "cut.nc");
    EXPECT_NE(program.find("(HOLES UP TO "), std::string::npos) << program;
    const Words verify{"verify", "cut.nc", "--layout", "plates.json", "--sheet", "s#1", "--kerf"};
    const Ran verified = run(folder.path(), verify + Words{"0.8"});
    EXPECT_EQ(verified.status, 0) << verified.err;
    EXPECT_EQ(run(folder.path(), verify + Words{"1"}).status, 4);
  }
  const std::string program = read_bytes(folder / "cut.nc");
  EXPECT_NE(program.find(" F1000.0\n"), std::string::npos) << program;
  EXPECT_NE(program.find(" F2500.0\n"), std::string::npos) << program;
}

TEST(CliExport, PiercesAndJointsAreSaidAndConfirmed) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates().dump());
  const Words cut{"export", "plates.json", "--sheet", "s#1",    "--format", "gcode",     "-o",
                  "cut.nc", "--kerf",      "0.4",     "--feed", "2000",     "--lead-in", "3"};
  const Words joints{"--joint-width", "0.5"}, pierce{"--pierce-diameter", "2"};
  const Words verify{"verify", "cut.nc", "--layout", "plates.json", "--sheet", "s#1", "--kerf", "0.4"};
  for (const Words& more : {Words{"--joints", "2"}, Words{"--joints", "tipping", "--slat-pitch", "60"},
                            Words{"--joints", "1", "--unit", "inch"}, Words{"--joints-of", "1=3"},
                            Words{"--joints", "2", "--post", "fanuc", "--lead", "arc"}}) {
    const Ran ran = run(folder.path(), cut + joints + pierce + more);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.err.find("; every pierce of 2 mm is clear of parts and of earlier cuts; "),
              std::string::npos)
        << ran.err;
    EXPECT_NE(ran.err.find("; joints of 0.5 mm: "), std::string::npos) << ran.err;
    const Ran verified = run(folder.path(), verify + joints + pierce);
    EXPECT_EQ(verified.status, 0) << verified.err;
    EXPECT_NE(verified.err.find("whether parts would tip without them"), std::string::npos);
    EXPECT_EQ(run(folder.path(), verify).status, 4) << "contours are open";
    EXPECT_EQ(run(folder.path(), verify + Words{"--joint-width", "0.6"}).status, 4);
    EXPECT_EQ(run(folder.path(), verify + joints + Words{"--pierce-diameter", "9"}).status, 4);
  }
  const Ran routed =
      run(folder.path(), cut + joints +
                             Words{"--joints", "2", "--process", "router", "--depth", "6", "--pass", "2",
                                   "--plunge", "200", "--speed", "9000", "--tab-height", "1.5"});
  ASSERT_EQ(routed.status, 0) << routed.err;
  EXPECT_NE(read_bytes(folder / "cut.nc").find("G1 Z-4.5000"), std::string::npos);
  const Ran verified = run(folder.path(), verify + joints);
  EXPECT_EQ(verified.status, 0) << verified.err;
}

/// Four plates and two angles on one sheet, at gaps of exactly 0.4 mm.
Json plates_at_one_kerf() {
  Json layout = cases::empty_layout();
  add_part(layout, "plate", outline_json(rectangle(0, 0, 30, 20), {rectangle(5, 5, 10, 10)}));
  add_part(layout, "bar", outline_json(rectangle(0, 0, 60.4, 12)));
  for (const double x : {10.0, 40.4})
    for (const double y : {10.0, 30.4}) place(layout, "plate", x, y);
  place(layout, "bar", 10, 50.8);
  return layout;
}

TEST(CliExport, EdgesInCommonAreCutOnceAndVerifySaysSo) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates_at_one_kerf().dump());
  const Words cut{"export", "plates.json", "--format", "gcode", "-o",        "cut.nc",
                  "--kerf", "0.4",         "--feed",   "2000",  "--lead-in", "2"};
  const Words verify{"verify", "cut.nc", "--layout", "plates.json", "--kerf", "0.4"};
  const Words common{"--common-line"}, pierce{"--pierce-diameter", "1.2"};

  const Ran apart = run(folder.path(), cut);
  ASSERT_EQ(apart.status, 0) << apart.err;
  EXPECT_NE(apart.err.find("160 mm of edges that two parts have in common are cut twice (--common-line cuts "
                           "them once)"),
            std::string::npos)
      << apart.err;
  EXPECT_EQ(run(folder.path(), verify).status, 0);
  EXPECT_EQ(run(folder.path(), verify + common).status, 4) << "edges are cut twice";

  const Ran shared = run(folder.path(), cut + common + pierce);
  ASSERT_EQ(shared.status, 0) << shared.err;
  EXPECT_NE(
      shared.err.find("160 mm of edges that two parts have in common are cut once, in 3 lines beside both at "
                      "half a kerf, within 0.00001 mm"),
      std::string::npos)
      << shared.err;
  const std::string program = read_bytes(folder / "cut.nc");
  EXPECT_NE(program.find("(COMMON LINE OF PLACEMENTS 1 2 3 4)"), std::string::npos) << program;
  EXPECT_NE(program.find("(COMMON OUTLINE OF PLACEMENTS 1 2 3 4 5)"), std::string::npos) << program;
  const Ran verified = run(folder.path(), verify + common + pierce);
  EXPECT_EQ(verified.status, 0) << verified.err;
  EXPECT_NE(verified.err.find("the middle of a cut is half a kerf beside every contour"), std::string::npos);
  EXPECT_EQ(run(folder.path(), verify + pierce).status, 4) << "without the word every contour is closed";
  EXPECT_EQ(run(folder.path(), verify + common + Words{"--pierce-diameter", "9"}).status, 4);

  // A line less, and a line twice.
  const std::size_t begin = program.find("(COMMON LINE"), end = program.find("M5\n", begin) + 3;
  const std::string line = program.substr(begin, end - begin);
  std::string less = program, twice = program;
  write_bytes(folder / "cut.nc", less.erase(begin, line.size()));
  const Ran missing = run(folder.path(), verify + common);
  EXPECT_EQ(missing.status, 4);
  EXPECT_NE(missing.err.find("from the middle of the nearest cut near"), std::string::npos) << missing.err;
  write_bytes(folder / "cut.nc", twice.insert(begin, line));
  const Ran again = run(folder.path(), verify + common);
  EXPECT_EQ(again.status, 4);
  EXPECT_NE(again.err.find("is cut twice"), std::string::npos) << again.err;

  // A router goes along each line twice as deep, from its beginning.
  ASSERT_EQ(run(folder.path(), cut + common +
                                   Words{"--process", "router", "--depth", "6", "--pass", "3", "--plunge",
                                         "200", "--speed", "9000"})
                .status,
            0);
  const Ran routed = run(folder.path(), verify + common);
  EXPECT_EQ(routed.status, 0) << routed.err;
}

TEST(CliExport, CommonLinesGoWithNeitherJointsNorHeatNorArcs) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates_at_one_kerf().dump());
  const auto said = [&](const Words& words) {
    const Ran ran = run(folder.path(), Words{"export", "plates.json"} + words);
    EXPECT_EQ(ran.status, 2) << ran.err;
    EXPECT_TRUE(ran.out.empty());
    return ran.err;
  };
  const Words cut{"--format", "gcode", "--kerf", "0.4", "--feed", "2000", "--common-line"};
  EXPECT_NE(said(cut + Words{"--joints", "2", "--joint-width", "0.5"})
                .find("--common-line and --joints do not go together: leave one of them out"),
            std::string::npos);
  EXPECT_NE(said(cut + Words{"--heat-spread", "20"})
                .find("--common-line and --heat-spread do not go together: leave one of them out"),
            std::string::npos);
  EXPECT_NE(said(cut + Words{"--lead-in", "2", "--lead", "arc"})
                .find("--common-line and --lead arc do not go together: take lines for leads"),
            std::string::npos);
  EXPECT_NE(said({"--format", "dxf", "--common-line"}).find("--common-line has no meaning for the form dxf"),
            std::string::npos);
  const Ran both = run(folder.path(), {"verify", "x.nc", "--layout", "plates.json", "--kerf", "1",
                                       "--common-line", "--joint-width", "1"});
  EXPECT_EQ(both.status, 2);
  EXPECT_NE(both.err.find("--common-line and --joint-width do not go together"), std::string::npos)
      << both.err;
}

TEST(CliExport, PiercesAndJointsThatWillNotDoAreRefusedInOneSentence) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates().dump());
  const Words cut{"--format", "gcode", "--kerf", "0.4", "--feed", "2000"};
  const Words router{"--process", "router", "--depth", "6", "--plunge", "200", "--speed", "9000"};
  struct Case {
    Words words;
    int status;
    std::string says;
  };
  const std::vector<Case> wrong{
      {{"--pierce-diameter", "0.3"}, 2, "--pierce-diameter 0.3: has to be at least the kerf of 0.4 mm"},
      {{"--pierce-diameter", "8", "--lead-in", "3"},
       2,
       "--lead-in 3: a pierce of 8 mm and a kerf of 0.4 mm need a lead of at least 3.8 mm"},
      {{"--pierce-diameter", "wide"}, 2, "--pierce-diameter wide: has to be a number from 0.01 to 100"},
      {router + Words{"--pierce-diameter", "2"}, 2, "--pierce-diameter has no meaning for routers"},
      {{"--pierce-diameter", "11", "--lead-in", "6"},
       3,
       "there is no room for a pierce of 11 mm with a lead of 6 mm or less, clear of every part, for hole 1 "
       "of placement 1, hole 1 of placement 2"},
      {{"--heat-spread", "-3"}, 2, "--heat-spread -3: has to be a number from 0 to 10000"},
      {{"--joints", "2"}, 2, "--joint-width is missing: the material that a joint leaves, in mm"},
      {{"--joints", "0", "--joint-width", "1"},
       2,
       "--joints 0: has to be tipping, or a whole number from 1 to 20"},
      {{"--joints", "tipping", "--joint-width", "1"}, 2, "--slat-pitch is missing: how far apart the slats"},
      {{"--joints", "2", "--joint-width", "1", "--slat-pitch", "60"},
       2,
       "--slat-pitch says nothing without --joints tipping"},
      {{"--joint-width", "1"}, 2, "--joint-width says nothing without --joints"},
      {{"--joints", "2", "--joint-width", "60"}, 2, "--joint-width 60: has to be a number from 0.05 to 50"},
      {{"--joints", "2", "--joint-width", "40"}, 3, "there is no room for joints of 40 mm"},
      {{"--joints-of", "1", "--joint-width", "1"},
       2,
       "--joints-of 1: has to be numbers of placements with 0 to 20 joints each"},
      {{"--joints-of", "1=2,1=3", "--joint-width", "1"},
       2,
       "--joints-of 1=2,1=3: placement 1 stands there twice"},
      {{"--joints-of", "9=2", "--joint-width", "1"}, 2, "there is no placement 9 to have 2 joints"},
      {{"--slats", "z", "--joints", "tipping", "--joint-width", "1", "--slat-pitch", "60"},
       2,
       "--slats z: has to be one of x, y"},
      {{"--joints", "2", "--joint-width", "1", "--tab-height", "1"},
       2,
       "--tab-height has a meaning for routers alone"},
      {router + Words{"--joints", "2", "--joint-width", "1"}, 2,
       "--tab-height is missing: how high the tabs"},
      {router + Words{"--joints", "2", "--joint-width", "1", "--tab-height", "6"}, 2,
       "--tab-height 6: has to be below the depth of 6 mm"}};
  for (const auto& [words, status, says] : wrong) {
    const Ran ran = run(folder.path(), Words{"export", "plates.json", "--sheet", "s#1"} + cut + words);
    EXPECT_EQ(ran.status, status) << says << ran.err;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_EQ(ran.out, "");
  }
  for (const std::string option : {"--pierce-diameter", "--joint-width"}) {
    write_bytes(folder / "cut.nc", "G21\nM2\n");
    const Ran ran = run(folder.path(), {"verify", "cut.nc", "--layout", "plates.json", option, "1"});
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.err.find(option + " is rechecked with --layout FILE and --kerf MM"), std::string::npos)
        << ran.err;
  }
}

TEST(CliExport, ProcessesThatWillNotDoAreRefusedInOneSentence) {
  const TemporaryFolder folder;
  write_bytes(folder / "plates.json", plates().dump());
  write_bytes(folder / "shop.json", shop().dump());
  Json kerfless = shop();
  kerfless["processes"][1].erase("kerf_mm");
  write_bytes(folder / "kerfless.json", kerfless.dump());
  Json keys = shop();
  keys["processes"][0]["gas"] = "O2";
  keys["processes"][2]["pierce_s"] = 1;
  write_bytes(folder / "keys.json", keys.dump());
  write_bytes(folder / "broken.json", "{\"format\": \"lekalo-process/1\",\n \"processes\": [");
  const auto from = [](const std::string& file, const std::string& material, const std::string& thickness) {
    return Words{"--format", "gcode", "--processes", file, "--material", material, "--thickness", thickness};
  };
  struct Case {
    Words words;
    int status;
    std::string says;
  };
  const std::vector<Case> wrong{
      {from("shop.json", "brass", "2"), 2,
       "there is no process for brass, 2 mm; there are: steel, 2 mm (laser); "},
      {from("shop.json", "steel", "3"), 2, "there are: steel, 2 mm (laser); steel, 4 mm (plasma)"},
      {kSteel + Words{"--process", "router"}, 2, "there is no process for steel, 2 mm (router)"},
      {from("shop.json", "birch", "6"), 2,
       "shop.json: entries 3 and 4 are for birch, 6 mm: router and laser; say which with --process"},
      {from("kerfless.json", "steel", "2"), 3,
       "kerfless.json: entry 2: kerf_mm is missing: the width of the cut"},
      {from("keys.json", "steel", "2"), 3, "keys.json: entry 1: there is no key 'gas'"},
      {from("keys.json", "steel", "2"), 3, "; entry 3: pierce_s has no meaning for routers"},
      {from("broken.json", "steel", "2"), 3, "broken.json"},
      {from("nowhere.json", "steel", "2"), 3, "nowhere.json"},
      {from("plates.json", "steel", "2"), 3, "plates.json: this is no file of processes"},
      {from("shop.json", "steel", "two"), 2, "--thickness: \"two\" is not a thickness from 0.001 to 1000 mm"},
      {{"--format", "gcode", "--processes", "shop.json", "--thickness", "2"}, 2, "--material is missing"},
      {{"--format", "gcode", "--processes", "shop.json", "--material", "steel"}, 2, "--thickness is missing"},
      {{"--format", "gcode", "--material", "steel", "--kerf", "1", "--feed", "1"}, 2, "--processes FILE"},
      {{"--format", "dxf", "--processes", "shop.json", "--material", "steel", "--thickness", "2"},
       2,
       "--processes has no meaning for the form dxf"},
      {kSteel + Words{"--kerf", "0"}, 2, "--kerf 0: has to be a number from 0.01 to 100"},
      {kSteel + Words{"--depth", "3"}, 2, "--depth has a meaning for routers alone"},
      {from("shop.json", "birch", "6") + Words{"--process", "laser", "--post", "grbl"}, 2,
       "--speed is missing"},
      {kSteel + Words{"-o", "shop.json"}, 2, "shop.json"}};
  const auto before = folder.files();
  for (const auto& [words, status, says] : wrong) {
    const Ran ran = run(folder.path(), Words{"export", "plates.json", "--sheet", "s#1"} + words);
    EXPECT_EQ(ran.status, status) << says;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_EQ(ran.out, "");
  }
  EXPECT_EQ(folder.files(), before);
}

}  // namespace
}  // namespace lekalo::test::cli_export_test
