// The checker's own reader of files of features.

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>

#include "verify/locate/feature_check.hpp"
#include "verify/locate/feature_file.hpp"

namespace lekalo::verify::verify_features_test {
namespace {

struct Reading {
  StatedDemands stated;
  std::string complaint;
};
Reading read(const std::string& text, LengthUnit unit = LengthUnit::millimetre) {
  const Result<Json> root = parse_json(text, "features.json");
  EXPECT_TRUE(root) << text;
  Reading reading;
  reading.stated = read_features(*root, unit, reading.complaint);
  return reading;
}

TEST(VerifyFeatures, EveryWordOfAFileIsTaken) {
  const auto [stated, complaint] = read(R"({"units": "mm", "minimum": 0.5, "features": [
    {"name": "base", "edges": [0, 7], "minimum": 1.5, "target": 2, "maximum": 4, "scale": 3},
    {"name": "bore", "contour": 1, "finished": 0.01},
    {"name": "slot", "label": "SLOT", "minimum": null}], "ignore": [{"outer": []}]})");
  EXPECT_EQ(complaint, "");
  EXPECT_TRUE(stated.unit);
  EXPECT_FALSE(stated.ignored.empty());
  EXPECT_EQ(stated.minimum, 0.5);
  ASSERT_EQ(stated.features.size(), 3U);
  const StatedFeature &base = stated.features[0], &bore = stated.features[1], &slot = stated.features[2];
  EXPECT_EQ(base.name, "base");
  EXPECT_EQ(base.edges, (std::vector<std::size_t>{0, 7}));
  EXPECT_EQ(base.numbers.minimum, 1.5);
  EXPECT_EQ(base.numbers.target, 2);
  EXPECT_EQ(base.numbers.maximum, 4);
  EXPECT_EQ(base.numbers.scale, 3);
  EXPECT_FALSE(base.numbers.finished || base.contour || base.label);
  EXPECT_EQ(bore.contour, 1U);
  EXPECT_EQ(bore.numbers.finished, 0.01);
  EXPECT_EQ(bore.numbers.scale, 1);
  EXPECT_EQ(slot.label, "SLOT");
  EXPECT_EQ(slot.numbers.minimum, 0);
}

TEST(VerifyFeatures, AnEmptyFileDemandsNothing) {
  const auto [stated, complaint] = read("{}");
  EXPECT_EQ(complaint, "");
  EXPECT_FALSE(stated.unit || !stated.ignored.empty());
  EXPECT_EQ(stated.minimum, 0);
  EXPECT_TRUE(stated.features.empty());
  EXPECT_TRUE(read(R"({"ignore": []})").stated.ignored.empty());
}

TEST(VerifyFeatures, InchesAreTakenWhereTheFileOrTheCallerSaysSo) {
  const std::string features = R"("features": [{"name": "a", "edges": [0], "minimum": 0.1, "scale": 2}]})";
  const Reading said = read(R"({"units": "inch", "minimum": 1, )" + features);
  EXPECT_EQ(said.complaint, "");
  EXPECT_EQ(said.stated.minimum, 25.4);
  EXPECT_EQ(said.stated.features.at(0).numbers.minimum, 25.4 * 0.1);
  EXPECT_EQ(said.stated.features.at(0).numbers.scale, 2);
  EXPECT_EQ(read(R"({"minimum": 1, )" + features, LengthUnit::inch).stated.minimum, 25.4);
  EXPECT_EQ(read(R"({"units": "mm", "minimum": 1, )" + features, LengthUnit::inch).stated.minimum, 1);
}

TEST(VerifyFeatures, NumbersAreDoublesAndTheFirstUnknownWordIsTold) {
  const std::string most = "1.7976931348623157e308";
  const auto with = [](const std::string& words) {
    return read(R"({"features": [{"name": "a", "edges": [0], )" + words + "}]}").complaint;
  };
  for (const std::string key : {"minimum", "target", "maximum", "scale", "finished"}) {
    EXPECT_EQ(with('"' + key + "\": " + most), "") << key;
    EXPECT_NE(with('"' + key + "\": 1e390"), "") << key;
  }
  EXPECT_EQ(with(R"("minimum": 0, "target": 0)"), "");
  EXPECT_EQ(read(R"({"minimum": 0})").complaint, "");
  EXPECT_EQ(read(R"({"one": 1, "two": 2})").complaint, "\"one\" is no word of a file of features");
}

