// A part in a blank of its own outline has an allowance of 0 and is told so, for every outline of the corpora
// that can be read: nothing to search, nothing undecided.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/locate.hpp"
#include "support/places.hpp"
#include "support/shared_data.hpp"

namespace lekalo::locate_own_outline_test {
namespace {

namespace fs = std::filesystem;

/// The files of folders that may be outlines, in one order.
std::vector<fs::path> outlines_in(const std::vector<fs::path>& folders) {
  const std::set<std::string> endings{".csv", ".dxf", ".json", ".svg", ".txt", ".xyz"};
  std::vector<fs::path> files;
  for (const fs::path& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && endings.count(entry.path().extension().string()) > 0)
        files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Places each of the outlines in itself and returns how many were.
std::size_t place_in_themselves(const std::vector<fs::path>& files) {
  std::size_t placed = 0;
  for (const fs::path& path : files) {
    const auto bytes = disk::read_file(path.string());
    EXPECT_TRUE(bytes.has_value()) << path;
    if (!bytes) continue;
    jobs::LocateJob job;
    job.part = {path.filename().string(), *bytes};
    job.blank = job.part;
    const auto located = jobs::locate(job);
    if (!located) {
      // A file that is no outline is no business of this test.
      EXPECT_TRUE(located.error().code == ErrorCode::bad_input || located.error().code == ErrorCode::usage)
          << path << ": " << located.error().message;
      continue;
    }
    ++placed;
    EXPECT_EQ(located->document.status, "optimal") << path;
    EXPECT_EQ(located->document.placement.clearance, 0) << path;
    EXPECT_EQ(located->document.shortfall, 0) << path;
    EXPECT_GE(located->document.upper_bound.value_or(-1), 0) << path;
    EXPECT_LE(located->document.upper_bound.value_or(1), 1e-6) << path;
    EXPECT_TRUE(located->holds()) << path;
  }
  return placed;
}

TEST(LocateOwnOutline, EveryOutlineOfTheCorpusHasNothingToSpareInItself) {
  const fs::path root = cases::source_dir();
  const std::size_t placed = place_in_themselves(
      outlines_in({root / "tests/corpus/data/contours", root / "tests/corpus/data/dxf",
                   root / "tests/corpus/data/dxf_styles", root / "tests/corpus/data/svg",
                   root / "examples/localisation", root / "examples/regions", root / "examples/pockets"}));
  EXPECT_GE(placed, 40U);
}

TEST(LocateOwnOutline, NorHaveThoseOfTheSharedDrawings) {
  const std::string folder = cases::shared_data();
  if (folder.empty()) GTEST_SKIP() << "no ../shared/data; LEKALO_SHARED_DATA names another folder";
  std::vector<fs::path> files = outlines_in({fs::path(folder) / "drawings", fs::path(folder) / "dxf"});
  // The independent checker reads every curve of large drawings again, which takes minutes for all of them.
  constexpr std::uintmax_t kQuickBytes = 20'000;
  if (std::getenv("LEKALO_FULL") == nullptr)
    std::erase_if(files, [](const fs::path& path) { return fs::file_size(path) > kQuickBytes; });
  EXPECT_GE(place_in_themselves(files), 20U);
}

}  // namespace
}  // namespace lekalo::locate_own_outline_test
