#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "e2e/cli_run.hpp"
#include "lekalo/io/text/sha256.hpp"

/// `lekalo verify` of results by demands: what a result says of its demands, and what the file of features
/// says, cannot be changed unseen.
namespace lekalo::test::cli_verify_features_test {
namespace {

using Json = nlohmann::json;

/// A plate of 40 x 20 with a bore in a blank of 50 x 30, with a demand of every kind.
const std::string kPart =
    R"({"units": "mm", "outer": [
 {"line": {"from": [0, 0], "to": [40, 0]}}, {"line": {"from": [40, 0], "to": [40, 20]}},
 {"line": {"from": [40, 20], "to": [0, 20]}}, {"line": {"from": [0, 20], "to": [0, 0]}}],
 "holes": [[{"arc": {"from": [25, 10], "to": [25, 10], "centre": [20, 10], "ccw": true}}]]})";
const std::string kBlank =
    R"({"units": "mm", "outer": [
 {"line": {"from": [0, 0], "to": [50, 0]}}, {"line": {"from": [50, 0], "to": [50, 30]}},
 {"line": {"from": [50, 30], "to": [0, 30]}}, {"line": {"from": [0, 30], "to": [0, 0]}}]})";
const std::string kFeatures = R"({"units": "mm", "minimum": 0.3, "features": [
 {"name": "base", "edges": [0], "minimum": 1.5, "maximum": 9.5},
 {"name": "sides", "edges": [3, 1], "minimum": 1, "target": 4, "scale": 2},
 {"name": "bore", "contour": 1, "minimum": 2}]})";