/// A part that is a square, with demands made of one feature of its edges, and the file of features.
struct Held {
  std::string demands = R"([{"name": "a", "edges": [0], "minimum": 1, "scale": 1, "maximum": null,
    "finished": null, "target": null}])";
  std::string minimum = "0";
  bool part_cut = false, without_demands = false;
  Origin origin;
  bool whole = false;

  std::string by(const std::string& file) {
    std::string complaint;
    const std::string square =
        R"({"outer": [{"line": {"from": [0, 0], "to": [9, 0]}}, {"line": {"from": [9, 0], "to": [9, 9]}},
        {"line": {"from": [9, 9], "to": [0, 9]}}, {"line": {"from": [0, 9], "to": [0, 0]}}]})";
    const Shape part = read_shape(*parse_json(square, "part"), "part", complaint);
    const std::string text = R"({"minimum": )" + minimum + R"(, "features": )" + demands +
                             R"(, "criterion": "smallest", "give_up": 0, "margin": 0, "margin_bound": 0,
      "margin_found": 0, "margin_gap": 0, "largest": 50, "smallest_largest": null, "trade_off": [], "grown_for": 0,
      "shift": 0, "bound": 0})";
    const WrittenDemands read = read_demands(*parse_json(text, "demands"), complaint);
    EXPECT_EQ(complaint, "");
    LocateReport report;
    std::optional<Document> document;
    if (!file.empty()) document = Document{"f.json", file};
    whole = check_features(
        document, {without_demands ? nullptr : &read, *parse_decimal(minimum), part, part_cut, origin},
        report);
    std::string all;
    for (const std::string& finding : report.findings) all += finding + "\n";
    for (const std::string& note : report.notes) all += note + "\n";
    return all;
  }
};
const std::string kOne = R"("features": [{"name": "a", "edges": [0], "minimum": 1}])";

TEST(VerifyFeatures, DemandsAreHeldAgainstTheirFile) {
  EXPECT_EQ(Held().by("{" + kOne + "}"), "");
  EXPECT_EQ(Held().by(R"({"units": "mm", )" + kOne + "}"), "");
  // In inches only where the file does not say mm.
  Held inches;
  inches.demands.replace(inches.demands.find("\"minimum\": 1"), 12, "\"minimum\": 25.4");
  EXPECT_EQ(inches.by("{" + kOne + "}"), "");
  const std::string not_1 = "feature \"a\": minimum is 25.4, but 1 in f.json\n";
  EXPECT_EQ(inches.by(R"({"units": "mm", )" + kOne + "}"), not_1);
  inches.demands.replace(inches.demands.find("25.4"), 4, "2");
  EXPECT_EQ(inches.by("{" + kOne + "}"), "feature \"a\": minimum is 2, but 1 in f.json\n");
  EXPECT_EQ(Held().by(R"({"features": [{"name": "a", "contour": 0, "minimum": 1}]})"),
            "feature \"a\" has other edges than f.json says: 0, not 0, 1, 2, 3\n");
  EXPECT_EQ(Held().by(R"({"features": [{"name": "a", "contour": 1, "minimum": 1}]})"),
            "feature \"a\" has contour 1 in f.json, which the part has not\n");

  EXPECT_EQ(Held().by(R"({"units": "mm", "features": []})"),
            "feature \"a\" of the demands is not in f.json\n");
  EXPECT_EQ(Held().by(R"({"units": "mm", "features": [{"name": "a", "edges": [0], "minimum": 1}, {"name": "b",
            "edges": [1]}]})"),
            "feature \"b\" of f.json is missing from the demands\n");
  EXPECT_EQ(Held().by("{\"units\": \"mm\", \"minimum\": 2, " + kOne + "}"),
            "demands.minimum is 0 mm, but min_allowance and f.json demand 2 mm\n");
  Held none;
  none.demands = "[]";
  EXPECT_EQ(none.by(""), "");

  Held bare;
  bare.without_demands = true;
  bare.minimum = "3";
  EXPECT_EQ(bare.by(R"({"minimum": 3})"), "");
  EXPECT_EQ(bare.by(R"({"units": "mm", "minimum": 3.5})"),
            "the minimum of f.json is 3.5 mm, but the result has no demands and a min_allowance of 3 mm\n");
  EXPECT_EQ(bare.by(""), "");
  const std::string no_file =
      "the result has demands of features or a part that is cut, but names no file of features\n";
  bare.part_cut = true;
  EXPECT_EQ(bare.by(""), no_file);
  EXPECT_EQ(Held().by(""), no_file);
}

