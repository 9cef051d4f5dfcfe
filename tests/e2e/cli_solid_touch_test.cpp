#include "e2e/cli_run.hpp"

/// The example's part in its casting, which a probe has touched, as a person places it.
namespace lekalo::test::cli_solid_touch_test {
namespace {

class SolidTouch : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* const name : {"part.stl", "casting.stl", "touches.xyz"})
      write_bytes(folder_ / name, read_bytes(fs::path(cases::source_dir()) / "examples" / "solid" / name));
  }
  [[nodiscard]] Ran locate(const Words& more) const {
    return run(folder_.path(), Words{"locate", "--part", "part.stl", "--blank", "touches.xyz", "--method",
                                     "climb", "--units", "mm"} +
                                   more);
  }
  TemporaryFolder folder_;
};

const Words kTouched{"--nominal-blank", "casting.stl", "--form", "0.1",     "--ball", "3",
                     "--uncertainty",   "0.005",       "--mesh", "here.ply"};

TEST_F(SolidTouch, TheNominalMeshIsMovedToTheTouchesAndTheResultIsRechecked) {
  const Ran ran = locate(kTouched + Words{"-o", "r.json", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json result = ran.json();
  EXPECT_GT(result["clearance"], 1.5);
  EXPECT_EQ(result["warnings"], Json::array());
  for (const char* words : {"assumed            the surface of the blank and that of its nominal mesh",
                            "assumed            that place is the nominal mesh turned by",
                            "assumed            each touch is the centre of a ball of 3 mm", "here.ply"})
    EXPECT_NE(ran.err.find(words), std::string::npos) << words << " is not in\n" << ran.err;
  EXPECT_EQ(run(folder_.path(), {"verify", "r.json"}).status, 1);  // there is no proof of a bound
  // Files that have gone elsewhere are named.
  fs::create_directory(folder_ / "old");
  for (const char* const name : {"casting.stl", "touches.xyz"})
    fs::rename(folder_ / name, folder_ / "old" / name);
  EXPECT_EQ(run(folder_.path(), {"verify", "r.json"}).status, 4);
  const Ran there = run(folder_.path(), {"verify", "r.json", "--points", "old/touches.xyz", "--nominal-blank",
                                         "old/casting.stl"});
  EXPECT_EQ(there.status, 1) << there.err;
  Json other = result;
  other["scan"]["touches"]["form"] = 0.09;
  write_bytes(folder_ / "r.json", other.dump());
  EXPECT_EQ(run(folder_.path(),
                {"verify", "r.json", "--points", "old/touches.xyz", "--nominal-blank", "old/casting.stl"})
                .status,
            4);
}

TEST_F(SolidTouch, WordsThatDoNotGoTogetherAreRefusedInOneSentence) {
  const Words nominal{"--nominal-blank", "casting.stl"};
  for (const auto& [words, sentence] :
       {std::pair{Words{"--form", "0.1"}, "need --nominal-blank FILE"},
        {Words{"--ball", "3"}, "need --nominal-blank FILE"},
        {Words{"--nominal-window", "5", "2"}, "need --nominal-blank FILE"},
        {nominal + Words{"--uncertainty", "0.01", "--mesh", "m.ply"}, "--nominal-blank needs --form MM"},
        {nominal + Words{"--uncertainty", "0.01", "--form", "1"}, "--nominal-blank needs --mesh FILE.ply"},
        {nominal + Words{"--form", "1"}, "--nominal-blank needs --uncertainty MM"},
        {kTouched + Words{"--min-radius", "3"},
         "--min-radius is for a scan, and --nominal-blank for touches"},
        {kTouched + Words{"--max-dip", "3"}, "--max-dip is for a scan"},
        {kTouched + Words{"--underside", "z=0", "--flat", "1"}, "--underside is for a scan"},
        {kTouched + Words{"--mesh-step", "1"}, "--mesh-step is for a scan"},
        {kTouched + Words{"--nominal-window", "0", "2"}, "\"0\" is not a length in mm above 0"},
        {kTouched + Words{"--nominal-window", "5", "46"},
         "\"46\" is not a length in mm and an angle from 0 to 45"}}) {
    const Ran ran = locate(words);
    EXPECT_EQ(ran.status, 2) << ran.err;
    EXPECT_NE(ran.err.find(sentence), std::string::npos) << ran.err;
  }
}

}  // namespace
}  // namespace lekalo::test::cli_solid_touch_test
