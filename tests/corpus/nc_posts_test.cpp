// Programs as posts write them: those of the shared data, where it is, are rewritten or refused as the table
// of docs/measurements/nc-rewrite.md says, and what is written is the original, moved, for the checker's own
// reader too.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/nc/rewrite.hpp"
#include "support/shared_data.hpp"
#include "verify/pocket/moved_program.hpp"

namespace lekalo::nc_posts_test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kRefused{"06", "08", "21", "30", "32", "34", "37", "44", "52", "70", "74"};

verify::Decimal decimal(double value) { return *verify::parse_decimal(fmt::format("{:.17g}", value)); }

/// Empty when the program is rewritten, with this shift along Z if it is a solid's, and the checker confirms
/// it; else why not.
std::string fault_of(const fs::path& file, double theta, std::optional<double> z = std::nullopt) {
  const auto bytes = disk::read_file(file.string());
  if (!bytes) return bytes.error().message;
  nc::RewriteOptions options;
  options.z = z;
  const auto made = nc::rewrite_program(*bytes, file.filename().string(), 12.7, -25.4, theta, options);
  if (!made) return made.error().message;
  verify::ProgramClaim claim{{"original", *bytes}, {"written", made->program},
                             decimal(12.7),        decimal(-25.4),
                             decimal(theta),       decimal(made->rounding_mm),
                             "coordinates",        1,
                             made->control,        {}};
  if (z)
    claim.solid = verify::ProgramClaim::Solid{decimal(*z),
                                              {decimal(std::cos(theta / 2)), decimal(std::sin(theta / 2))}};
  const verify::ProgramVerdict verdict = verify::check_moved_program(claim);
  if (verdict.fault) return "CHECKER: " + *verdict.fault;
  return verdict.open ? "CHECKER: " + *verdict.open : "";
}

std::vector<fs::path> files_of(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

TEST(NcPosts, FusionsProgramsAreRewritten) {
  if (cases::shared_data().empty()) GTEST_SKIP() << "no shared data";
  for (const double theta : {0.0, 0.58})
    for (const fs::path& file : files_of(cases::shared_data() + "/nc/fusion"))
      for (const std::optional<double> z : {std::optional<double>(), std::optional(30.5)})
        EXPECT_EQ(fault_of(file, theta, z), "") << file;
}

TEST(NcPosts, VariantsAreRewrittenOrRefusedAsTheTableSays) {
  if (cases::shared_data().empty()) GTEST_SKIP() << "no shared data";
  for (const fs::path& file : files_of(cases::shared_data() + "/nc/variants")) {
    const std::string number = file.filename().string().substr(0, 2), fault = fault_of(file, 0.58);
    const bool refused = std::ranges::find(kRefused, number) != kRefused.end();
    EXPECT_EQ(fault.empty(), !refused) << file << " " << fault;
    EXPECT_EQ(fault.starts_with(file.filename().string() + ":"), refused) << fault;
    // 09 feeds after a cycle without a Z.
    EXPECT_EQ(fault_of(file, 0.58, 30.5).empty(), !refused && number != "09") << file;
  }
}

}  // namespace
}  // namespace lekalo::nc_posts_test
