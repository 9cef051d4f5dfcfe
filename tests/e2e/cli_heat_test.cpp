// `lekalo heat` as people use it: results, pictures, and one sentence for what is wrong, with nothing
// written.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "cli_run.hpp"

namespace lekalo::test::cli_heat_test {
namespace {

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

const Words kUsual{"heat",    "p.ngc", "--pocket",  "k.json", "--stock",    "40x36x10", "--tool",  "6",
                   "--teeth", "3",     "--spindle", "8000",   "--material", "6061-T6",  "--voxel", "4"};

void write_files(const TemporaryFolder& folder) {
  write_bytes(folder / "k.json", R"({"units": "mm", "outer": [{"line": {"from": [0, 0], "to": [20, 0]}},
    {"line": {"from": [20, 0], "to": [20, 16]}}, {"line": {"from": [20, 16], "to": [0, 16]}},
    {"line": {"from": [0, 16], "to": [0, 0]}}]})");
  write_bytes(
      folder / "p.ngc",
      "G21 G90 G17 G94 G54\nG0 X3 Y3 Z5\nG1 Z-4 F200\nG1 X17 F600\nG1 Y13\nG1 X3\nG1 Y3\nG1 Y8\nG1 X17\n"
      "G0 Z5\nM2\n");
}

TEST(CliHeat, WritesAResultAndAPictureAndDecides) {
  const TemporaryFolder folder;
  write_files(folder);
  const Ran made = run(folder.path(), with(kUsual, {"--share", "0.05..0.2", "-o", "h.json"}));
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("leave it."), std::string::npos) << made.err;
  EXPECT_NE(made.err.find("computed and not proved"), std::string::npos) << made.err;
  const Json result = Json::parse(read_bytes(folder / "h.json"));
  EXPECT_EQ(result["cases"].size(), 3U) << "dry is an interval of films";
  EXPECT_LT(result["wall_error_um"]["mean"].get<double>(), 0);
  EXPECT_GT(result["uniform_scaling"]["factor"].get<double>(), 1);
  EXPECT_NE(read_bytes(folder / "h.svg").find("the walls unrolled"), std::string::npos);

  const Ran verified = run(folder.path(), {"verify", "h.json"});
  EXPECT_EQ(verified.status, 1) << "what voxels say is not proved: " << verified.err;
  EXPECT_NE(verified.err.find("computed in voxels and not proved"), std::string::npos) << verified.err;
  Json lie = result;
  lie["booked"]["volume_mm3"] = 1000;
  write_bytes(folder / "lie.json", lie.dump());
  EXPECT_EQ(run(folder.path(), {"verify", "lie.json"}).status, 4);
  write_bytes(folder / "p.ngc", "G21 G90 G17\nG0 X3 Y3 Z5\n");
  EXPECT_EQ(run(folder.path(), {"verify", "h.json"}).status, 4) << "another program";
}

TEST(CliHeat, OneFilmIsOneCaseAndNoFileIsAskedFor) {
  const TemporaryFolder folder;
  write_files(folder);
  const Ran made = run(folder.path(), with(kUsual, {"--share", "0.1", "--cooling", "20", "--json"}));
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.json()["cases"].size(), 1U);
  EXPECT_FALSE(std::filesystem::exists(folder / "h.svg"));
}

TEST(CliHeat, MapsReportAndPageShowWhatWasComputed) {
  const TemporaryFolder folder;
  write_files(folder);
  const Words usual = with(kUsual, {"--share", "0.05..0.2", "-o", "h.json"});
  const Ran made =
      run(folder.path(), with(usual, {"--maps", "m.svg", "--report", "r.svg", "--animation", "a.html"}));
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string maps = read_bytes(folder / "m.svg"), report = read_bytes(folder / "r.svg"),
                    page = read_bytes(folder / "a.html"), result = read_bytes(folder / "h.json");
  for (const char* shown : {"warmest at any time", "temperature at the end", "of the yield stress",
                            "displacement at the end", "as the program is", "scaled by 1.000"}) {
    EXPECT_NE(maps.find(shown), std::string::npos) << shown;
    EXPECT_NE(report.find(shown), std::string::npos) << shown;
  }
  for (const char* shown : {"What to do", "leave it.", "What the largest error hangs on", "Input files",
                            "k.json", "Not modelled", "computed and not proved"})
    EXPECT_NE(report.find(shown), std::string::npos) << shown;
  // One file without links, and of bounded size.
  EXPECT_EQ(page.find("http"), page.find("http-equiv"));
  EXPECT_EQ(page.find("src="), std::string::npos);
  EXPECT_EQ(page.find("/* page.js */"), std::string::npos);
  EXPECT_LT(page.size(), 1'000'000U);
  // Pictures change nothing of the result, and are the same bytes again.
  ASSERT_EQ(run(folder.path(), usual).status, 0);
  EXPECT_EQ(read_bytes(folder / "h.json"), result);
  ASSERT_EQ(run(folder.path(), with(usual, {"--maps", "m.png", "--report", "r.pdf", "--animation", "b.html"}))
                .status,
            0);
  EXPECT_EQ(read_bytes(folder / "b.html"), page);
  EXPECT_EQ(read_bytes(folder / "m.png").substr(1, 3), "PNG");
  EXPECT_EQ(read_bytes(folder / "r.pdf").substr(0, 4), "%PDF");
}

