// `lekalo fit` as people use it: results, files, and one sentence for what is wrong, with nothing written.

#include <gtest/gtest.h>

#include "cli_run.hpp"

namespace lekalo::test::cli_fit_test {
namespace {

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

const Words kSizes{"--hub-outer", "36", "--length", "18", "--shaft-length", "54", "--material", "C45"};

TEST(CliFit, WritesAResultThatVerifyKnows) {
  const TemporaryFolder folder;
  const Ran made = run(folder.path(), with({"fit", "--fit", "18H8/z8", "-o", "fit.json"}, kSizes));
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("DIN 7190"), std::string::npos);
  const Ran verified = run(folder.path(), {"verify", "fit.json"});
  EXPECT_EQ(verified.status, 1) << "what the elements say is not proved: " << verified.err;
  EXPECT_NE(verified.err.find("computed by finite elements and not proved"), std::string::npos)
      << verified.err;
  Json lie = Json::parse(read_bytes(folder / "fit.json"));
  lie["cases"][0]["interference_um"] = 34;
  write_bytes(folder / "lie.json", lie.dump());
  EXPECT_EQ(run(folder.path(), {"verify", "lie.json"}).status, 4);
}

TEST(CliFit, AStatedInterferenceIsOneCase) {
  const TemporaryFolder folder;
  const Ran made =
      run(folder.path(),
          with({"fit", "--diameter", "18", "--interference", "0.04", "--yield", "340", "--json"}, kSizes));
  ASSERT_EQ(made.status, 0) << made.err;
  const Json cases = made.json()["cases"];
  ASSERT_EQ(cases.size(), 1U);
  EXPECT_EQ(cases[0]["interference_um"], 40);
  EXPECT_EQ(cases[0]["state"], "plastic");
}

TEST(CliFit, TwoStatedInterferencesAreThreeCases) {
  const TemporaryFolder folder;
  const Ran made = run(folder.path(), with({"fit", "--diameter", "18", "--interference", "0.02,0.03",
                                            "--cylindrical", "seat", "-o", "fit.json"},
                                           kSizes));
  ASSERT_EQ(made.status, 0) << made.err;
  const Json result = Json::parse(read_bytes(folder / "fit.json"));
  ASSERT_EQ(result["cases"].size(), 3U);
  EXPECT_EQ(result["cases"][1]["interference_um"], 25);
  EXPECT_EQ(result["correction"]["nominal_mm"], 18.025);
  EXPECT_EQ(run(folder.path(), {"verify", "fit.json"}).status, 1);
}

TEST(CliFit, WhatIsElasticIsAsItWasAfterTakingApart) {
  const TemporaryFolder folder;
  const Ran made = run(folder.path(), {"fit", "--diameter", "40", "--interference", "0.02", "--hub-outer",
                                       "60", "--length", "30", "--ring", "80,0.03", "--material", "C45"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("the outermost ring's outside +"), std::string::npos) << made.err;
  EXPECT_NE(made.err.find("hub's bore +0.00, outside +0.00"), std::string::npos) << made.err;
}

TEST(CliFit, WritesTheTurnedProfile) {
  const TemporaryFolder folder;
  const Ran made =
      run(folder.path(), with({"fit", "--diameter", "18", "--interference", "0.04", "--cylindrical",
                               "outside", "--profile", "p.csv", "--picture", "p.svg", "--drawing", "p.dxf",
                               "--program", "p.ngc", "--feed", "50.25", "-o", "fit.json"},
                              kSizes));
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(folder.files().size(), 5U);
  EXPECT_NE(read_bytes(folder / "p.svg").find("outside of the hub"), std::string::npos);
  EXPECT_NE(read_bytes(folder / "p.ngc").find("G18"), std::string::npos);
  EXPECT_NE(read_bytes(folder / "p.ngc").find(" F50.25\n"), std::string::npos)
      << read_bytes(folder / "p.ngc");
  EXPECT_EQ(run(folder.path(), {"verify", "fit.json"}).status, 1);
  write_bytes(folder / "p.ngc", read_bytes(folder / "p.ngc") + " ");
  EXPECT_EQ(run(folder.path(), {"verify", "fit.json"}).status, 4);
}

TEST(CliFit, WhatIsWrongIsSaidInOneSentence) {
  const TemporaryFolder folder;
  struct Wrong {
    Words words;
    int status;
    const char* says;
  };
  for (const Wrong& w :
       {Wrong{{"--fit", "18H7/h6"}, 3, "choose a tighter fit"},
        {{"--fit", "18H8"}, 3, "like 18H8/z8"},
        {{"--fit", "18H8/t8"}, 3, "--diameter MM --interference MM"},
        {{"--diameter", "18", "--interference", "0"}, 3, "has to be above 0"},
        {{"--diameter", "18", "--interference", "-0.02"}, 3, "has to be above 0"},
        {{"--diameter", "18", "--interference", "0.3"}, 3, "does not harden"},
        {{"--diameter", "36", "--interference", "0.02"}, 3, "not above its bore"},
        {{"--diameter", "18", "--interference", "0.02", "--bore", "18"}, 3, "not below its diameter"},
        {{"--diameter", "18"}, 2, "--interference"},
        {{"--fit", "18H8/z8", "--from-end", "36.5"}, 3, "from 0 to 36 mm"},
        {{"--diameter", "18", "--interference", "0.05,0.04"}, 2, "the least comes first"},
        {{"--diameter", "18", "--interference", "0,0.04"}, 3, "has to be above 0"},
        {{"--fit", "18H8/z8", "--diameter", "18"}, 2, "say what is pressed"},
        {{"--fit", "18H8/z8", "--program", "p.ngc"}, 2, "need --cylindrical"},
        {{"--fit", "18H8/z8", "--cylindrical", "outside", "--program", "p.ngc", "--spindle", "900.5"},
         2,
         "--spindle"},
        {{"--fit", "18H8/z8", "--cylindrical", "hub"}, 2, "is not outside, bore or seat"},
        {{"--fit", "18H8/z8", "--cylindrical", "bore"}, 3, "has no bore"},
        {{"--fit", "18H8/z8", "--friction", "0.2,0.1"}, 2, "the least comes first"},
        {{"--fit", "18H8/z8", "--ring", "50"}, 2, "--ring"}}) {
    const Ran ran = run(folder.path(), with(with({"fit", "-o", "fit.json"}, w.words), kSizes));
    EXPECT_EQ(ran.status, w.status) << ran.err;
    EXPECT_NE(ran.err.find(w.says), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_TRUE(folder.files().empty());
  }
}

}  // namespace
}  // namespace lekalo::test::cli_fit_test