class CliVerifyFeatures : public testing::Test {
 protected:
  void SetUp() override {
    write_bytes(folder_ / "part.json", kPart);
    write_bytes(folder_ / "blank.json", kBlank);
    locate(kFeatures);
  }
  void locate(const std::string& features) {
    write_bytes(folder_ / "features.json", features);
    const Ran ran =
        run(folder_.path(), {"locate", "--part", "part.json", "--blank", "blank.json", "--features",
                             "features.json", "--window", "-1", "1", "--gap", "0.1", "-o", "r.json"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    result_ = Json::parse(read_bytes(folder_ / "r.json"));
  }
  [[nodiscard]] Ran verify() const { return run(folder_.path(), {"verify", "r.json"}); }
  [[nodiscard]] Ran verify(const Json& result) const {
    write_bytes(folder_ / "r.json", result.dump());
    return verify();
  }
  /// The result with another file of features, named with its own digest.
  [[nodiscard]] Ran verify_with(const std::string& features) const {
    write_bytes(folder_ / "features.json", features);
    Json result = result_;
    result["inputs"][2]["sha256"] = io::sha256(features);
    return verify(result);
  }
  void restore() const { write_bytes(folder_ / "features.json", kFeatures); }

  TemporaryFolder folder_;
  Json result_;
};

/// Every value of a document changed, and left out.
std::vector<Json> lies_about(const Json& value) {
  if (value.is_boolean()) return {!value.get<bool>(), nullptr};
  if (value.is_string()) return {"", value.get<std::string>() + "x", 1, nullptr};
  if (!value.is_number()) return {1, "x"};
  const double v = value.get<double>(), most = std::numeric_limits<double>::infinity();
  std::vector<Json> lies{v + 0.5, std::nextafter(v, most), std::nextafter(v, -most), "x", nullptr};
  if (v != 0) lies.insert(lies.end(), {Json(-v), Json(0)});
  return lies;
}

template <class Try>
std::size_t try_lies(const Json& truth, const std::string& below, Try try_one) {
  std::size_t tried = 0;
  const Json flat = truth.flatten();
  for (const auto& [path, value] : flat.items()) {
    if (path.rfind(below, 0) != 0) continue;
    const Json::json_pointer at(path);
    for (const Json& lie : lies_about(value)) {
      Json wrong = truth;
      if (wrong[at] == lie) continue;
      wrong[at] = lie;
      try_one(path, lie, wrong), ++tried;
    }
    Json wrong = truth;
    Json& parent = wrong[at.parent_pointer()];
    parent.is_array() ? parent.erase(std::stoul(at.back())) : void(parent.erase(at.back()));
    try_one(path, Json("left out"), wrong), ++tried;
  }
  return tried;
}

/// Says whether every claim is as true after the change as it was before.
bool stays_true(const std::string& path, const Json& lie, const Json& was) {
  if (!lie.is_number()) return path == "/demands/deviation";
  const double is = lie.get<double>();
  // Measured, and nothing rests on it.
  if (path == "/demands/deviation") return true;
  // What proves the bound is read from here; the bound is another field.
  for (const char* const proof : {"/demands/grown_for", "/demands/shift", "/demands/bound"})
    if (path == proof) return true;
  if (path == "/demands/margin_bound" || path == "/demands/margin_gap" || path == "/demands/largest")
    return is >= std::nextafter(was.get<double>(), 0);
  // Only the other criteria give anything up.
  if (path == "/demands/give_up") return is >= 0;
  // The file demands more.
  return path == "/min_allowance" && is <= 0.3;
}

TEST_F(CliVerifyFeatures, WhatWasNotTouchedIsConfirmed) {
  const Ran ran = verify();
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(result_["inputs"][2]["role"], "features");
  EXPECT_EQ(result_["demands"]["features"].size(), 3U);
}

TEST_F(CliVerifyFeatures, NothingThatAResultSaysOfItsDemandsCanBeChangedUnseen) {
  std::size_t tried = 0;
  for (const char* const below :
       {"/demands", "/min_allowance", "/shortfall", "/upper_bound", "/gap", "/part_cut"})
    tried += try_lies(result_, below, [&](const std::string& path, const Json& lie, const Json& wrong) {
      const int status = verify(wrong).status;
      EXPECT_TRUE(status == 4 || status == 3 || status == 1 ||
                  (status == 0 && stays_true(path, lie, result_.at(Json::json_pointer(path)))))
          << path << " became " << lie << ": " << status;
    });
  EXPECT_GT(tried, 150U);
}

TEST_F(CliVerifyFeatures, NothingInTheFileCanBeChangedUnseenAlsoWithItsDigest) {
  const std::size_t tried =
      try_lies(Json::parse(kFeatures), "", [&](const std::string& path, const Json& lie, const Json& wrong) {
        const Ran ran = verify_with(wrong.dump());
        // Without a unit lengths are in mm as well.
        const bool same = path == "/units" && lie == "left out";
        EXPECT_EQ(ran.status, same ? 0 : 4) << path << " became " << lie << ran.err;
        EXPECT_TRUE(same || ran.err.find("features.json") != std::string::npos) << ran.err;
      });
  EXPECT_GT(tried, 70U);
}

TEST_F(CliVerifyFeatures, FeaturesMoreOrLessOrInAnotherOrderAreNamed) {
  Json file = Json::parse(kFeatures);
  file["features"].push_back({{"name", "top"}, {"edges", {2}}});
  Ran ran = verify_with(file.dump());
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("feature \"top\" of features.json is missing from the demands"), std::string::npos)
      << ran.err;
  file["features"].erase(3), file["features"].erase(2);
  ran = verify_with(file.dump());
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("feature \"bore\" of the demands is not in features.json"), std::string::npos)
      << ran.err;
  restore();
  Json turned = result_;
  std::swap(turned["demands"]["features"][0], turned["demands"]["features"][1]);
  EXPECT_EQ(verify(turned).status, 4);
}

TEST_F(CliVerifyFeatures, AFileThatIsNotThereOrAnotherOneIsSaid) {
  fs::rename(folder_ / "features.json", folder_ / "moved.json");
  Ran ran = verify();
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("the features file features.json, which it names, is not there"), std::string::npos)
      << ran.err;
  EXPECT_EQ(run(folder_.path(), {"verify", "r.json", "--features", "moved.json"}).status, 0);
  ran = run(folder_.path(), {"verify", "r.json", "--features", "part.json"});
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("is not the features file of this result"), std::string::npos) << ran.err;
  restore();
  for (const char* const digest : {"", "0000000000000000000000000000000000000000000000000000000000000000"}) {
    Json wrong = result_;
    wrong["inputs"][2]["sha256"] = digest;
    EXPECT_EQ(verify(wrong).status, 4);
  }
  Json unnamed = result_;
  unnamed["inputs"].erase(2);
  ran = verify(unnamed);
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("names no file of features"), std::string::npos) << ran.err;
}