TEST(CliHeat, AMeasuredTemperatureNarrowsTheShare) {
  const TemporaryFolder folder;
  write_files(folder);
  const Words share{"--share", "0.01..0.9", "--cutting-force", "500", "--force-exponent", "0.25"};
  const Ran made = run(folder.path(), with(with(kUsual, share), {"--measured", "30,10,8,-7,8", "--measured",
                                                                 "29,10,8,-7,8,3", "-o", "h.json"}));
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("of the stated share of 0.01 to 0.9"), std::string::npos) << made.err;
  const Json result = Json::parse(read_bytes(folder / "h.json"));
  ASSERT_EQ(result["measured"].size(), 2U);
  EXPECT_EQ(result["measured"][0]["uncertainty_k"], 2.5);
  EXPECT_GT(result["calibrated"]["share"][0].get<double>(), 0.02);
  EXPECT_LT(result["calibrated"]["share"][1].get<double>(), 0.8);
  EXPECT_EQ(run(folder.path(), {"verify", "h.json"}).status, 1);
}

TEST(CliHeat, TheStockMayBeAnOutline) {
  const TemporaryFolder folder;
  write_files(folder);
  write_bytes(folder / "blank.json", R"({"units": "mm", "outer": [{"arc": {"from": [40, 8], "to": [40, 8],
    "centre": [10, 8], "ccw": true}}]})");
  Words words = with(kUsual, {"--share", "0.1", "-o", "h.json", "--height", "10"});
  words[5] = "blank.json";
  const Ran made = run(folder.path(), words);
  ASSERT_EQ(made.status, 0) << made.err;
  const Json result = Json::parse(read_bytes(folder / "h.json"));
  EXPECT_EQ(result["stock"]["low_mm"][0], -20);
  EXPECT_EQ(result["inputs"][2]["role"], "stock");
  EXPECT_EQ(run(folder.path(), {"verify", "h.json"}).status, 1);
  write_bytes(folder / "blank.json", R"({"units": "mm", "outer": [{"arc": {"from": [21, 8], "to": [21, 8],
    "centre": [10, 8], "ccw": true}}]})");
  const Ran beyond = run(folder.path(), words);
  EXPECT_EQ(beyond.status, 3);
  EXPECT_NE(beyond.err.find("p.ngc:4: the tool cuts"), std::string::npos) << beyond.err;
}

TEST(CliHeat, ACorrectedProgramIsWrittenWhereTheIntervalsSupportIt) {
  const TemporaryFolder folder;
  write_bytes(folder / "k.json", R"({"units": "mm", "outer": [{"line": {"from": [0, 0], "to": [40, 0]}},
    {"line": {"from": [40, 0], "to": [40, 30]}}, {"line": {"from": [40, 30], "to": [0, 30]}},
    {"line": {"from": [0, 30], "to": [0, 0]}}]})");
  ASSERT_EQ(run(folder.path(),
                {"pocket", "k.json", "--tool", "6", "--depth", "4", "--stepdown", "2", "-o", "p.ngc"})
                .status,
            0);
  Words words = with(kUsual, {"--cutting-force", "700", "--force-exponent", "0.25", "--cooling", "20",
                              "--corrected", "c.ngc", "-o", "h.json"});
  words[5] = "60x50x12", words[15] = "3";
  const Ran wide = run(folder.path(), with(words, {"--share", "0.1..0.5"}));
  EXPECT_EQ(wide.status, 1);
  EXPECT_NE(wide.err.find("no corrected program is written"), std::string::npos) << wide.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "c.ngc"));
  EXPECT_TRUE(Json::parse(read_bytes(folder / "h.json"))["after_correction_um"].is_null());

  const Ran made = run(folder.path(), with(words, {"--share", "0.3", "--maps", "m.svg"}));
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(read_bytes(folder / "m.svg").find("finishing passes moved: "), std::string::npos);
  const Json result = Json::parse(read_bytes(folder / "h.json"));
  EXPECT_LT(result["after_correction_um"]["largest"].get<double>(),
            0.2 * result["wall_error_um"]["largest"].get<double>());
  EXPECT_EQ(run(folder.path(), {"verify", "h.json"}).status, 1);
  write_bytes(folder / "c.ngc", read_bytes(folder / "p.ngc"));
  EXPECT_EQ(run(folder.path(), {"verify", "h.json"}).status, 4) << "another program";
  const Ran none = run(folder.path(), with(words, {"--share", "0.3", "--finish", "0.01"}));
  EXPECT_EQ(none.status, 3);
  EXPECT_NE(none.err.find("no finishing pass to move"), std::string::npos) << none.err;
}

