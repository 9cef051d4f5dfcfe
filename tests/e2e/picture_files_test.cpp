#include <cstdlib>

#include "e2e/cli_run.hpp"
#include "support/places.hpp"
#include "support/xml.hpp"

/// The pictures that `lekalo locate` writes, against the result document of the same run.
namespace lekalo::test::picture_files_test {
namespace {

double number_in(const XmlDocument& svg, const std::string& kind) {
  const auto found = svg.of("text", kind);
  EXPECT_EQ(found.size(), 1U) << kind;
  return found.empty() ? 0 : std::strtod(found[0].text.c_str(), nullptr);
}

class Examples : public testing::TestWithParam<int> {};

TEST_P(Examples, AreDrawnWithTheNumbersAndContactsOfTheResult) {
  const TemporaryFolder folder;
  const Ran ran = run(folder.path(), locate_example(GetParam()) + Words{"--picture", "out.svg", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json result = ran.json();
  const XmlDocument svg(read_bytes(folder / "out.svg"));
  const double clearance = result["clearance"], bound = result["upper_bound"];
  EXPECT_LE(number_in(svg, "clearance"), clearance);
  EXPECT_GE(number_in(svg, "clearance"), clearance - 1.001e-6);
  EXPECT_GE(number_in(svg, "upper-bound"), bound);
  EXPECT_LE(number_in(svg, "upper-bound"), bound + 1.001e-6);
  EXPECT_NEAR(number_in(svg, "x"), result["x"], 0.501e-6);
  EXPECT_NEAR(number_in(svg, "y"), result["y"], 0.501e-6);
  EXPECT_NEAR(number_in(svg, "theta-deg"), result["theta_deg"], 0.501e-7);
  const auto lines = svg.of("path", "contact");
  ASSERT_EQ(lines.size(), result["contacts"].size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Json& contact = result["contacts"][i];
    EXPECT_EQ(svg.child_text(lines[i], "title"),
              "contact v" + contact["part_vertex"].dump() + " e" + contact["blank_edge"].dump());
  }
}

TEST_P(Examples, AreDrawnWithTheSameBytesEveryTime) {
  const TemporaryFolder folder;
  for (const std::string name : {"one.svg", "two.svg", "one.png", "two.png"}) {
    ASSERT_EQ(run(folder.path(), locate_example(GetParam()) + Words{"--picture", name}).status, 0);
  }
  EXPECT_EQ(read_bytes(folder / "one.svg"), read_bytes(folder / "two.svg"));
  EXPECT_EQ(read_bytes(folder / "one.png"), read_bytes(folder / "two.png"));
}

INSTANTIATE_TEST_SUITE_P(All, Examples, testing::Range(1, 7));

TEST(Picture, OfTheDocumentsIsTheOneTheProgramDraws) {
  const TemporaryFolder folder;
  ASSERT_EQ(run(folder.path(), locate_example(3) + Words{"--picture", "out.svg"}).status, 0);
  const XmlDocument fresh(read_bytes(folder / "out.svg"));
  const XmlDocument kept(read_bytes(fs::path(cases::source_dir()) / "docs/images/locate-example.svg"));
  const char* const way_out = "draw docs/images/locate-example.svg again, with lekalo locate on example 3";
  ASSERT_EQ(kept.elements.size(), fresh.elements.size()) << way_out;
  for (std::size_t i = 0; i < kept.elements.size(); ++i) {
    const XmlElement &now = fresh.elements[i], &then = kept.elements[i];
    EXPECT_EQ(then.name, now.name) << way_out;
    EXPECT_EQ(then["class"], now["class"]) << way_out;
    // The last digits of the bound and the pose may change with the search.
    if (now.name == "desc" || now["class"] == "gap") continue;
    EXPECT_EQ(then.text, now.text) << way_out;
  }
}

TEST(Picture, OfADemandThatCannotBeMetSaysWhatIsMissing) {
  const TemporaryFolder folder;
  write_plate(folder);
  const Ran ran = run(folder.path(), kLocatePlate + Words{"--min-allowance", "6", "--picture", "out.svg"});
  ASSERT_EQ(ran.status, 1) << ran.err;
  const XmlDocument svg(read_bytes(folder / "out.svg"));
  EXPECT_EQ(svg.of("text", "status").at(0).text, "infeasible");
  EXPECT_EQ(number_in(svg, "min-allowance"), 6);
  EXPECT_NEAR(number_in(svg, "shortfall"), 1, 1.1e-6);
  EXPECT_GE(number_in(svg, "shortfall"), 1);
}

TEST(Picture, AfterProbingAgainShowsTheLastPlacementAsTheStart) {
  const TemporaryFolder folder;
  write_plate(folder);
  ASSERT_EQ(run(folder.path(), kLocatePlate + Words{"-o", "last.json"}).status, 0);
  write_bytes(folder / "blank.csv", "101 100\n191 100\n191 150\n101 150\n");
  ASSERT_EQ(run(folder.path(), kLocatePlate + Words{"--compare", "last.json", "--picture", "out.svg"}).status,
            0);
  const XmlDocument svg(read_bytes(folder / "out.svg"));
  EXPECT_EQ(svg.of("path", "start").size(), 1U);
  EXPECT_TRUE(svg.of("text", "inset-caption").empty()) << "the last placement lies beside the new one";
}

TEST(Picture, TakesCyrillicFileNames) {
  const TemporaryFolder folder;
  write_bytes(folder / "лопатка.csv", kPlate);
  write_bytes(folder / "заготовка <7>.csv", kPlateBlank);
  ASSERT_EQ(run(folder.path(), {"locate", "--part", "лопатка.csv", "--blank", "заготовка <7>.csv",
                                "--picture", "чертёж.svg"})
                .status,
            0);
  const XmlDocument svg(read_bytes(folder / "чертёж.svg"));
  EXPECT_EQ(svg.of("text", "name").at(0).text, "лопатка.csv");
  EXPECT_EQ(svg.of("text", "name").at(1).text, "заготовка <7>.csv");
}

}  // namespace
}  // namespace lekalo::test::picture_files_test
