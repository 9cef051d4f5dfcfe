#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "lekalo/disk/files.hpp"
#include "lekalo/verify/verify.hpp"
#include "support/json.hpp"
#include "support/places.hpp"

/// The verdict on a result with demands rests on its certificates, its status, and on all that is rechecked.
namespace lekalo::verify::verify_pose_check_test {
namespace {

using cases::Json;

/// The inputs look at these bytes as long as they are.
const std::string& bytes(const std::string& name) {
  static std::map<std::string, std::string> files;
  const auto [file, is_new] = files.try_emplace(name);
  if (is_new)
    file->second = disk::read_file(cases::source_dir() + "/tests/corpus/data/written-0.1/" + name).value();
  return file->second;
}

/// Says the verdict and the findings on a result with a change.
std::string told(
    const std::string& name, const std::function<void(Json&)>& change,
    const std::function<void(LocateInputs&)>& with = [](LocateInputs&) {}) {
  Json result = Json::parse(bytes(name));
  change(result);
  const std::string text = result.dump();
  LocateInputs inputs{{"result.json", text},
                      {"bracket.json", bytes("bracket.json")},
                      {"casting.json", bytes("casting.json")},
                      std::nullopt};
  with(inputs);
  const auto report = verify_locate(inputs);
  if (!report) return "bad input: " + report.error().message;
  std::string all = report->verdict == Verdict::confirmed    ? "confirmed"
                    : report->verdict == Verdict::incomplete ? "incomplete"
                    : report->verdict == Verdict::unproved   ? "unproved"
                    : report->verdict == Verdict::refuted    ? "refuted"
                                                             : "stated regions";
  for (const std::string& finding : report->findings) all += "; " + finding;
  return all;
}
std::string largest(const std::function<void(Json&)>& change) { return told("region-largest.json", change); }

TEST(VerifyPoseCheck, ItsCertificatesProveWhatTheDemandsSay) {
  EXPECT_EQ(largest([](Json&) {}), "confirmed");
  EXPECT_EQ(largest([](Json& r) { r["largest_certificate"] = nullptr; }), "unproved");
  // The words about one outline are for a part without demands.
  EXPECT_EQ(largest([](Json& r) { r["certificate"] = "same outline"; }),
            "bad input: result.json: certificate is not an object");
  const std::string nothing = "refuted; there is a largest_certificate, but nothing that it is to prove; ";
  EXPECT_EQ(largest([](Json& r) { r["demands"]["smallest_largest"] = nullptr; }),
            nothing + "smallest_largest is missing, the second criterion");
  EXPECT_EQ(largest([](Json& r) { r["demands"]["smallest_largest"]["proof"] = nullptr; }),
            nothing + "nothing is said to prove smallest_largest.bound 22.45089493237293");
}

TEST(VerifyPoseCheck, AStatusFollowsFromTheBoundOfTheMargin) {
  EXPECT_EQ(largest([](Json& r) { r["status"] = "infeasible"; }),
            "refuted; status is infeasible, but margin_bound is not below 0");
  EXPECT_EQ(largest([](Json& r) { r["demands"]["margin_gap"] = 0.05; }),
            "refuted; status is optimal, but margin_bound is 0.0980367226709297 above margin_found, more "
            "than 0.05");
  const std::string optimal = "status is optimal, but margin_bound is below 0";
  for (const auto& [bound, is] : {std::pair{-1e-9, true}, {0.0, false}, {0.5, false}})
    EXPECT_EQ(largest([to = bound](Json& r) { r["demands"]["margin_bound"] = to; }).find(optimal) !=
                  std::string::npos,
              is)
        << bound;
}

TEST(VerifyPoseCheck, IsIncompleteWhereOneClaimIsOpen) {
  EXPECT_EQ(largest([](Json& r) { r["demands"]["criterion"] = "mine"; }), "incomplete");
  const auto program = [](LocateInputs& inputs) {
    inputs.program = Document{"bracket.nc", bytes("bracket.nc")};
  };
  EXPECT_EQ(told(
                "region.json", [](Json&) {}, program),
            "incomplete");
  EXPECT_EQ(told(
                "region.json", [](Json&) {},
                [&](LocateInputs& inputs) {
                  program(inputs);
                  inputs.written_program = Document{"region.nc", bytes("region.nc")};
                }),
            "confirmed");
  const auto features = [](const std::string& text) {
    return told(
        "region-features.json", [](Json&) {},
        [&](LocateInputs& inputs) {
          // A file that is not read here says of no edge which label it has.
          inputs.part.name = "bracket.dwg";
          inputs.features = Document{"features.json", text};
        });
  };
  std::string text = bytes("bracket-features.json");
  EXPECT_EQ(features(text), "stated regions");
  const std::string contour = R"("contour": 0)";
  text.replace(text.find(contour), contour.size(), R"("label": "a")");
  EXPECT_EQ(features(text), "incomplete");
}

}  // namespace
}  // namespace lekalo::verify::verify_pose_check_test
