#include <thread>
#include <utility>

#include "e2e/cli_run.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/jobs/layout.hpp"
#include "lekalo/jobs/nest.hpp"
#include "lekalo/jobs/pocket.hpp"

/// This program is linked with src/base/parallel.cpp as it is without LEKALO_WITH_THREADS
/// (tests/CMakeLists.txt), and the command as the build has it: what both write is the same bytes.
namespace lekalo::test::without_threads_test {
namespace {

const fs::path kExamples = fs::path(cases::source_dir()) / "examples";

TEST(WithoutThreads, WorkIsDoneInTurnByTheCaller) {
  std::vector<std::pair<std::size_t, std::thread::id>> done, expected;
  share_out(5, 4, [&](std::size_t i) { done.emplace_back(i, std::this_thread::get_id()); });
  for (std::size_t i = 0; i < 5; ++i) expected.emplace_back(i, std::this_thread::get_id());
  EXPECT_EQ(done, expected);
}

TEST(WithoutThreads, ALayoutIsTheSameBytes) {
  const TemporaryFolder folder;
  const std::string shoes = (kExamples / "layouts/shoes.json").string();
  ASSERT_EQ(
      run(folder.path(), {"nest", shoes, "--work", "1000000", "--threads", "2", "-o", "out.json"}).status, 0);
  const auto layout = jobs::open_layout({shoes, read_bytes(shoes)});
  ASSERT_TRUE(layout) << layout.error().message;
  jobs::NestOptions options;
  options.threads = 2;
  RunControl control;
  control.work_limit = 1'000'000;
  const auto nested = jobs::nest(layout->document, options, control);
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_TRUE(nested->bytes == read_bytes(folder / "out.json"));
}

TEST(WithoutThreads, APocketItsJudgementAndItsModelAreTheSameBytes) {
  const TemporaryFolder folder;
  fs::copy_file(kExamples / "pockets/cover.json", folder / "cover.json");
  const Ran ran = run(folder.path(), {"pocket", "cover.json", "--tool", "8", "--depth", "2", "--method",
                                      "floz-linear", "--images", "model", "-o", "out.ngc", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  jobs::PocketJob job;
  job.pocket = {"cover.json", read_bytes(folder / "cover.json")};
  job.options.path.tool_diameter = 8, job.options.path.depth = 2;
  job.options.path.method = mill::Method::floz_linear;
  job.images = true, job.written_as = "out.ngc";
  const auto made = jobs::pocket(job);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_TRUE(made->program == read_bytes(folder / "out.ngc"));
  EXPECT_EQ(made->json, ran.out);
  for (const auto& [ending, bytes] : made->images)
    EXPECT_TRUE(bytes == read_bytes(folder / ("model" + ending))) << ending;
  EXPECT_EQ(made->images.size(), 5U);
}

}  // namespace
}  // namespace lekalo::test::without_threads_test
