#include "e2e/cli_run.hpp"

/// Numbers beyond the limits of docs/limits.md are a mistake of their file, with exit status 3, and never one
/// of lekalo (4). Files of an attack on 0.1 that got 4 stand in tests/corpus/data/attack.
namespace lekalo::test::cli_limits_test {
namespace {

struct Attack {
  std::string name;
  Words words;
  Words named;  ///< what the sentence has to contain: file, place, limit
};

void PrintTo(const Attack& attack, std::ostream* out) { *out << attack.name; }

std::string attack_file(const std::string& name) {
  return cases::source_dir() + "/tests/corpus/data/attack/" + name;
}
std::string region(const std::string& name) { return cases::source_dir() + "/examples/regions/" + name; }

Attack features(const std::string& number, const Words& named) {
  const std::string file = "bad_features_" + number + ".json";
  return {"features " + number,
          {"locate", "--part", region("bracket.json"), "--blank", region("casting.json"), "--features",
           attack_file(file), "-o", "r.json"},
          Words{file, "minimum", "1e+09 mm"} + named};
}

std::vector<Attack> attacks() {
  const Words contour{"locate", "--part", attack_file("contour-part.csv"), "--blank"};
  return {
      {"contour 1e-500",
       contour + Words{attack_file("contour-1e-500.csv"), "-o", "r.json"},
       {"contour-1e-500.csv", "line 4", "1e-500", "1e-400"}},
      {"contour 1e-999999",
       contour + Words{attack_file("contour-1e-999999.csv"), "-o", "r.json"},
       {"contour-1e-999999.csv", "line 4", "1e-999999", "1e-400"}},
      features("100", {"\"outline\"", "4294967296"}),
      features("1249", {"\"outline\""}),
      features("1419", {"\"outline\"", "4294967300.29"}),
      features("1592", {}),
      features("1796", {"\"outline\""}),
      features("988", {"2147483648"}),
      {"copy -1, checked",
       {"check", attack_file("copy-minus-one.json")},
       {"copy-minus-one.json", "placements[0].copy", "-1", "from 0 to 1000000000"}},
      {"copy -1, exported",
       {"export", attack_file("copy-minus-one.json"), "-o", "e.json"},
       {"copy-minus-one.json", "placements[0].copy", "-1"}},
      {"a centre beyond the limits",
       {"locate", "--part", region("bracket.json"), "--blank", attack_file("bad_region_408.json"), "-o",
        "r.json"},
       {"bad_region_408.json", "edge 10", "centre", "1e+15", "1e+09 mm"}},
  };
}

class Attacks : public testing::TestWithParam<Attack> {};

TEST_P(Attacks, AreRefusedWithFilePlaceAndLimit) {
  const TemporaryFolder folder;
  const Ran ran = run(folder.path(), GetParam().words);
  EXPECT_EQ(ran.status, 3) << ran.err;
  for (const std::string& word : GetParam().named)
    EXPECT_NE(ran.err.find(word), std::string::npos) << "no \"" << word << "\" in: " << ran.err;
  EXPECT_TRUE(folder.files().empty());
}

TEST(CliLimits, APartAtTheLimitOfCoordinatesIsAnsweredWithAProof) {
  const TemporaryFolder folder;
  const Ran ran = run(folder.path(), {"locate", "--part", attack_file("part.csv"), "--blank",
                                      attack_file("blank.csv"), "-o", "r.json"});
  EXPECT_EQ(ran.status, 1) << ran.err;
  EXPECT_NE(ran.err.find("this is proved"), std::string::npos) << ran.err;
}

/// A search that is stopped while its cells are large has a bound that the checker does not prove as it is.
TEST(CliLimits, AWildPointOfAScanIsAnsweredWithABoundThatTheCheckerProves) {
  const TemporaryFolder folder;
  std::string scan = read_bytes(region("flange-scan.csv"));
  const std::string number = "245.764";
  ASSERT_NE(scan.find(number), std::string::npos);
  scan.replace(scan.find(number), number.size(), "3600");
  write_bytes(folder / "scan.csv", scan);
  fs::copy(region("flange.json"), folder / "flange.json");
  const Ran ran =
      run(folder.path(), {"locate", "--part", "flange.json", "--blank", "scan.csv", "--uncertainty", "0.01",
                          "--min-radius", "4", "--work", "100", "-o", "r.json"});
  EXPECT_LE(ran.status, 1) << ran.err;
  EXPECT_NE(ran.err.find("the checker proves"), std::string::npos) << ran.err;
  const Ran verified = run(folder.path(), {"verify", "r.json"});
  EXPECT_EQ(verified.status, 1);
  EXPECT_NE(verified.err.find("not measured, and nothing is proved there"), std::string::npos)
      << verified.err;
}

std::string test_name(const testing::TestParamInfo<Attack>& info) {
  std::string name;
  for (const char c : info.param.name) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Files, Attacks, testing::ValuesIn(attacks()), test_name);

}  // namespace
}  // namespace lekalo::test::cli_limits_test
