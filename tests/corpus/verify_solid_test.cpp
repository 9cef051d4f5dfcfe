// Files of parts and their castings, as the checker sees them: the example's, and a machined part with its
// own (MIT, BlankLocalizationCore.jl), which is among the shared data.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "support/places.hpp"
#include "support/shared_data.hpp"
#include "support/solids.hpp"
#include "support/verify_solids.hpp"

namespace lekalo::verify::verify_solid_test {
namespace {

SolidMesh mesh_of(const std::string& folder, const std::string& name) {
  std::ifstream file(folder + "/" + name, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const auto read = read_solid({name, bytes});
  if (!read || read->open) throw std::runtime_error(read ? *read->open : read.error().message);
  auto made = closed(read->mesh, name);
  if (!made) throw std::runtime_error(made.error().message);
  return *std::move(made);
}

TEST(SolidCorpus, TheExampleLiesInItsCastingAtThePoseOfTheDemoAndNoNearer) {
  const std::string folder = cases::source_dir() + "/examples/solid";
  const SolidMesh part = mesh_of(folder, "part.stl"), casting = mesh_of(folder, "casting.stl");
  for (const SolidMesh* mesh : {&part, &casting}) {
    EXPECT_EQ(mesh->triangles.size(), 384u);
    EXPECT_EQ(PlacedSolid(*mesh).one_of_each_component().size(), 1u);
  }
  const SolidPose pose = cases::solid_pose(
      {"0.9995336326409605", "0.008618472477176889", "-0.005745631604643611", "0.028726762246887683"},
      {"2.8979402829093255", "-1.5964379604221421", "0.6176184401660432"});
  EXPECT_EQ(cases::answer(part, casting, pose, "1.96506479"), "shown");
  EXPECT_NE(cases::answer(part, casting, pose, "1.9650648").find("is above 1.96506479173"),
            std::string::npos);
  EXPECT_NE(cases::answer(part, casting, cases::unturned(), "0").find("passes through"), std::string::npos);
}

TEST(SolidCorpus, APublishedPartAndItsCastingCloseAndLieAsTheyDo) {
  if (cases::shared_data().empty()) GTEST_SKIP() << "LEKALO_SHARED_DATA is not set";
  const std::string folder = cases::shared_data() + "/solid";
  const SolidMesh part = mesh_of(folder, "machined.stl"), casting = mesh_of(folder, "rough.stl");
  EXPECT_EQ(part.triangles.size(), 6296u);
  EXPECT_EQ(casting.triangles.size(), 6152u);
  EXPECT_EQ(PlacedSolid(part).one_of_each_component().size(), 1u);
  EXPECT_EQ(PlacedSolid(casting).one_of_each_component().size(), 3u);
  // Both begin at x = -36, which their texts say to the last digit.
  const SolidMesh box = cases::checked(cases::block({-46, -60, -60}, {60, 60, 60}));
  for (const SolidMesh* mesh : {&part, &casting}) {
    EXPECT_EQ(cases::answer(*mesh, box, cases::unturned(), "10"), "shown");
    EXPECT_NE(cases::answer(*mesh, box, cases::unturned(), "10.00000000000000000001").find("is nearer"),
              std::string::npos);
    EXPECT_EQ(cases::answer(*mesh, box, cases::unturned({"0.1", "0", "0"}), "10.1"), "shown");
    EXPECT_NE(cases::answer(*mesh, box, cases::unturned({"-1e-20", "0", "0"}), "10").find("is nearer"),
              std::string::npos);
  }
  // Without the three part zeros moved as its authors do, the part passes through its casting.
  EXPECT_NE(cases::answer(part, casting, cases::unturned(), "0").find("passes through"), std::string::npos);
  EXPECT_NE(cases::answer(part, casting, cases::unturned({"500", "0", "0"}), "0").find("lies outside"),
            std::string::npos);
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_test
