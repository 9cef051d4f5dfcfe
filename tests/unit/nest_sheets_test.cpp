#include <gtest/gtest.h>
#include <sys/resource.h>

#include <set>

#include "lekalo/layout/job.hpp"
#include "lekalo/nest/nest.hpp"

// Orders that take thousands of sheets.

namespace lekalo::nest::nest_sheets_test {
namespace {

/// The most memory that this program has had so far, MB.
long most_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

TEST(NestSheets, ASheetTakesMemoryForWhatLiesOnItAndNotForTheWholeOrder) {
  constexpr std::int64_t kSheets = 2000;
  layout::Document document;
  layout::Part part;
  part.id = "square";
  part.outline.polygon = geom::rectangle({{0, 0}, {geom::grid_from_mm(90), geom::grid_from_mm(90)}});
  part.demand = kSheets;
  part.rotations = {{0, 0}};
  document.parts.push_back(part);
  document.stocks.push_back(layout::sheet_of(geom::grid_from_mm(100), geom::grid_from_mm(100), kSheets));
  RunControl control;
  control.work_limit = 1;
  const long before = most_memory();
  const auto nested = nest(document, {}, control);
  ASSERT_TRUE(nested) << nested.error().message;
  std::set<std::int64_t> copies;
  for (const layout::Placement& placement : nested->document.placements) copies.insert(placement.copy);
  EXPECT_EQ(copies.size(), std::size_t{kSheets});
  // Scenes for all items on each sheet took 1.2 GB.
  EXPECT_LT(most_memory() - before, 600);
}

}  // namespace
}  // namespace lekalo::nest::nest_sheets_test
