#include <sstream>

#include "e2e/cli_run.hpp"
#include "support/places.hpp"

/// `lekalo locate` where a shape is more than a convex polygon, as a person runs it.
namespace lekalo::test::cli_regions_test {
namespace {

std::string example(const std::string& name) { return cases::source_dir() + "/examples/regions/" + name; }

TEST(Regions, TheBracketInItsCastingGetsEveryOutputAndVerifyConfirmsIt) {
  const TemporaryFolder folder;
  const Ran ran =
      run(folder.path(), {"locate", "--part", example("bracket.json"), "--blank", example("casting.json"),
                          "--nc", example("bracket.nc"), "--nc-out", "out.nc", "--picture", "out.svg", "-o",
                          "out.json", "--certificate", "out.cert", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto files = folder.files();
  EXPECT_EQ(files.size(), 4U);
  EXPECT_EQ(files.at("out.json"), ran.out);
  EXPECT_NE(files.at("out.svg").find("<svg"), std::string::npos);
  const Json result = ran.json();
  EXPECT_EQ(result["status"], "optimal");
  const double clearance = result["clearance"], bound = result["upper_bound"];
  EXPECT_GT(clearance, 1.646);
  EXPECT_LE(bound - clearance, 1e-3);
  EXPECT_EQ(result["mirrored"], false);
  EXPECT_EQ(result["regions"]["part"]["holes"].size(), 4U);
  EXPECT_FALSE(result["contacts"].empty());
  EXPECT_TRUE(result["certificate"].is_null());
  EXPECT_LT(result["nc"]["clearance"], clearance);
  EXPECT_EQ(run(folder.path(), {"verify", "out.json"}).status, 0);

  // The same bytes again, and with the proof inside.
  const Ran again =
      run(folder.path(), {"locate", "--part", example("bracket.json"), "--blank", example("casting.json"),
                          "-o", "inside.json", "--picture", "again.svg"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(read_bytes(folder / "again.svg"), files.at("out.svg"));
  EXPECT_EQ(run(folder.path(), {"verify", "inside.json"}).status, 0);

  // A clearance that is not there is refuted.
  std::string bytes = files.at("out.json");
  const std::string field = "\"clearance\": 1.6";
  bytes.replace(bytes.find(field), field.size(), "\"clearance\": 1.7");
  write_bytes(folder / "wrong.json", bytes);
  EXPECT_EQ(run(folder.path(), {"verify", "wrong.json"}).status, 4);
}

TEST(Regions, ABlankWithTooLargeACoreIsProvedScrapWithAPicture) {
  const TemporaryFolder folder;
  write_bytes(
      folder / "part.json",
      R"({"units": "mm", "outer": [{"line": {"from": [0, 0], "to": [60, 0]}}, {"line": {"from": [60, 0], "to": [60, 40]}},
 {"line": {"from": [60, 40], "to": [0, 40]}}, {"line": {"from": [0, 40], "to": [0, 0]}}],
 "holes": [[{"arc": {"from": [35, 20], "to": [35, 20], "centre": [30, 20], "ccw": true}}]]})");
  write_bytes(
      folder / "blank.json",
      R"({"units": "mm", "outer": [{"line": {"from": [-2, -2], "to": [62, -2]}}, {"line": {"from": [62, -2], "to": [62, 42]}},
 {"line": {"from": [62, 42], "to": [-2, 42]}}, {"line": {"from": [-2, 42], "to": [-2, -2]}}],
 "holes": [[{"arc": {"from": [37, 20], "to": [37, 20], "centre": [30, 20], "ccw": true}}]]})");
  const Ran ran = run(folder.path(),
                      {"locate", "--part", "part.json", "--blank", "blank.json", "--json", "-o", "out.json",
                       "--picture", "out.svg", "--nc", example("bracket.nc"), "--nc-out", "out.nc"});
  EXPECT_EQ(ran.status, 1) << ran.err;
  const Json result = ran.json();
  EXPECT_EQ(result["status"], "infeasible");
  EXPECT_LT(result["upper_bound"], -1.8);  // a sixteenth of what is missing may be left open
  EXPECT_NEAR(result["shortfall"], 2, 0.05);
  EXPECT_EQ(folder.files().count("out.nc"), 0U);
  EXPECT_NE(read_bytes(folder / "out.svg").find("sticks out"), std::string::npos);
  EXPECT_EQ(run(folder.path(), {"verify", "out.json"}).status, 0);
}

TEST(Regions, AMirroredPlacementIsFoundAndItsProgramWithheld) {
  const TemporaryFolder folder;
  // An L, and the blank of its mirror image.
  write_bytes(folder / "part.json", R"({"units": "mm", "outer": [{"line": {"from": [0, 0], "to": [60, 0]}},
 {"line": {"from": [60, 0], "to": [60, 15]}}, {"line": {"from": [60, 15], "to": [20, 15]}},
 {"line": {"from": [20, 15], "to": [20, 40]}}, {"line": {"from": [20, 40], "to": [0, 40]}}, {"line": {"from": [0, 40], "to": [0, 0]}}]})");
  write_bytes(folder / "blank.json", R"({"units": "mm", "outer": [{"line": {"from": [1, -1], "to": [1, 41]}},
 {"line": {"from": [1, 41], "to": [-21, 41]}}, {"line": {"from": [-21, 41], "to": [-21, 16]}},
 {"line": {"from": [-21, 16], "to": [-61, 16]}}, {"line": {"from": [-61, 16], "to": [-61, -1]}}, {"line": {"from": [-61, -1], "to": [1, -1]}}]})");
  const Words words{"locate", "--part", "part.json", "--blank", "blank.json", "--json"};
  EXPECT_EQ(run(folder.path(), words).json()["status"], "infeasible");
  const Ran ran = run(folder.path(), words + Words{"--mirror", "either", "-o", "out.json", "--nc",
                                                   example("bracket.nc"), "--nc-out", "out.nc"});
  EXPECT_EQ(ran.status, 1) << ran.err;
  const Json result = ran.json();
  EXPECT_EQ(result["status"], "optimal");
  EXPECT_EQ(result["mirrored"], true);
  EXPECT_NEAR(result["clearance"], 1, 1e-3);
  EXPECT_EQ(result["certificate"]["trees"].size(), 2U);
  EXPECT_EQ(folder.files().count("out.nc"), 0U);
  EXPECT_EQ(run(folder.path(), {"verify", "out.json"}).status, 0);
}

