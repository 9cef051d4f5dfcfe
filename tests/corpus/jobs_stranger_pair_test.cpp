// The machined part and its rough casting of a stranger (MIT, BlankLocalizationCore.jl), which are among the
// shared data: each of its three groups of features alone, with the rotation fixed, keeps at least what its
// authors found: 0.5 to 1 mm on its planes, which is what they demand, and 1.489 mm around each hole.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/solid/solid_file.hpp"
#include "lekalo/jobs/locate_solid.hpp"
#include "support/shared_data.hpp"
#include "support/solid_files.hpp"

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

/// A plane across an axis of the files: two places of it in the part, and a place 0.75 mm within that of the
/// casting. Within 0.25 mm of there it has the allowance that is demanded.
std::string below(const char* name, const char* one, const char* other, const char* normal,
                  const char* through) {
  return fmt::format(
      R"({{"name": "{}", "points": [{}, {}], "plane": {{"normal": {}, "through": {}}}, "within": 0.25}})",
      name, one, other, normal, through);
}

/// The casting without two chips of 48 triangles each, which touch the wall of right hole 3 of the part all
/// over: they lie where that hole is milled, and no pose has both of them outside of the part.
std::string casting_without_chips(const std::string& bytes) {
  io::SolidFile file = io::parse_solid(bytes, "rough.stl", {}).value();
  const auto is_of_chip = [&](std::uint32_t v) {
    const solid::Vector p = file.mesh.vertices[v];
    return p.x >= 25.66 && p.x <= 26.01 && std::abs(p.y) >= 12.84 && std::abs(p.y) <= 13.51 &&
           p.z >= -21.66 && p.z <= -13.34;
  };
  const std::size_t dropped = std::erase_if(file.mesh.triangles, [&](const solid::Triangle& t) {
    return std::all_of(t.begin(), t.end(), is_of_chip);
  });
  EXPECT_EQ(dropped, 96U);
  return solid_files::stl_text(file.mesh);
}

/// What is left at best of the faces of a file of features where the datums are kept; all else is as cast.
double best_allowance(const std::string& feature, const std::string& datums) {
  const std::string folder = cases::shared_data() + "/solid";
  SolidLocateJob job;
  job.part = {"machined.stl", disk::read_file(folder + "/machined.stl").value()};
  job.blank = {"rough.stl", casting_without_chips(disk::read_file(folder + "/rough.stl").value())};
  job.features = File{"features.json", fmt::format(R"({{"as_cast": true, "features": [{}], "datums": [{}]}})",
                                                   feature, datums)};
  job.options.freedom = locate::SolidFreedom::xyz;
  job.options.gap = 0.05;
  job.options.shift = 1;
  const auto located = locate_solid(job);
  EXPECT_TRUE(located) << (located ? "" : located.error().message);
  if (!located) return 0;
  EXPECT_TRUE(located->holds()) << located->result;
  EXPECT_EQ(located->document.status, "optimal");
  return located->document.clearance.value_or(0);
}

constexpr const char *kX = "[1, 0, 0]", *kZ = "[0, 0, 1]";

/// Of the walls of each group at least one keeps 0.5 mm all over, its ends at the planes among it.
TEST(StrangersPair, FrontGroupAloneKeepsItsAllowance) {
  if (cases::shared_data().empty()) GTEST_SKIP() << "LEKALO_SHARED_DATA is not set";
  EXPECT_GE(best_allowance(R"({"name": "front hole", "patch": [0, 29, 0]})",
                           around("front hole", "[0, 0, -30]", "[0, 0, 40]", 29, kZ, "[0, 0, 0]", 26) + ", " +
                               below("front face", "[-33, 0, 42.5]", "[33, 0, 42.5]", kZ, "[0, 0, 42.25]")),
            0.5);
}

TEST(StrangersPair, RightGroupAloneKeepsItsAllowance) {
  if (cases::shared_data().empty()) GTEST_SKIP() << "LEKALO_SHARED_DATA is not set";
  EXPECT_GE(
      best_allowance(
          R"({"name": "right hole 1", "patch": [30, 22.5, 26.5]})",
          around("right hole 1", "[20, 15, 26.5]", "[41, 15, 26.5]", 7.5, kX, "[0, 15, 26.5]", 6) + ", " +
              around("right hole 2", "[20, -16, 17.5]", "[44, -16, 17.5]", 9, kX, "[0, -16, 18.5]", 4.905) +
              ", " + around("right hole 3", "[26, 0, -17.5]", "[38, 0, -17.5]", 13.5, kX, "[0, 0, -18]", 8) +
              ", " + below("right face 1", "[41, 15, 36]", "[41, 15, 17]", kX, "[40.75, 0, 0]") + ", " +
              below("right face 2", "[44, -16, 28]", "[44, -16, 7]", kX, "[43.75, 0, 0]") + ", " +
              below("right face 3", "[38, 0, -2.5]", "[38, 0, -32.5]", kX, "[37.75, 0, 0]")),
      0.5);
}

/// The back holes end in the floor of the front one, which is as cast.
TEST(StrangersPair, BackGroupAloneKeepsItsAllowance) {
  if (cases::shared_data().empty()) GTEST_SKIP() << "LEKALO_SHARED_DATA is not set";
  EXPECT_GE(
      best_allowance(
          R"({"name": "back hole 1", "patch": [14, 23, -37.5]}, )"
          R"({"name": "back hole 2", "patch": [-14, 23, -37.5]}, )"
          R"({"name": "floor", "plane": {"normal": [0, 0, 1], "at": -32.5, "within": 0.01}, )"
          R"("finished": 4, "rim": 2.5})",
          around("back hole 1", "[14, 14, -42.5]", "[14, 14, -32.5]", 9, kZ, "[14, 13.9, 0]", 6.2) + ", " +
              around("back hole 2", "[-14, 14, -42.5]", "[-14, 14, -32.5]", 9, kZ, "[-13.9, 14, 0]", 6.25) +
              ", " + below("back face", "[14, 25, -42.5]", "[0, -25, -42.5]", kZ, "[0, 0, -41.75]")),
      0.5);
}

}  // namespace
}  // namespace lekalo::jobs::jobs_stranger_pair_test
