// The machined part and its rough casting of a stranger (MIT, BlankLocalizationCore.jl), which are among the
// shared data: each of its three groups of features alone, with the rotation fixed, keeps at least what its
// authors found: 0.5 mm on the walls that are demanded, and 1.489 mm around holes by where their axes may be.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/locate_solid.hpp"
#include "support/shared_data.hpp"

namespace lekalo::jobs::jobs_stranger_pair_test {
namespace {

/// A hole along an axis of the files: radius and two places of its axis in the part, and in the casting. The
/// skins of both coincide around most holes, so that their walls have nothing left at their ends. But a hole
/// of the casting that is off by less than the radii differ, less an allowance, leaves it all around.
std::string around(const char* name, const char* from, const char* to, double radius, const char* along,
                   const char* through, double rough_radius) {
  return fmt::format(
      R"({{"name": "{}", "points": [{}, {}], "axis": {{"along": {}, "through": {}}}, "within": {:.3f}}})",
      name, from, to, along, through, radius - rough_radius - 1.489);
}

/// What is left at best of the faces of a file of features where the datums are kept; all else is as cast.
double best_allowance(const std::string& feature, const std::string& datums) {
  const std::string folder = cases::shared_data() + "/solid";
  SolidLocateJob job;
  job.part = {"machined.stl", disk::read_file(folder + "/machined.stl").value()};
  job.blank = {"rough.stl", disk::read_file(folder + "/rough.stl").value()};
  job.features = File{"features.json", fmt::format(R"({{"as_cast": true, "features": [{}], "datums": [{}]}})",
                                                   feature, datums)};
  job.options.freedom = locate::SolidFreedom::xyz;
  job.options.method = SolidMethod::climb;
  job.options.shift = 1;
  const auto located = locate_solid(job);
  EXPECT_TRUE(located) << (located ? "" : located.error().message);
  if (!located) return 0;
  EXPECT_TRUE(located->holds()) << located->result;
  return located->document.clearance.value_or(0);
}

const std::string kFront = R"({"name": "front hole", "patch": [0, 29, 0]})",
                  kRight = R"({"name": "right hole 1", "patch": [30, 22.5, 26.5]})";

TEST(StrangersPair, EachGroupAloneKeepsAtLeastItsAllowance) {
  if (cases::shared_data().empty()) GTEST_SKIP() << "LEKALO_SHARED_DATA is not set";
  // The walls of two holes end where something is left, by 0.5 mm at the faces.
  EXPECT_GE(best_allowance(
                kFront, around("front hole", "[0, 0, -30]", "[0, 0, 40]", 29, "[0, 0, 1]", "[0, 0, 0]", 26)),
            0.5);
  EXPECT_GE(best_allowance(kRight, around("right hole 2", "[20, -16, 17.5]", "[44, -16, 17.5]", 9,
                                          "[1, 0, 0]", "[0, -16, 18.5]", 4.905) +
                                       ", " +
                                       around("right hole 3", "[26, 0, -17.5]", "[38, 0, -17.5]", 13.5,
                                              "[1, 0, 0]", "[0, 0, -18]", 8)),
            0.5);
  EXPECT_GE(best_allowance(kFront, around("back hole 1", "[14, 14, -42.5]", "[14, 14, -32.5]", 9, "[0, 0, 1]",
                                          "[14, 13.9, 0]", 6.2) +
                                       ", " +
                                       around("back hole 2", "[-14, 14, -42.5]", "[-14, 14, -32.5]", 9,
                                              "[0, 0, 1]", "[-13.9, 14, 0]", 6.25)),
            0.5);
}

}  // namespace
}  // namespace lekalo::jobs::jobs_stranger_pair_test
