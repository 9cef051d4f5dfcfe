// The store with the N-th call to the system failing: what it acknowledged is there afterwards, and nothing
// else but the one change that it may have finished without saying so. The program calls itself, as the
// session whose calls fail.

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "server/store/store.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"
#include "support/places.hpp"

namespace lekalo::server {
namespace {

namespace fs = std::filesystem;

constexpr Revision kRevisions = 6;
constexpr std::size_t kStandardCases = 32;
constexpr int kFailed = 5;

/// The revision that moves placement 1 by as many steps as its number.
StoredChange next_change(layout::Document& document, Revision revision) {
  StoredChange change;
  change.revision = revision;
  change.text = "move";
  layout::Placement after = document.placements[0];
  after.at.x += revision;
  change.change.placements.push_back({document.placements[0], after});
  change.change.next_id_before = change.change.next_id_after = document.next_id;
  document.placements[0] = after;
  return change;
}

/// Says what is acknowledged, by a call that cannot be made to fail.
void acknowledge(char what) {
  if (syscall(SYS_write, STDOUT_FILENO, &what, 1) != 1) std::abort();
}

/// "c" for the layout, "r" for each revision.
int session(const std::string& path) {
  try {
    Result<Store> store = Store::open(path);
    if (!store) return kFailed;
    layout::Document document = cases::two_squares();
    const Result<LayoutId> id = store->create("a", document);
    if (!id) return kFailed;
    acknowledge('c');
    for (Revision revision = 1; revision <= kRevisions; ++revision) {
      const StoredChange change = next_change(document, revision);
      if (!store->append(*id, change, document)) return kFailed;
      acknowledge('r');
    }
    return 0;
  } catch (const std::bad_alloc&) {
    return kFailed;
  }
}

class StoreFaults : public testing::Test {
 protected:
  void SetUp() override {
    if (cases::faults_library().empty()) GTEST_SKIP() << "this build has no library that makes calls fail";
    std::string name = (fs::temp_directory_path() / "lekalo-faults-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  struct Ran {
    int status = -1;
    std::string acknowledged, report;
  };

  Ran run_session(const std::string& fault) {
    fs::remove_all(folder_ / "s");
    fs::create_directory(folder_ / "s");
    const std::string report = folder_ / "report", out = folder_ / "out", path = folder_ / "s/store.sqlite";
    fs::remove(report);
    std::vector<std::string> environment{"LD_PRELOAD=" + cases::faults_library(),
                                         "LEKALO_FAULT_REPORT=" + report};
    if (!fault.empty()) environment.push_back("LEKALO_FAULT=" + fault);
    const pid_t child = fork();
    if (child == 0) {
      for (std::string& one : environment) putenv(one.data());
      if (std::freopen(out.c_str(), "w", stdout) == nullptr) _exit(127);
      execl("/proc/self/exe", "session", "--session", path.c_str(), nullptr);
      _exit(127);
    }
    int state = 0;
    waitpid(child, &state, 0);
    return {WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state), text_of(out), text_of(report)};
  }

  static std::string text_of(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  /// Opens what the session left, and holds it against what was acknowledged.
  void judge(const std::string& fault) {
    const Ran ran = run_session(fault);
    SCOPED_TRACE(fault + ": " + ran.report + ", acknowledged " + ran.acknowledged);
    ASSERT_TRUE(ran.status == 0 || ran.status == kFailed) << ran.status;
    Result<Store> store = Store::open(folder_ / "s/store.sqlite");
    ASSERT_TRUE(store) << store.error().message;
    const auto layouts = store->list();
    ASSERT_TRUE(layouts) << layouts.error().message;
    const std::size_t told = ran.acknowledged.size();
    ASSERT_LE(layouts->size(), 1U);
    if (layouts->empty()) {
      EXPECT_EQ(told, 0U) << "a layout that was acknowledged is lost";
      return;
    }
    const auto layout = store->load(layouts->front().id);
    ASSERT_TRUE(layout) << layout.error().message;
    const auto known = static_cast<Revision>(told) - 1;  // the first is the layout itself
    EXPECT_GE(layout->revision, known) << "a revision that was acknowledged is lost";
    EXPECT_LE(layout->revision, known + 1);
    layout::Document document = cases::two_squares();
    for (Revision revision = 1; revision <= layout->revision; ++revision) next_change(document, revision);
    EXPECT_EQ(layout->document, document);
  }

  fs::path folder_;
};

TEST_F(StoreFaults, WhatWasAcknowledgedIsThereWhateverFails) {
  const Ran good = run_session("");
  ASSERT_EQ(good.status, 0);
  ASSERT_EQ(good.acknowledged, "crrrrrr");
  std::size_t memory = 0, files = 0;
  std::istringstream(good.report) >> memory >> files;
  ASSERT_GT(memory, 100U);
  ASSERT_GT(files, 20U) << "SQLite's own calls are among them";
  const auto kinds = {std::tuple{"files:", files, std::to_string(EIO)},
                      std::tuple{"files:", files, std::to_string(ENOSPC) + "+"},
                      std::tuple{"memory:", memory, std::to_string(ENOMEM)},
                      std::tuple{"memory:", memory, std::to_string(ENOMEM) + "+"}};
  const std::size_t each = std::max<std::size_t>(1, cases::case_count(kStandardCases) / kinds.size());
  Random random(cases::seed());
  for (const auto& [kind, all, mode] : kinds) {
    const std::size_t tried = std::min(all, each);
    for (std::size_t i = 0; i < tried && !HasFailure(); ++i) {
      const std::size_t first = i * all / tried, next = (i + 1) * all / tried;
      judge(kind + std::to_string(1 + first + random.below(next - first)) + ":" + mode);
    }
  }
}

}  // namespace
}  // namespace lekalo::server

int main(int argc, char** argv) {
  if (argc == 3 && std::string(argv[1]) == "--session") return lekalo::server::session(argv[2]);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