TEST(CliHeat, WithoutHeatNothingIsOff) {
  const TemporaryFolder folder;
  write_files(folder);
  const Ran made = run(folder.path(), with(kUsual, {"--share", "0", "--cooling", "20", "-o", "h.json"}));
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("lie +0.00 to +0.00 um"), std::string::npos) << made.err;
}

TEST(CliHeat, WhatIsWrongIsOneSentenceAndNothingIsWritten) {
  const TemporaryFolder folder;
  write_files(folder);
  write_bytes(folder / "wide.ngc", "G21 G90 G17\nG0 X3 Y3 Z5\nG1 Z-4 F200\nG1 X60 F600\nG0 Z5\n");
  write_bytes(folder / "still.ngc", "G21 G90 G17\nG0 X3 Y3 Z5\n");
  struct Wrong {
    Words words;
    int status;
    const char* says;
  };
  const auto said = [&](const Words& words, int status, const char* says) {
    const Ran ran = run(folder.path(), with(words, {"-o", "h.json"}));
    EXPECT_EQ(ran.status, status) << says << ": " << ran.err;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "h.json")) << says;
    EXPECT_FALSE(std::filesystem::exists(folder / "h.svg")) << says;
  };
  for (const Wrong& w :
       {Wrong{{}, 3, "has to be stated: --share (share of the cutting power"},
        {{"--share", "0.1", "--cooling", "water"}, 3, "no such cooling"},
        {{"--share", "1.5"}, 3, "it has to be from 0 to 1"},
        {{"--share", "0.2..0.1"}, 2, "--share: \"0.2..0.1\""},
        {{"--share", "0.1", "--wear", "0.5"}, 2, "--wear"},
        {{"--share", "0.1", "--hold", "hand"}, 2, "--hold"},
        {{"--share", "0.1", "--datum", "1,2"}, 2, "--datum"},
        {{"--share", "0.1", "--datum", "1,2,3", "--hold", "plate"}, 2, "--hold free"},
        {{"--share", "0.1", "--datum", "100,8,-7"}, 3, "the datum X 100 Y 8 Z -7: the place is outside of"},
        {{"--share", "0.1", "--measured", "30,1,2,3"}, 2, "--measured: \"30,1,2,3\" is not a temperature"},
        {{"--share", "0.1", "--measured", "30,1,2,3,x"}, 2, "a time from 0 s on (in \"30,1,2,3,x\")"},
        {{"--share", "0.1", "--measured", "30,10,8,-7,100"}, 3, "state the time from its start"},
        {{"--share", "0.1", "--height", "10"}, 2, "--height is that of an outline"},
        {{"--share", "0.1", "--picture", "h.txt"}, 2, ".svg or .png"},
        {{"--share", "0.1", "--maps", "m.pdf"}, 2, "--maps m.pdf: the name has to end in .svg or .png"},
        {{"--share", "0.1", "--report", "r.txt"},
         2,
         "--report r.txt: the name has to end in .svg, .pdf or .png"},
        {{"--share", "0.1", "--animation", "a.svg"}, 2, "--animation a.svg: the name has to end in .html"},
        {{"--share", "0.9", "--melting", "61", "--ambient", "-80"}, 3, "degrees C warm at least"}})
    said(with(kUsual, w.words), w.status, w.says);
  const auto other = [](std::size_t at, const char* word) {
    Words words = with(kUsual, {"--share", "0.1"});
    words[at] = word;
    return words;
  };
  said(other(5, "40x36"), 2, "--stock");
  said(other(15, "50"), 3,
       "voxels of 50 mm are larger than the thickness of the stock of 10 mm; --voxel 2.5");
  said(other(5, "40x36x10@100,0"), 3, "the program lies outside of the stock");
  said(other(5, "40x36x10@5,-10"), 3, "beyond the stock's border");
  said(other(1, "still.ngc"), 3, "the tool never goes below Z 0");
  said(other(1, "none.ngc"), 3, "none.ngc");
  Words cut_before = with(kUsual, {"--share", "0.1", "--after", "p.ngc:6"});
  said(cut_before, 3, "p.ngc: the program cuts nothing of the stock");
  said(other(9, "0"), 2, "without which chips have no thickness");
  said(other(11, "0"), 2, "without which chips have no thickness");
  said(other(13, "PMMA"), 3, "PMMA: what no public source is known to say has to be stated: --cutting-force");
  said(other(13, "brass"), 3, "brass: no such material");
  Words words = kUsual;
  words.erase(words.begin() + 8, words.begin() + 10);
  said(words, 2, "--teeth");
}

}  // namespace
}  // namespace lekalo::test::cli_heat_test
