// A true result for regions with one number, word or list entry changed: refuted, refused, or shown to claim
// nothing that is not true.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/locate/region.hpp"
#include "lekalo/verify/verify.hpp"
#include "support/boolean_cases.hpp"
#include "support/region_cases.hpp"

namespace lekalo::verify_lies_test {
namespace {

using Json = nlohmann::json;

struct Written {
  Json result;
  std::string part, blank;  // the files of what was placed
};

Written true_result(locate::Mirror mirror = locate::Mirror::no) {
  cases::RegionCase one = cases::region_case(3, 1, cases::RegionKind::near_net, 10);
  if (mirror != locate::Mirror::no)
    one.part = cases::map_regions(one.part, geom::BlankFromPart::from_angle(0, {}, true));
  locate::RegionOptions options;
  options.gap = 0.05;
  const auto result = locate::locate_regions({one.part, one.blank, {}, mirror, 0, 0}, options);
  EXPECT_TRUE(result.has_value());
  io::LocateDocument d;
  d.status = "optimal";
  d.method = "certified";
  d.inputs = {{"part", {"part.json", ""}, std::nullopt, 0, {}},
              {"blank", {"blank.json", ""}, std::nullopt, 0, {}}};
  d.placement = result->best;
  d.upper_bound = result->upper_bound;
  d.shortfall = result->shortfall;
  d.part = one.part, d.blank = one.blank;
  d.mirror = mirror, d.mirrored = result->mirrored;
  d.contacts = result->contacts;
  d.proof = locate::PoseProof{result->pivot, result->certificate};
  const Json made = Json::parse(io::result_json(d));
  return {made, made["regions"]["part"].dump(), made["regions"]["blank"].dump()};
}

/// Empty where all is confirmed.
std::string first_finding(const Written& written) {
  const std::string text = written.result.dump();
  const auto report = verify::verify_locate(
      {{"result.json", text}, {"part.json", written.part}, {"blank.json", written.blank}, std::nullopt});
  if (!report) return report.error().message;
  if (report->verdict == verify::Verdict::confirmed) return "";
  return report->findings.empty() ? "not confirmed" : report->findings.front();
}

/// Where a change may be confirmed, and why that does no harm.
const std::vector<std::pair<std::string, std::string>>& harmless() {
  static const std::vector<std::pair<std::string, std::string>> list{
      {"/certificate/", "the bound is proved by what it says now"},
      {"/certificate_file", "there is a certificate in the result"},
      {"/contacts/", "points for the reader, held to 1e-6 of the blank's size; multipliers prove nothing"},
      {"/inputs/", "names, sums and counts of the files, which the caller compares"},
      {"/min_allowance", "a demand that is still met is the asker's to change"},
      {"/window_deg/", "of a smaller window everything is true that is of a larger one"},
      {"/regions/part/holes/0/0/arc/ccw", "a full circle is one whichever way"},
      {"/regions/part/holes/1/0/arc/ccw", "a full circle"},
      {"/regions/blank/holes/0/0/arc/ccw", "a full circle"},
      {"/regions/blank/holes/1/0/arc/ccw", "a full circle"},
      {"/comparison", "another method's result, for the reader"},
      {"/deviations", "for the reader"},
      {"/method", "how it was found"},
      {"/run/", "how it was found"},
      {"/seed", "how it was found"},
      {"/work", "how it was found"},
      {"/version", "who wrote it"},
      {"/part_cut", "a note says then that the part was not compared with its file"},
      {"/scan", "what the blank was made from: for the reader"},
      {"/warnings", "for the reader"},
      {"/alternatives", "regions have none, and nothing is said of them"},
  };
  return list;
}
bool may_be_confirmed(const std::string& path) {
  for (const auto& [prefix, why] : harmless())
    if (path.substr(0, prefix.size()) == prefix) return true;
  return false;
}

std::vector<Json> lies_about(const Json& value) {
  if (value.is_boolean()) return {!value.get<bool>(), "no", nullptr};
  if (value.is_string()) return {"", value.get<std::string>() + "x", 1, nullptr};
  if (!value.is_number()) return {1, "x", true};
  const double v = value.get<double>();
  std::vector<Json> lies{v + 0.5, "x", nullptr};
  if (v != 0) lies.insert(lies.end(), {-v, 0.99 * v, v * 1e30});
  return lies;
}

class Lies : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    written_ = new Written(true_result());
    truth_ = &written_->result;
  }
  static void TearDownTestSuite() { delete written_; }
  /// The result changed, its files as they were.
  static bool is_refuted(const Json& document) {
    return !first_finding({document, written_->part, written_->blank}).empty();
  }
  static const Written* written_;
  static const Json* truth_;
};
const Written* Lies::written_ = nullptr;
const Json* Lies::truth_ = nullptr;

