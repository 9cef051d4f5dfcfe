// A machined part and its casting (MIT, BlankLocalizationCore.jl; shared data), as the checker sees them.

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iterator>
#include <string>

#include "support/shared_data.hpp"
#include "support/solids.hpp"
#include "support/verify_solids.hpp"

namespace lekalo::verify::verify_solid_test {
namespace {

SolidMesh shared(const std::string& name) {
  std::ifstream file(cases::shared_data() + "/solid/" + name, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const auto read = read_solid({name, bytes});
  if (!read || read->open) throw std::runtime_error(read ? *read->open : read.error().message);
  auto made = closed(read->mesh, name);
  if (!made) throw std::runtime_error(made.error().message);
  return *std::move(made);
}

TEST(SolidCorpus, APublishedPartAndItsCastingCloseAndLieAsTheyDo) {
  if (cases::shared_data().empty()) GTEST_SKIP() << "LEKALO_SHARED_DATA is not set";
  const SolidMesh part = shared("machined.stl"), casting = shared("rough.stl");
  EXPECT_EQ(part.triangles.size(), 6296u);
  EXPECT_EQ(casting.triangles.size(), 6152u);
  EXPECT_EQ(PlacedSolid(part).one_of_each_component().size(), 1u);
  EXPECT_EQ(PlacedSolid(casting).one_of_each_component().size(), 3u);
  for (const SolidMesh* mesh : {&part, &casting}) {
    const Box3 box = PlacedSolid(*mesh).tree().whole();
    std::cout << fmt::format("{} {} {} / {} {} {}\n", box.low[0], box.low[1], box.low[2], box.high[0],
                             box.high[1], box.high[2]);
  }
  for (const auto& shift : {cases::unturned(), cases::unturned({"82", "29.7558", "39.9886"}),
                            cases::unturned({"0.25", "0", "0"})})
    std::cout << cases::answer(part, casting, shift, "0") << "\n";
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_test
