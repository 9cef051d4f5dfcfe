#include "lekalo/jobs/verify.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "lekalo/disk/files.hpp"
#include "support/json.hpp"
#include "support/places.hpp"

namespace lekalo::jobs::jobs_verify_test {
namespace {

/// The files that a result names, without a disk.
class JobsVerify : public testing::Test {
 protected:
  static std::string bytes(const std::string& name) {
    return disk::read_file(cases::source_dir() + "/tests/corpus/data/written-0.1/" + name).value();
  }
  void SetUp() override {
    for (const char* name : {"example-1-part.csv", "example-1-blank.csv", "part.nc", "convex.nc"})
      files_[name] = bytes(name);
  }
  [[nodiscard]] Result<Verified> verified(const std::string& result) const {
    return verify({"convex.json", result},
                  [&](const std::string&, const std::string& path) -> Result<std::optional<File>> {
                    const auto found = files_.find(path);
                    if (found == files_.end()) return std::nullopt;
                    return File{path, found->second};
                  });
  }
  std::map<std::string, std::string> files_;
};

/// Margin and largest allowance of these placements were rechecked, and their clearance and degrees believed.
TEST_F(JobsVerify, PlacementsOfATradeOffHaveTheirClearanceAndAngle) {
  for (const char* const name : {"bracket.json", "casting.json", "bracket-features.json"})
    files_[name] = bytes(name);
  const cases::Json whole = cases::Json::parse(bytes("region-largest.json"));
  ASSERT_EQ(whole["demands"]["trade_off"].size(), 2U);
  const auto told = [&](const std::function<void(cases::Json&)>& change) {
    cases::Json result = whole;
    change(result["demands"]["trade_off"][1]);
    const Result<Verified> done = verified(result.dump());
    if (!done) return done.error().message;
    std::string all;
    for (const std::string& finding : done->report.findings) all += finding + "\n";
    return all;
  };
  EXPECT_EQ(told([](cases::Json&) {}), "");
  EXPECT_EQ(told([](cases::Json& point) { point["clearance"] = point["clearance"].get<double>() - 0.5; }),
            "");
  for (const double more : {1e-9, 0.5}) {
    const std::string all =
        told([&](cases::Json& point) { point["clearance"] = point["clearance"].get<double>() + more; });
    EXPECT_NE(all.find("demands.trade_off[1]: clearance"), std::string::npos) << more << all;
  }
  EXPECT_NE(
      told([](cases::Json& point) { point["theta_deg"] = 1; }).find("demands.trade_off[1]: theta_deg is 1"),
      std::string::npos);
  for (const char* const key : {"clearance", "theta_deg"})
    EXPECT_NE(told([&](cases::Json& point) { point.erase(key); }).find(key), std::string::npos);
}

TEST_F(JobsVerify, AResultIsConfirmedFromWhatTheFinderGives) {
  const Result<Verified> done = verified(bytes("convex.json"));
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(done->report.verdict, verify::Verdict::confirmed);
  EXPECT_TRUE(done->report.findings.empty());
  EXPECT_EQ(cases::Json::parse(done->json)["status"], "confirmed");
}

TEST_F(JobsVerify, EveryInputIsReadAndUsed) {
  const Result<Verified> done = verified(bytes("convex.json"));
  ASSERT_TRUE(done) << done.error().message;
  std::string roles;
  const auto report = cases::Json::parse(done->json);
  for (const auto& input : report["inputs"]) roles += input["role"].get<std::string>() + " ";
  EXPECT_EQ(roles, "result part blank nc ");
  EXPECT_TRUE(done->report.notes.empty());

  files_["part.nc"] += "M0\n";
  const Result<Verified> other = verified(bytes("convex.json"));
  ASSERT_TRUE(other);
  EXPECT_EQ(other->report.verdict, verify::Verdict::refuted);
  files_.erase("part.nc");
  const Result<Verified> none = verified(bytes("convex.json"));
  ASSERT_TRUE(none);
  EXPECT_EQ(none->report.verdict, verify::Verdict::refuted);
  ASSERT_EQ(none->report.findings.size(), 1U);
  EXPECT_NE(none->report.findings[0].find("the nc file part.nc, which it names, is not there"),
            std::string::npos);
}

TEST_F(JobsVerify, TwoInputsOfOneRoleAreRefused) {
  cases::Json result = cases::Json::parse(bytes("convex.json"));
  result["inputs"].push_back(result["inputs"][0]);
  const Result<Verified> done = verified(result.dump());
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("two files with the role \"part\""), std::string::npos);
}

TEST_F(JobsVerify, OtherBytesThanTheResultNamesAreAFinding) {
  files_["convex.nc"] += "M0\n";
  const Result<Verified> done = verified(bytes("convex.json"));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->report.verdict, verify::Verdict::refuted);
  ASSERT_EQ(done->report.findings.size(), 1U);
  EXPECT_NE(done->report.findings[0].find("is not the NC program file of this result"), std::string::npos);
}

TEST_F(JobsVerify, AProgramThatIsNotThereIsLeftOpenAndAPartIsAFinding) {
  files_.erase("convex.nc");
  const Result<Verified> done = verified(bytes("convex.json"));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->report.verdict, verify::Verdict::incomplete);
  ASSERT_FALSE(done->report.notes.empty());
  std::string notes;
  for (const std::string& note : done->report.notes) notes += note + "\n";
  EXPECT_NE(notes.find("moved, was not rechecked: it is not there"), std::string::npos) << notes;
  files_.erase("example-1-part.csv");
  const Result<Verified> none = verified(bytes("convex.json"));
  ASSERT_TRUE(none);
  EXPECT_EQ(none->report.verdict, verify::Verdict::refuted);
}

}  // namespace
}  // namespace lekalo::jobs::jobs_verify_test
