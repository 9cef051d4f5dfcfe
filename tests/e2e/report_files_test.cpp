#include <sstream>

#include "e2e/cli_run.hpp"
#include "support/places.hpp"
#include "support/xml.hpp"

/// The report and the table of allowances that `lekalo locate` writes, against the result of the same run.
namespace lekalo::test::report_files_test {
namespace {

std::string region_example(const std::string& name) {
  return cases::source_dir() + "/examples/regions/" + name;
}
Words locate_bracket() {
  return {"locate", "--part", region_example("bracket.json"), "--blank", region_example("casting.json")};
}

double number_in(const XmlDocument& page, const std::string& kind) {
  const auto found = page.of("text", kind);
  EXPECT_EQ(found.size(), 1U) << kind;
  return found.empty() ? 0 : std::strtod(found[0].text.c_str(), nullptr);
}

/// Column `index` of the table, without its title.
std::vector<std::string> column(const std::string& csv, std::size_t index) {
  std::vector<std::string> cells;
  std::istringstream lines(csv);
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string field;
    for (std::size_t k = 0; k <= index; ++k) std::getline(fields, field, ',');
    cells.push_back(field);
  }
  return cells;
}

double least_of(const std::string& csv) {
  double least = 1e300;
  for (const std::string& cell : column(csv, 8)) least = std::min(least, std::strtod(cell.c_str(), nullptr));
  return least;
}

void expect_numbers_of(const Json& result, const XmlDocument& page) {
  const double clearance = result["clearance"], bound = result["upper_bound"];
  EXPECT_LE(number_in(page, "clearance"), clearance);
  EXPECT_GE(number_in(page, "clearance"), clearance - 1.001e-6);
  EXPECT_GE(number_in(page, "upper-bound"), bound);
  EXPECT_LE(number_in(page, "upper-bound"), bound + 1.001e-6);
  EXPECT_NEAR(number_in(page, "x"), result["x"], 0.501e-6);
  EXPECT_NEAR(number_in(page, "theta-deg"), result["theta_deg"], 0.501e-7);
  EXPECT_EQ(page.of("path", "contact").size(), result["contacts"].size());
  const auto digests = page.of("text", "sha256");
  ASSERT_EQ(digests.size(), result["inputs"].size());
  for (std::size_t k = 0; k < digests.size(); ++k) EXPECT_EQ(digests[k].text, result["inputs"][k]["sha256"]);
}

TEST(ReportFiles, OfConvexContoursSayWhatTheResultSays) {
  for (int number = 1; number <= 6; ++number) {
    const TemporaryFolder folder;
    const Ran ran = run(folder.path(), locate_example(number) + Words{"--report", "page.svg", "--allowances",
                                                                      "along.csv", "--json"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.err.find("page.svg"), std::string::npos);
    EXPECT_NE(ran.err.find("along.csv"), std::string::npos);
    const Json result = ran.json();
    const XmlDocument page(read_bytes(folder / "page.svg"));
    expect_numbers_of(result, page);
    EXPECT_EQ(page.of("text", "contact-row").size(), 6 * result["contacts"].size());
    const std::string csv = read_bytes(folder / "along.csv");
    EXPECT_NEAR(least_of(csv), result["clearance"], 1e-9);
    // Every blank edge in contact is the nearest of some point with no more than the least allowance.
    const auto allowances = column(csv, 8), blank_edges = column(csv, 9);
    for (const Json& contact : result["contacts"]) {
      bool found = false;
      for (std::size_t k = 0; k < allowances.size(); ++k) {
        const double over = std::strtod(allowances[k].c_str(), nullptr) - result["clearance"].get<double>();
        found |= over < 1e-6 && blank_edges[k] == contact["blank_edge"].dump();
      }
      EXPECT_TRUE(found) << "example " << number << ": " << contact;
    }
  }
}

TEST(ReportFiles, OfRegionsSayWhatTheResultSaysInEveryFormTwice) {
  const TemporaryFolder folder;
  for (const std::string name : {"one", "two"}) {
    for (const std::string ending : {".svg", ".pdf", ".png"}) {
      const Ran ran = run(folder.path(), locate_bracket() + Words{"--report", name + ending, "--allowances",
                                                                  name + ".csv", "-o", name + ".json"});
      ASSERT_EQ(ran.status, 0) << ran.err;
    }
  }
  for (const std::string ending : {".svg", ".pdf", ".png", ".csv"})
    EXPECT_EQ(read_bytes(folder / ("one" + ending)), read_bytes(folder / ("two" + ending))) << ending;
  EXPECT_EQ(read_bytes(folder / "one.pdf").substr(0, 5), "%PDF-");
  EXPECT_EQ(read_bytes(folder / "one.png").substr(1, 3), "PNG");
  const Json result = Json::parse(read_bytes(folder / "one.json"));
  const XmlDocument page(read_bytes(folder / "one.svg"));
  expect_numbers_of(result, page);
  EXPECT_NEAR(least_of(read_bytes(folder / "one.csv")), result["clearance"], 1e-9);
  std::size_t outlines = 0;
  for (const XmlElement& cell : page.of("text", "feature"))
    outlines += cell.text.starts_with("hole ") ? 1 : 0;
  EXPECT_EQ(outlines, result["regions"]["part"]["holes"].size());
}

TEST(ReportFiles, OfADemandThatCannotBeMetShowWhatIsMissingAndComeAllTheSame) {
  const TemporaryFolder folder;
  write_plate(folder);
  const Ran ran = run(folder.path(), kLocatePlate + Words{"--min-allowance", "6", "--report", "page.svg",
                                                          "--allowances", "along.csv"});
  ASSERT_EQ(ran.status, 1) << ran.err;
  const XmlDocument page(read_bytes(folder / "page.svg"));
  EXPECT_EQ(page.of("text", "status").at(0).text, "infeasible");
  EXPECT_GE(number_in(page, "shortfall"), 1);
  EXPECT_FALSE(page.of("path", "allowance-too-thin").empty());
  EXPECT_FALSE(page.of("text", "missing-label").empty());
  EXPECT_NEAR(least_of(read_bytes(folder / "along.csv")), 5, 1e-9);
}

TEST(ReportFiles, OfAMethodWithoutProofSaySo) {
  const TemporaryFolder folder;
  const Ran ran = run(folder.path(), locate_example(5) + Words{"--method", "icp", "--report", "page.svg"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const XmlDocument page(read_bytes(folder / "page.svg"));
  EXPECT_EQ(page.of("text", "upper-bound").at(0).text, "not proved");
  EXPECT_NE(page.of("text", "proof").at(0).text.find("Nothing is proved"), std::string::npos);
}

TEST(ReportFiles, OfOtherEndingsOrInTheWayOfOthersAreRefused) {
  const TemporaryFolder folder;
  write_plate(folder);
  const auto before = folder.files();
  for (const Words& words :
       {Words{"--report", "page.txt"}, Words{"--report", "page"}, Words{"--report", "page.PDF"},
        Words{"--allowances", "along.txt"}, Words{"--allowances", "part.csv"},
        Words{"--report", "a.svg", "--picture", "a.svg"}}) {
    const Ran ran = run(folder.path(), kLocatePlate + words);
    EXPECT_EQ(ran.status, 2) << words[1] << ": " << ran.err;
    EXPECT_NE(ran.err.find(words[0]), std::string::npos) << ran.err;
    EXPECT_EQ(folder.files(), before) << words[1];
  }
  EXPECT_EQ(run(folder.path(), kLocatePlate + Words{"--report", "none/page.pdf"}).status, 5);
}

}  // namespace
}  // namespace lekalo::test::report_files_test
