#include <gtest/gtest.h>

#include <algorithm>

#include "lekalo/base/random.hpp"
#include "nest/separator/box_list.hpp"
#include "support/cases.hpp"

namespace lekalo::nest::nest_box_list_test {
namespace {

TEST(BoxList, FindsAllThatMeetAndNothingFurtherAway) {
  Random random(cases::seed(), 9);
  constexpr std::uint32_t kItems = 37;
  struct Item {
    std::uint32_t bin = ~std::uint32_t{0};
    Box box;
  };
  std::vector<Item> items(kItems);
  BoxList list(kItems);
  const double far = 1e4;
  const auto any_box = [&] {
    const double x = random.uniform(-far, far), y = random.uniform(-far, far);
    return Box{x, y, x + random.uniform(0, far), y + random.uniform(0, far)};
  };
  std::vector<std::uint32_t> found;
  std::size_t met = 0, near = 0;
  for (std::size_t i = 0; i < cases::case_count(2000); ++i) {
    const auto moved = static_cast<std::uint32_t>(random.below(kItems));
    items[moved] = {static_cast<std::uint32_t>(random.below(3)), any_box()};
    list.set(moved, items[moved].bin, items[moved].box);
    const auto bin = static_cast<std::uint32_t>(random.below(3));
    Box box = any_box();
    // Beside an item, a rounding away on either side.
    if (random.below(2) == 0) box.x0 = items[random.below(kItems)].box.x1 + random.uniform(-1e-9, 1e-9);
    list.find(bin, box, found);
    ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
    for (std::uint32_t j = 0; j < kItems; ++j) {
      const Box& b = items[j].box;
      const double gap = std::max({b.x0 - box.x1, box.x0 - b.x1, b.y0 - box.y1, box.y0 - b.y1});
      const bool is_found = std::binary_search(found.begin(), found.end(), j);
      if (items[j].bin != bin) {
        ASSERT_FALSE(is_found);
      } else if (gap < 0) {
        ASSERT_TRUE(is_found) << "case " << i << " of seed " << cases::seed() << ", item " << j;
        ++met;
      } else if (gap > 4e-6 * far) {
        ASSERT_FALSE(is_found) << "case " << i << " of seed " << cases::seed() << ", item " << j;
      } else {
        ++near;
      }
    }
  }
  EXPECT_GT(met, 100u);
  EXPECT_GT(near, 10u);
}

}  // namespace
}  // namespace lekalo::nest::nest_box_list_test
