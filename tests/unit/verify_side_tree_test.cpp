#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"
#include "verify/shape/side_tree.hpp"

// The checker's tree over boxes, against all boxes.

namespace lekalo::verify::verify_side_tree_test {
namespace {

Box random_box(Random& random) {
  const double x = 100 * random.uniform(), y = 100 * random.uniform();
  return {x, y, x + 10 * random.uniform(), y + 10 * random.uniform()};
}

TEST(VerifySideTree, FindsWhatMeetsABoxAndWhatOverflowHasSpoiledEverywhere) {
  for (std::size_t n = 0; n < cases::case_count(200); ++n) {
    Random random(cases::seed(), n);
    std::vector<Box> boxes(random.below(60));
    std::set<std::uint32_t> expected;
    const Box asked = random_box(random);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      boxes[i] = random_box(random);
      const bool spoiled = n % 2 == 1 && random.below(3) == 0;
      if (spoiled) boxes[i].high_x = std::numeric_limits<double>::infinity();
      if (spoiled || meet(boxes[i], asked)) expected.insert(i);
    }
    std::vector<std::uint32_t> found;
    SideTree(boxes).visit([&](const Box& box) { return meet(box, asked); },
                          [&](std::uint32_t side) { found.push_back(side); });
    EXPECT_EQ(std::set<std::uint32_t>(found.begin(), found.end()), expected) << "case " << n;
    EXPECT_EQ(found.size(), expected.size()) << "case " << n;
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_side_tree_test