TEST_F(Lies, TheTruthIsConfirmed) {
  EXPECT_EQ(first_finding(*written_), "");
  for (const locate::Mirror mirror : {locate::Mirror::yes, locate::Mirror::either}) {
    Written mirrored = true_result(mirror);
    EXPECT_TRUE(mirrored.result["mirrored"].get<bool>());
    EXPECT_EQ(first_finding(mirrored), "");
    for (Json& tree : mirrored.result["certificate"]["trees"])
      tree["mirrored"] = !tree["mirrored"].get<bool>();
    EXPECT_NE(first_finding(mirrored), "");
  }
}

TEST_F(Lies, NoFieldCanBeChangedUnseen) {
  const Json flat = truth_->flatten();
  std::size_t in_certificate = 0, in_shapes = 0;
  for (const auto& [path, value] : flat.items()) {
    // Nodes are many and alike.
    if (path.rfind("/certificate/trees", 0) == 0 && ++in_certificate % 397 != 0) continue;
    if (path.rfind("/regions/", 0) == 0 && value.is_number() && ++in_shapes % 3 != 0) continue;
    for (const Json& lie : lies_about(value)) {
      if (lie == value) continue;
      Json wrong = *truth_;
      wrong[Json::json_pointer(path)] = lie;
      if (is_refuted(wrong)) continue;
      EXPECT_TRUE(may_be_confirmed(path)) << path << ": " << value << " became " << lie;
    }
  }
}

TEST_F(Lies, SmallLiesAboutWhatIsClaimedAreSeen) {
  for (const auto& [path, by] : {std::pair{"/clearance", 1e-9},
                                 {"/upper_bound", -0.06},
                                 {"/x", 1e-7},
                                 {"/y", -1e-7},
                                 {"/theta", 1e-9},
                                 {"/theta_deg", 1e-9},
                                 {"/gap", 1e-9},
                                 {"/shortfall", 1e-9},
                                 {"/tolerances/part", 1e-9},
                                 {"/tolerances/blank", 1e-9},
                                 {"/min_allowance", 100.0}}) {
    // A pose that is off has less clearance one way or the other.
    Json wrong = *truth_, other = *truth_;
    Json& value = wrong[Json::json_pointer(path)];
    value = value.get<double>() + by;
    Json& opposite = other[Json::json_pointer(path)];
    opposite = opposite.get<double>() - by;
    const std::string name = path;
    const bool pose = name == "/x" || name == "/y" || name == "/theta";
    EXPECT_TRUE(is_refuted(wrong) || (pose && is_refuted(other))) << path;
  }
}

TEST_F(Lies, NothingCanBeLeftOut) {
  for (const auto& [key, value] : truth_->items()) {
    if (value.is_null()) continue;  // left out it says the same
    Json wrong = *truth_;
    wrong.erase(key);
    // Neither file is a drawing here, and lekalo 0.1 wrote nothing of drawings.
    const bool says_nothing = may_be_confirmed("/" + key) || may_be_confirmed("/" + key + "/") ||
                              key == "nc" || key == "trim" || key == "drawings" ||
                              key == "alternatives_complete";
    const bool needed =
        key == "certificate" || key == "contacts" || key == "window_deg" || key == "min_allowance";
    EXPECT_TRUE(is_refuted(wrong) || (says_nothing && !needed)) << key;
  }
  Json wrong = *truth_;
  auto& nodes = wrong["certificate"]["trees"][0]["nodes"];
  ASSERT_GT(nodes.size(), 3u);
  for (const std::size_t at : {std::size_t{0}, nodes.size() / 2, nodes.size() - 1}) {
    Json shorter = *truth_;
    auto& left = shorter["certificate"]["trees"][0]["nodes"];
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    EXPECT_TRUE(is_refuted(shorter)) << at;
    Json longer = *truth_;
    auto& more = longer["certificate"]["trees"][0]["nodes"];
    more.push_back(more[at]);
    EXPECT_TRUE(is_refuted(longer)) << at;
  }
  // An edge, a hole, a piece less.
  for (const char* shape : {"part", "blank"}) {
    for (const std::string path : {"/outer", "/holes/0"}) {
      Json less = *truth_;
      auto& contour = less[Json::json_pointer(std::string("/regions/") + shape + path)];
      ASSERT_TRUE(contour.is_array());
      contour.erase(contour.begin());
      EXPECT_TRUE(is_refuted(less)) << shape << path;
    }
  }
  // Material that the blank does not have would be a larger clearance: the files decide, and here there are
  // none.
}

}  // namespace
}  // namespace lekalo::verify_lies_test
