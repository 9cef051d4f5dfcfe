// A machined part and its casting (MIT, BlankLocalizationCore.jl; shared data): both close.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "lekalo/io/solid/solid_file.hpp"
#include "support/shared_data.hpp"

namespace lekalo::io::io_solid_test {
namespace {

TEST(SolidCorpus, APublishedPartAndItsCastingClose) {
  if (cases::shared_data().empty()) GTEST_SKIP() << "LEKALO_SHARED_DATA is not set";
  struct Known {
    const char* name;
    std::size_t triangles, shells;
    double volume;
  };
  for (const Known& known :
       {Known{"machined.stl", 6296, 1, 126006.406852}, Known{"rough.stl", 6152, 3, 177597.402738}}) {
    std::ifstream file(cases::shared_data() + "/solid/" + known.name, std::ios::binary);
    ASSERT_TRUE(file) << known.name;
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    const auto read = parse_solid(bytes, known.name);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->format, "STL");
    const auto closed = solid::closed_mesh(read->mesh);
    ASSERT_TRUE(closed) << closed.error().message;
    EXPECT_TRUE(closed->notices.empty()) << closed->notices[0];
    EXPECT_EQ(closed->mesh.triangles.size(), known.triangles);
    ASSERT_EQ(closed->shells.size(), known.shells);
    double volume = 0;
    for (const solid::Shell& shell : closed->shells) volume += shell.volume;
    EXPECT_NEAR(volume, known.volume, 1e-3);
  }
}

}  // namespace
}  // namespace lekalo::io::io_solid_test
