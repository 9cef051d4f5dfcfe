// Models of 3MF as the reader and the checker put them together, each with arithmetic of its own.

#include <gtest/gtest.h>

#include <string>

#include "lekalo/base/random.hpp"
#include "lekalo/io/solid/solid_file.hpp"
#include "support/cases.hpp"
#include "support/solids.hpp"
#include "support/three_mf_files.hpp"
#include "support/verify_solids.hpp"

namespace lekalo::verify::verify_three_mf_test {
namespace {

using namespace three_mf_files;

std::string random_transform(Random& random) {
  if (random.below(4) == 0) return "";
  std::string text;
  for (int k = 0; k < 12; ++k) {
    const double value = k < 9 ? random.uniform(-1.5, 1.5) : random.uniform(-1000, 1000);
    text += random.below(3) == 0 ? fmt::format("{} ", static_cast<int>(value))
                                 : fmt::format("{:.{}g} ", value, 1 + random.below(17));
  }
  return text;
}

TEST(ThreeMf, EveryCornerIsWhereTheCheckerFindsItExactly) {
  constexpr const char* kUnits[] = {"micron", "millimeter", "centimeter", "inch", "foot", "meter"};
  for (std::size_t i = 0; i < cases::case_count(60); ++i) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), i));
    Random random(cases::seed(), i);
    std::string objects = object(0, mesh(cases::ring(random, 4, 3, 50, 3)), "name=\"a\"");
    const int count = 1 + static_cast<int>(random.below(4));
    for (int k = 1; k <= count; ++k) {
      std::string inner;
      for (std::uint64_t n = 0; n < 1 + random.below(3); ++n)
        inner += component(static_cast<int>(random.below(static_cast<std::uint64_t>(k))),
                           random_transform(random));
      objects += object(k, components(inner), "name=\"b\"");
    }
    const std::string bytes = archive(model(objects, item(count, random_transform(random)) + item(0),
                                            fmt::format("unit=\"{}\"", kUnits[random.below(6)])));
    const auto file = io::parse_solid(bytes, "a");
    const auto other = read_solid({"a", bytes});
    ASSERT_TRUE(file && other && !other->open) << (file ? "read" : file.error().message);
    ASSERT_EQ(file->mesh.vertices.size(), other->mesh.near.size());
    ASSERT_EQ(file->mesh.triangles, other->mesh.triangles);
    double largest = 0;
    for (std::uint32_t v = 0; v < file->mesh.vertices.size(); ++v) {
      const solid::Vector p = file->mesh.vertices[v];
      const double xyz[] = {p.x, p.y, p.z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Fraction off = abs(other->mesh.exact(v, axis) - Fraction(xyz[axis]));
        EXPECT_TRUE(off <= Fraction(file->coordinate_error)) << v;
        largest = std::max(largest, std::abs(xyz[axis]));
      }
    }
    // The bound is not much larger than what rounding does.
    EXPECT_LE(file->coordinate_error, 0x1p-48 * largest);
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_three_mf_test