TEST(Regions, BadShapesAndOptionsAreRefusedInOneSentence) {
  struct Case {
    std::string part;
    Words more;
    int status;
    std::string sentence;
  };
  const std::string line = R"({"line": {"from": [)";
  const std::string bow =
      R"({"units": "mm", "outer": [{"line": {"from": [0, 0], "to": [10, 10]}}, {"line": {"from": [10, 10], "to": [10, 0]}},
 {"line": {"from": [10, 0], "to": [3, 9]}}, {"line": {"from": [3, 9], "to": [0, 0]}}]})";
  const std::string good = read_bytes(example("bracket.json"));
  const std::vector<Case> table{
      {bow, {}, 3, "meets edge"},
      {R"({"units": "mm", "outer": []})", {}, 3, "part.json"},
      {R"({"units": "mm", "outer": [{"arc": {"from": [1, 0], "to": [0, 2], "centre": [0, 0], "ccw": true}}, {"line": {"from": [0, 2], "to": [1, 0]}}]})",
       {},
       3,
       "part.json"},
      {R"({"units": "mm", "outer": [{"spline": {}}]})", {}, 3, "part.json"},
      {good.substr(0, good.size() / 2), {}, 3, "part.json"},
      {good, {"--method", "icp"}, 2, "is for convex contours"},
      {good, {"--trim", "1"}, 2, "is for convex contours"},
      {good, {"--mirror", "perhaps"}, 2, "not one of"},
      {good, {"--gap", "-1"}, 2, "--gap"},
      {good, {"--units", "inch"}, 3, "part.json"},
  };
  for (const Case& one : table) {
    const TemporaryFolder folder;
    write_bytes(folder / "part.json", one.part);
    const Ran ran = run(folder.path(), Words{"locate", "--part", "part.json", "--blank",
                                             example("casting.json"), "-o", "out.json"} +
                                           one.more);
    EXPECT_EQ(ran.status, one.status) << ran.err;
    EXPECT_NE(ran.err.find(one.sentence), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_EQ(folder.files().count("out.json"), 0U);
  }
}

}  // namespace
}  // namespace lekalo::test::cli_regions_test
