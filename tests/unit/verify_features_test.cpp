// The checker's own reader of files of features.

#include <gtest/gtest.h>

#include <string>
#include <utility>

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
  EXPECT_EQ(said.stated.minimum, 25.4);
  EXPECT_EQ(said.stated.features.at(0).numbers.minimum, 25.4 * 0.1);
  EXPECT_EQ(said.stated.features.at(0).numbers.scale, 2);
  EXPECT_EQ(read(R"({"minimum": 1, )" + features, LengthUnit::inch).stated.minimum, 25.4);
  EXPECT_EQ(read(R"({"units": "mm", "minimum": 1, )" + features, LengthUnit::inch).stated.minimum, 1);
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
