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

/// Squares of which one has room on a sheet.
layout::Document squares(std::int64_t pieces, std::int64_t sheets) {
  layout::Document document;
  layout::Part part;
  part.id = "square";
  part.outline.polygon = geom::rectangle({{0, 0}, {geom::grid_from_mm(90), geom::grid_from_mm(90)}});
  part.demand = pieces;
  part.rotations = {{0, 0}};
  document.parts.push_back(part);
  document.stocks.push_back(layout::sheet_of(geom::grid_from_mm(100), geom::grid_from_mm(100), sheets));
  return document;
}

TEST(NestSheets, ASheetTakesMemoryForWhatLiesOnItAndNotForTheWholeOrder) {
  constexpr std::int64_t kSheets = 2000;
  RunControl control;
  control.work_limit = 1;
  const long before = most_memory();
  const auto nested = nest(squares(kSheets, kSheets), {}, control);
  ASSERT_TRUE(nested) << nested.error().message;
  std::set<std::int64_t> copies;
  for (const layout::Placement& placement : nested->document.placements) copies.insert(placement.copy);
  EXPECT_EQ(copies.size(), std::size_t{kSheets});
  // Scenes for all items on each sheet took 1.2 GB.
  EXPECT_LT(most_memory() - before, 600);
}

TEST(NestSheets, MoreThanTwentyThousandPiecesGetAFirstLayoutAlone) {
  RunControl control;
  control.work_limit = 1;
  const auto searched = nest(squares(20'000, 10), {}, control);
  ASSERT_TRUE(searched) << searched.error().message;
  EXPECT_TRUE(searched->searched);
  // Nothing limits the work of this one.
  const auto nested = nest(squares(20'001, 10), {}, {});
  ASSERT_TRUE(nested) << nested.error().message;
  EXPECT_FALSE(nested->searched);
  EXPECT_EQ(nested->merges, 1U);
  EXPECT_EQ(nested->document.placements.size(), 10U);
}

}  // namespace
}  // namespace lekalo::nest::nest_sheets_test
