#include <cmath>
#include <numbers>
#include <sstream>

#include "e2e/cli_run.hpp"
#include "support/places.hpp"

/// `lekalo locate` with demands by feature, criteria, locked shifts, drawings and scans, as a person runs it.
namespace lekalo::test::cli_demands_test {
namespace {

std::string example(const std::string& name) { return cases::source_dir() + "/examples/regions/" + name; }
Words bracket(const Words& more) {
  Words words{"locate", "--part",  example("bracket.json"), "--blank", example("casting.json"), "--json",
              "-o",     "out.json"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

class Demands : public testing::Test {
 protected:
  Json located(const Words& words, int status = 0) {
    const Ran ran = run(folder_.path(), words);
    EXPECT_EQ(ran.status, status) << ran.err;
    said_ = ran.err;
    return ran.out.empty() ? Json() : ran.json();
  }
  int verified() { return run(folder_.path(), {"verify", "out.json"}).status; }
  /// The result with one field changed is refuted.
  void expect_lie_is_seen(const std::string& path, const Json& value) {
    Json wrong = Json::parse(read_bytes(folder_ / "out.json"));
    wrong.at(path) = value;
    write_bytes(folder_ / "wrong.json", wrong.dump());
    EXPECT_EQ(run(folder_.path(), {"verify", "wrong.json"}).status, 4) << path;
  }

  TemporaryFolder folder_;
  std::string said_;
};

TEST_F(Demands, EveryFeatureGetsItsAllowanceAndLiesAboutItAreSeen) {
  write_bytes(folder_ / "features.json", R"({"units": "mm", "minimum": 0.3, "features": [
    {"name": "bore", "contour": 1, "minimum": 0.5, "maximum": 3.5},
    {"name": "base", "edges": [0, 2], "minimum": 0.4, "scale": 2}]})");
  const Json result = located(bracket({"--features", "features.json", "--report", "out.svg"}));
  EXPECT_EQ(result["status"], "optimal");
  const Json& demands = result["demands"];
  EXPECT_GT(demands["margin"], 0.5);
  EXPECT_GE(demands["margin_bound"], demands["margin"]);
  EXPECT_TRUE(result["upper_bound"].is_null());
  EXPECT_EQ(verified(), 0);
  const std::string page = read_bytes(folder_ / "out.svg");
  for (const char* word : {"bore", "base", "all other edges"})
    EXPECT_NE(page.find(word), std::string::npos) << word;

  expect_lie_is_seen("/demands/margin", demands["margin"].get<double>() + 0.05);
  expect_lie_is_seen("/demands/margin_bound", demands["margin_bound"].get<double>() - 0.2);
  expect_lie_is_seen("/demands/largest", demands["largest"].get<double>() - 0.01);
  expect_lie_is_seen("/demands/features/0/minimum", 3.0);
  expect_lie_is_seen("/demands/features/0/maximum", 1.0);
  expect_lie_is_seen("/demands/features/1/edges", Json::array({0, 0}));
  expect_lie_is_seen("/demands/features/1/edges", Json::array({0, 999}));
  expect_lie_is_seen("/demands/bound", -1.0);
  expect_lie_is_seen("/x", result["x"].get<double>() + 1);
}

TEST_F(Demands, WhatCannotBeMetIsProvedAndNamed) {
  write_bytes(folder_ / "features.json", R"({"features": [{"name": "bore", "contour": 1, "minimum": 2.5}]})");
  const Json result = located(bracket({"--features", "features.json"}), 1);
  EXPECT_EQ(result["status"], "infeasible");
  EXPECT_LT(result["demands"]["margin_bound"], 0);
  EXPECT_GT(result["shortfall"], 0);
  EXPECT_NE(said_.find("No placement meets the demands"), std::string::npos) << said_;
  EXPECT_EQ(verified(), 0);
}

/// The bore lies in the middle of a leg of 40, where what the two edges beside it demand just meets. With a
/// little less a crack is left, which the growth closes.
TEST_F(Demands, WhatJustClosesABoreIsProvedToBeMissing) {
  for (const char* const minimum : {"20", "20.0000000001", "19.99999999985", "19.9999999997", "19.999"}) {
    SCOPED_TRACE(minimum);
    write_bytes(folder_ / "features.json",
                R"({"units": "mm", "features": [{"name": "outline", "contour": 0, "minimum": )" +
                    std::string(minimum) + "}]}");
    EXPECT_EQ(located(bracket({"--features", "features.json"}), 1)["status"], "infeasible");
    EXPECT_EQ(verified(), 0);
  }
}

TEST_F(Demands, IgnoredRegionsDoNotCount) {
  // A pad over the end of the long leg: without it the part may go further that way.
  write_bytes(folder_ / "features.json",
              R"({"minimum": 0.2, "features": [{"name": "bore", "contour": 1, "minimum": 0.2}],
    "ignore": [{"outer": [{"line": {"from": [-50, -50], "to": [500, -50]}}, {"line": {"from": [500, -50], "to": [500, 2]}},
                          {"line": {"from": [500, 2], "to": [-50, 2]}}, {"line": {"from": [-50, 2], "to": [-50, -50]}}]}]})");
  const Json result = located(bracket({"--features", "features.json"}));
  EXPECT_EQ(result["part_cut"], true);
  EXPECT_GT(result["demands"]["margin"], 1.4);
  // The checker does not cut the part itself.
  EXPECT_EQ(verified(), 0);
  expect_lie_is_seen("/part_cut", false);
}

TEST_F(Demands, AMinimumOfTheFileAloneCounts) {
  write_bytes(folder_ / "features.json", R"({"units": "mm", "minimum": 1.2})");
  const Json result = located(bracket({"--features", "features.json"}));
  EXPECT_EQ(result["demands"]["minimum"], 1.2);
  EXPECT_LT(result["demands"]["margin"], 0.6);
  EXPECT_EQ(verified(), 0);
}

TEST_F(Demands, TheSecondCriterionGivesUpNoMoreThanAllowed) {
  const Json plain = located(bracket({}));
  const Json largest = located(bracket({"--criterion", "largest", "--give-up", "0.2", "--trade-off", "3"}));
  EXPECT_GE(largest["clearance"], plain["clearance"].get<double>() - 0.2 - 2e-3);
  EXPECT_LT(largest["demands"]["largest"], 22.6);
  EXPECT_LE(largest["demands"]["smallest_largest"]["bound"], largest["demands"]["largest"]);
  EXPECT_EQ(largest["demands"]["trade_off"].size(), 3U);
  EXPECT_EQ(verified(), 0);
  for (const char* const k : {"0", "2"}) {
    const std::string point = std::string("/demands/trade_off/") + k;
    const Json& written = largest.at(point);
    expect_lie_is_seen(point + "/margin", written["margin"].get<double>() + 0.02);
    expect_lie_is_seen(point + "/largest", written["largest"].get<double>() - 0.02);
    expect_lie_is_seen(point + "/x", written["x"].get<double>() + 3);
    expect_lie_is_seen(point + "/mirrored", true);
  }
}

TEST_F(Demands, TheThirdCriterionKeepsTheSecondAndLiesAboutBothAreSeen) {
  const Json result = located(bracket({"--criterion", "even", "--give-up", "0.2"}));
  EXPECT_EQ(result["status"], "optimal");
  const Json& demands = result["demands"];
  const Json& second = demands["smallest_largest"];
  const auto number = [](const Json& value) { return value.get<double>(); };
  EXPECT_GE(demands["margin"], second["margin"]);
  EXPECT_LE(number(demands["largest"]), number(second["bound"]) + number(second["gap"]));
  EXPECT_EQ(verified(), 0);

  const std::string at = "/demands/smallest_largest/";
  // What was kept of the margin and of the largest allowance.
  expect_lie_is_seen("/demands/give_up", 0.1);
  expect_lie_is_seen("/demands/give_up", 0.3);
  expect_lie_is_seen("/demands/criterion", "smallest");
  expect_lie_is_seen("/demands/margin", number(second["margin"]) - 0.001);  // true, but too much given up
  expect_lie_is_seen("/demands/largest", number(second["kept"]) + 0.001);
  expect_lie_is_seen("/demands/margin_found", number(demands["margin_found"]) + 0.01);
  expect_lie_is_seen("/demands/margin_found", number(demands["margin_found"]) - 0.01);
  expect_lie_is_seen("/demands/margin_gap", 1e-9);
  expect_lie_is_seen("/demands/smallest_largest", nullptr);
  expect_lie_is_seen(at + "margin", number(second["margin"]) + 0.001);
  expect_lie_is_seen(at + "margin", number(second["margin"]) - 0.001);
  expect_lie_is_seen(at + "found", number(second["bound"]) - 0.001);
  expect_lie_is_seen(at + "found", number(second["kept"]) + 0.001);
  expect_lie_is_seen(at + "kept", number(second["kept"]) + 0.001);
  expect_lie_is_seen(at + "kept", number(demands["largest"]) - 0.001);
  expect_lie_is_seen(at + "gap", 1e-6);
  // The bound and what is to prove it.
  expect_lie_is_seen(at + "bound", number(second["bound"]) + 1e-6);
  expect_lie_is_seen(at + "proof", nullptr);
  expect_lie_is_seen(at + "proof/bound", number(second["proof"]["bound"]) - 0.01);
  expect_lie_is_seen(at + "proof/bound", number(second["margin"]));
  expect_lie_is_seen(at + "proof/most", number(second["proof"]["most"]) + 0.01);
  expect_lie_is_seen(at + "proof/shift", number(second["proof"]["shift"]) + 0.01);
  expect_lie_is_seen(at + "proof/grown_for", 0.1);
  expect_lie_is_seen("/largest_certificate/trees", Json::array());
  expect_lie_is_seen("/largest_certificate/pivot", Json::array({1000, 0}));
  expect_lie_is_seen("/largest_certificate/trees", result["certificate"]["trees"]);
  const std::string tree = "/largest_certificate/trees/0/";
  expect_lie_is_seen(tree + "theta", Json::array({0, 6}));
  expect_lie_is_seen(tree + "x", Json::array({0, 100}));
  Json nodes = result.at(tree + "nodes");
  ASSERT_GT(nodes.size(), 10U);
  Json fewer = nodes;
  fewer.erase(fewer.size() - 1);
  expect_lie_is_seen(tree + "nodes", fewer);
  // The bound raised to what the best has, with a tree that would prove it if balls were larger.
  Json wrong = result;
  for (const char* const key : {"most", "bound"}) {
    Json& value = wrong.at(at + (key == std::string("most") ? "proof/most" : key));
    value = number(value) + 0.9 * (number(second["found"]) - number(second["bound"]));
  }
  std::size_t caps = 0;
  for (Json& node : wrong.at(tree + "nodes"))
    if (node.is_object())
      for (Json& contact : node["contacts"])
        if (contact.size() == 8) contact[5] = number(contact[5]) + 0.1, ++caps;
  EXPECT_GT(caps, 0U);
  write_bytes(folder_ / "wrong.json", wrong.dump());
  EXPECT_EQ(run(folder_.path(), {"verify", "wrong.json"}).status, 4);

  // Without it nothing is proved of largest allowances, and the word is not "confirmed".
  wrong = result;
  wrong["largest_certificate"] = nullptr;
  write_bytes(folder_ / "wrong.json", wrong.dump());
  const Ran unproved = run(folder_.path(), {"verify", "wrong.json"});
  EXPECT_EQ(unproved.out.find("Confirmed"), std::string::npos) << unproved.out;
  EXPECT_NE(unproved.status, 0);
}

TEST_F(Demands, ASecondCriterionThatIsCutShortSaysSo) {
  const Json result = located(bracket({"--criterion", "even", "--give-up", "0.2", "--work", "2000"}));
  EXPECT_EQ(result["status"], "stopped");
  const Json& second = result["demands"]["smallest_largest"];
  EXPECT_GT(second["found"].get<double>() - second["bound"].get<double>(), second["gap"].get<double>());
  EXPECT_LE(result["demands"]["largest"], second["found"]);
  EXPECT_EQ(verified(), 0);
  expect_lie_is_seen("/status", "optimal");
}

TEST_F(Demands, BothCertificatesStandInTheFileAskedFor) {
  const Json result = located(bracket({"--criterion", "largest", "--certificate", "proof.json"}));
  EXPECT_TRUE(result["certificate"].is_null());
  EXPECT_TRUE(result["largest_certificate"].is_null());
  const Json file = Json::parse(read_bytes(folder_ / "proof.json"));
  EXPECT_FALSE(file["certificate"]["trees"].empty());
  EXPECT_FALSE(file["largest_certificate"]["trees"].empty());
  EXPECT_EQ(verified(), 0);
}

TEST_F(Demands, ALockedShiftStaysAndIsSaidInTheResult) {
  const Json free = located(bracket({}));
  const Json result = located(bracket({"--lock-x", "211", "--lock-y", "95"}));
  EXPECT_EQ(result["x"], 211);
  EXPECT_EQ(result["y"], 95);
  EXPECT_LT(result["clearance"], free["clearance"]);
  EXPECT_EQ(verified(), 0);
  expect_lie_is_seen("/locked/x", 212);
  expect_lie_is_seen("/locked/y", nullptr);
}

TEST_F(Demands, ADrawingOfThePlacementCanBePlacedAgain) {
  for (const std::string ending : {"dxf", "svg"}) {
    SCOPED_TRACE(ending);
    const Json first = located(bracket({"--drawing", "placed." + ending}));
    const std::string drawing = "placed." + ending;
    const Json again =
        located({"locate", "--part", drawing, "--part-layers", "PART", "--blank", drawing, "--blank-layers",
                 "BLANK", "--window", "-2", "2", "--json", "-o", "out.json"});
    EXPECT_NEAR(again["clearance"], first["clearance"].get<double>(), 1.5e-3);
    EXPECT_NEAR(again["theta"], 0, 1e-4);
    EXPECT_EQ(verified(), 0);
  }
}

/// n points around an ellipse, on the share of it that is measured.
std::string ellipse_scan(int n, double share) {
  std::ostringstream text;
  text.precision(12);
  for (int i = 0; i < n * share; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    text << 200 + 80 * std::cos(t) << ' ' << 100 + 62 * std::sin(t) << '\n';
  }
  return text.str();
}

TEST_F(Demands, AScanGivesWhatItProvesAndUnknownStretchesAreNoYes) {
  write_bytes(
      folder_ / "part.json",
      R"({"shape": {"difference": [{"rectangle": {"size": [100, 60]}}, {"circle": {"radius": 10}}]}})");
  write_bytes(folder_ / "scan.csv", ellipse_scan(600, 1));
  const Words outline{"locate", "--part", "part.json", "--blank", "scan.csv", "--window",
                      "-10",    "10",     "--json",    "-o",      "out.json"};
  const double measured = located(outline)["clearance"];
  Words words = outline;
  words.insert(words.end(), {"--uncertainty", "0.01", "--min-radius", "5"});
  const Json whole = located(words);
  EXPECT_EQ(whole["scan"]["proved"], true);
  EXPECT_LT(whole["clearance"], measured - 0.02);
  EXPECT_GT(whole["clearance"], measured - 0.12);
  EXPECT_FALSE(whole["scan"]["assumptions"].empty());
  EXPECT_EQ(verified(), 0);

  write_bytes(folder_ / "scan.csv", ellipse_scan(600, 0.95));
  const Json gap = located(words, 1);
  EXPECT_EQ(gap["scan"]["proved"], false);
  EXPECT_EQ(gap["scan"]["unknown"].size(), 1U);
  EXPECT_NE(said_.find("unknown"), std::string::npos) << said_;
}

}  // namespace
}  // namespace lekalo::test::cli_demands_test
