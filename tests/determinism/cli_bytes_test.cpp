#include "e2e/cli_run.hpp"

/// Same input, same bytes: of every file that a run writes, whenever and wherever it runs.
namespace lekalo::test::cli_bytes_test {
namespace {

const Words kEverything{"-o",       "out.json",     "--certificate",  "out.cert", "--picture",
                        "out.svg",  "--deviations", "out.csv",        "--nc",     "part.nc",
                        "--nc-out", "out.nc",       "--alternatives", "0.5",      "--json"};

std::map<std::string, std::string> outputs(const TemporaryFolder& folder, const Words& words) {
  write_bytes(folder / "part.nc", kPlateProgram);
  const Ran ran = run(folder.path(), words);
  EXPECT_EQ(ran.status, 0) << ran.err;
  auto files = folder.files();
  EXPECT_EQ(files.at("out.json"), ran.out);
  files["out.json"] = without_run(files["out.json"]);
  return files;
}

class SameBytes : public testing::TestWithParam<int> {};

TEST_P(SameBytes, InTwoRunsInTwoFolders) {
  const TemporaryFolder one, other;
  const Words words = locate_example(GetParam()) + kEverything;
  const auto first = outputs(one, words), second = outputs(other, words);
  ASSERT_EQ(first.size(), 6U);
  for (const auto& [name, bytes] : first) EXPECT_TRUE(second.at(name) == bytes) << name;
}

TEST_P(SameBytes, AsPicturePng) {
  const TemporaryFolder folder;
  const auto picture = [&](const std::string& name) {
    EXPECT_EQ(run(folder.path(), locate_example(GetParam()) + Words{"--picture", name}).status, 0);
    return read_bytes(folder / name);
  };
  EXPECT_TRUE(picture("one.png") == picture("other.png"));
}

INSTANTIATE_TEST_SUITE_P(Examples, SameBytes, testing::Range(1, 7));

TEST(SameBytesOf, TheSeededReferenceMethod) {
#ifndef LEKALO_WITH_IPOPT
  GTEST_SKIP() << "built without IPOPT";
#endif
  const TemporaryFolder folder;
  const Words words =
      locate_example(3) + Words{"--method", "ipopt", "--starts", "3", "--seed", "7", "--json"};
  EXPECT_EQ(without_run(run(folder.path(), words).out), without_run(run(folder.path(), words).out));
}

TEST(SameBytesOf, ASearchStoppedByItsBudget) {
  const TemporaryFolder folder;
  const Words words = locate_example(3) + Words{"--work", "12", "--json"};
  EXPECT_EQ(without_run(run(folder.path(), words).out), without_run(run(folder.path(), words).out));
}

TEST(SameBytesOf, APlacedSolidAndItsDocuments) {
  const fs::path solids = fs::path(cases::source_dir()) / "examples" / "solid";
  const Words words{"locate", "--part", solids / "part.stl", "--blank", solids / "casting.stl", "--gap", "0.2",
                    "-o", "out.json", "--certificate", "out.cert", "--allowances", "out.csv", "--picture",
                    "out.html", "--report", "out.svg", "--json"};
  const TemporaryFolder one, other;
  const auto first = outputs(one, words), second = outputs(other, words);
  ASSERT_EQ(first.size(), 6U);
  for (const auto& [name, bytes] : first) EXPECT_TRUE(second.at(name) == bytes) << name;
}

TEST(SameBytesOf, TheVerdict) {
  const TemporaryFolder folder;
  ASSERT_EQ(run(folder.path(), locate_example(2) + Words{"-o", "out.json"}).status, 0);
  const Words words{"verify", "out.json", "--json"};
  EXPECT_EQ(run(folder.path(), words).out, run(folder.path(), words).out);
}

}  // namespace
}  // namespace lekalo::test::cli_bytes_test