TEST_F(CliVerifyFeatures, AResultThatSaysNothingOfDemandsDoesNotPassBesideAFileThatMakesSome) {
  for (const bool convex : {false, true}) {
    const Words plain = convex ? Words{} : Words{"--mirror", "either"};
    write_bytes(folder_ / "part.csv", "0 0\n40 0\n40 20\n0 20\n");
    ASSERT_EQ(run(folder_.path(), Words{"locate", "--part", "part.csv", "--blank", "blank.json", "--gap",
                                        "0.5", "-o", "r.json"} +
                                      plain)
                  .status,
              0);
    Json result = Json::parse(read_bytes(folder_ / "r.json"));
    EXPECT_EQ(verify().status, 0);
    result["inputs"].push_back(result_["inputs"][2]);
    EXPECT_EQ(verify(result).status, 4);
    const std::string alone = R"({"minimum": 0.3})";
    write_bytes(folder_ / "features.json", alone);
    result["inputs"][2]["sha256"] = io::sha256(alone);
    EXPECT_EQ(verify(result).status, 4);
    restore();
  }
}

TEST_F(CliVerifyFeatures, InchesOfAFileOrOfTheCommandAreTheSameDemands) {
  Json file = Json::parse(kFeatures);
  file["units"] = "inch", file["minimum"] = 0.01;
  for (Json& feature : file["features"])
    for (const char* const key : {"minimum", "target", "maximum"})
      if (feature.contains(key)) feature[key] = feature[key].get<double>() / 25.4;
  locate(file.dump());
  EXPECT_EQ(result_["demands"]["minimum"], 25.4 * 0.01);
  EXPECT_EQ(verify().status, 0);
  file.erase("units");
  EXPECT_EQ(verify_with(file.dump()).status, 0);
  file["units"] = "mm";
  EXPECT_EQ(verify_with(file.dump()).status, 4);
}

TEST_F(CliVerifyFeatures, EdgesOfALabelAreRebuiltFromATree) {
  write_bytes(folder_ / "part.json",
              R"({"units": "mm", "shape": {"difference": [{"rectangle": {"size": [40, 20]}, "name": "plate"},
 {"circle": {"radius": 5}, "name": "bore"}]}})");
  locate(R"({"features": [{"name": "hole", "label": "bore", "minimum": 2}]})");
  const Ran ran = verify();
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(verify_with(R"({"features": [{"name": "hole", "label": "plate", "minimum": 2}]})").status, 4);
  EXPECT_EQ(verify_with(R"({"features": [{"name": "hole", "label": "bore", "minimum": 3}]})").status, 4);
}

TEST_F(CliVerifyFeatures, ALabelOfARegionFileIsRefuted) {
  Json file = Json::parse(kFeatures);
  file["features"][2].erase("contour"), file["features"][2]["label"] = "bore";
  const Ran ran = verify_with(file.dump());
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("edges of a region file have none"), std::string::npos) << ran.err;
}

/// What 0.1 confirmed and should not have.
class VerifyFeaturesAttack : public testing::Test {
 protected:
  void SetUp() override {
    const fs::path from = fs::path(cases::source_dir()) / "tests/corpus/data/written-0.1";
    for (const char* const name :
         {"bracket.json", "casting.json", "bracket-features.json", "region-features.json"})
      fs::copy(from / name, folder_ / name);
  }
  [[nodiscard]] int status(const Json& result) const {
    write_bytes(folder_ / "rb.json", result.dump());
    return run(folder_.path(), {"verify", "rb.json"}).status;
  }
  TemporaryFolder folder_;
};

TEST_F(VerifyFeaturesAttack, EveryRowIsRefusedAndTheTruthIsNot) {
  const Json truth = Json::parse(read_bytes(folder_ / "region-features.json"));
  EXPECT_EQ(status(truth), 0);
  Json wrong = truth;
  wrong["min_allowance"] = 1000;
  EXPECT_EQ(status(wrong), 4);
  wrong = truth, wrong["upper_bound"] = 1e-9, wrong["gap"] = 0;
  EXPECT_EQ(status(wrong), 4);
  wrong = truth, wrong["inputs"][2]["sha256"] = std::string(64, '0');
  EXPECT_EQ(status(wrong), 4);
  Json features = Json::parse(read_bytes(folder_ / "bracket-features.json"));
  features["features"][0]["minimum"] = 50;
  write_bytes(folder_ / "bracket-features.json", features.dump());
  EXPECT_EQ(status(truth), 4);
  fs::remove(folder_ / "bracket-features.json");
  EXPECT_EQ(status(truth), 4);
}

}  // namespace
}  // namespace lekalo::test::cli_verify_features_test