TEST(VerifyFeatures, APartIsCutWhereTheFileIgnoresSomething) {
  const std::string ignore = R"("units": "mm", "ignore": [{"outer": []}], )";
  EXPECT_EQ(Held().by("{" + ignore + kOne + "}"), "f.json ignores some of the part, but part_cut is false\n");
  Held cut;
  cut.part_cut = true;
  cut.origin.edges = {{0}, {0, 1}, {1}, {}};
  EXPECT_EQ(cut.by("{\"units\": \"mm\", " + kOne + "}"), "part_cut is true, but f.json ignores nothing\n");
  cut.demands.replace(cut.demands.find("[0]"), 3, "[0, 1]");
  EXPECT_EQ(cut.by("{" + ignore + kOne + "}"), "");
  EXPECT_TRUE(cut.whole);
  cut.demands.replace(cut.demands.find("[0, 1]"), 6, "[0, 2]");
  EXPECT_EQ(cut.by("{" + ignore + kOne + "}"), "feature \"a\" has edge 2, which f.json does not give it\n");
  cut.demands.replace(cut.demands.find("[0, 2]"), 6, "[1]");
  EXPECT_EQ(cut.by("{" + ignore + kOne + "}"), "feature \"a\" lacks edge 0, which f.json gives it\n");
  cut.origin.edges.clear();
  EXPECT_EQ(cut.by("{" + ignore + kOne + "}"),
            "which edges feature \"a\" has without what f.json ignores was not rechecked\n");
  EXPECT_FALSE(cut.whole);
}

TEST(VerifyFeatures, WhatIsNoFileIgnoresNothing) {
  EXPECT_TRUE(read_ignored(std::nullopt).regions.empty());
  for (const char* text : {"", "[]", "{", "5", "{}"})
    EXPECT_TRUE(read_ignored(Document{"f.json", text}).regions.empty()) << text;
  EXPECT_EQ(read_ignored(Document{"f.json", R"({"ignore": [{"outer": []}]})"}).regions.size(), 1U);
}

TEST(VerifyFeatures, WhatIsNoFileOfFeaturesGetsASentence) {
  for (const auto& [text, word] : {
           std::pair<std::string, std::string>{"[]", "not an object"},
           {R"({"features": {}})", "features"},
           {R"({"ignore": 1})", "ignore"},
           {R"({"ignore": [{"outer": [], "hole": []}]})", "hole"},
           {R"({"units": "cm"})", "units"},
           {R"({"minimum": -1})", "minimum"},
           {R"({"minimum": "1"})", "minimum"},
           {R"({"minimum": 1, "minimum": 1})", "twice"},
           {R"({"demands": []})", "demands"},
           {R"({"features": [1]})", "not an object"},
           {R"({"features": [{"edges": [0]}]})", "name"},
           {R"({"features": [{"name": "a"}]})", "which edges"},
           {R"({"features": [{"name": "a", "edges": [0], "contour": 0}]})", "which edges"},
           {R"({"features": [{"name": "a", "edges": [-1]}]})", "edges[0]"},
           {R"({"features": [{"name": "a", "edges": [0.5]}]})", "edges[0]"},
           {R"({"features": [{"name": "a", "edges": [0], "minimun": 1}]})", "minimun"},
           {R"({"features": [{"name": "a", "edges": [0], "maximum": 0}]})", "maximum"},
           {R"({"features": [{"name": "a", "edges": [0], "minimum": 2, "maximum": 2}]})", "maximum"},
           {R"({"features": [{"name": "a", "edges": [0], "scale": 0}]})", "scale"},
           {R"({"features": [{"name": "a", "edges": [0], "scale": null}]})", "scale"},
           {R"({"features": [{"name": "a", "edges": [0], "finished": 0}]})", "finished"},
           {R"({"features": [{"name": "a", "edges": [0], "finished": 1, "target": 1}]})", "finished"},
       }) {
    const std::string complaint = read(text).complaint;
    EXPECT_NE(complaint.find(word), std::string::npos) << text << ": " << complaint;
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_features_test
