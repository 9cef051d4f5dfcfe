// Outlines on the grid: phi's relations against the checker's, which shares nothing with them, on pairs that
// touch in every way; and the checker's question of many outlines against sets of cells.

#include <gtest/gtest.h>

#include "lekalo/phi/outline_relation.hpp"
#include "support/cases.hpp"
#include "support/lattice_outlines.hpp"
#include "verify/layout/grid_outline.hpp"

namespace lekalo::verify_layout_relations_test {
namespace {

using geom::GridPoint;
using geom::GridRegion;

verify::GridOutline checked(const GridRegion& region, GridPoint shift = {}) {
  std::vector<verify::GridLoop> loops;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    auto& loop = loops.emplace_back();
    for (std::uint32_t i = region.loop_starts[l]; i < region.loop_starts[l + 1]; ++i)
      loop.push_back({region.points[i].x + shift.x, region.points[i].y + shift.y});
  }
  return verify::make_outline(std::move(loops));
}

std::string written(const GridRegion& region, GridPoint shift = {}) {
  std::string text;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    text += l == 0 ? "\n  outer" : "\n  hole";
    for (std::uint32_t i = region.loop_starts[l]; i < region.loop_starts[l + 1]; ++i)
      text += " (" + std::to_string(region.points[i].x + shift.x) + ", " +
              std::to_string(region.points[i].y + shift.y) + ")";
  }
  return text;
}

struct Counts {
  int meet = 0, apart = 0, within = 0, near = 0, far = 0;
};

void compare(const GridRegion& a, const GridRegion& b, GridPoint shift, std::int64_t gap, Counts& counts) {
  const verify::GridOutline first = checked(a), second = checked(b, shift);
  const bool meet = phi::interiors_meet(a, b, shift), within = phi::lies_within(a, b, shift),
             near = phi::edges_nearer_than(a, b, gap, shift);
  const auto both = [&] { return "a" + written(a) + "\nb" + written(b, shift); };
  ASSERT_EQ(verify::have_common_disc({&first, &second}, {}), meet) << both();
  ASSERT_EQ(!verify::have_common_disc({&second}, {&first}), within) << both();
  ASSERT_EQ(verify::edges_nearer_than(first, second, gap), near) << "gap " << gap << "\n" << both();
  ++(meet ? counts.meet : counts.apart);
  counts.within += within ? 1 : 0;
  ++(near ? counts.near : counts.far);
}

TEST(LayoutRelationsDifferential, OutlinesOnASmallLattice) {
  Random random(cases::seed(), 4001);
  std::vector<cases::LatticeLoops> pool;
  for (int i = 0; i < 300; ++i) pool.push_back(cases::lattice_polygon(random));
  for (int i = 0; i < 100; ++i) pool.push_back(cases::random_cells(random).loops);
  // Small ones, and what fills a hole, lie within others often.
  const std::size_t large = pool.size();
  for (std::size_t i = 0; i < large; ++i) {
    for (std::size_t hole = 1; hole < pool[i].size(); ++hole) pool.push_back({pool[i][hole]});
    pool.push_back(cases::lattice_polygon(random, 2));
  }
  Counts counts;
  const std::size_t cases = cases::case_count(30'000);
  for (std::size_t i = 0; i < cases; ++i) {
    const cases::LatticeMap map = cases::lattice_map(random);
    const std::size_t one = random.below(pool.size()),
                      other = random.below(10) == 0 ? one : random.below(pool.size());
    const auto a = cases::mapped(pool[one], map);
    auto b = cases::mapped(pool[other], map);
    if (!a || !b) continue;
    const auto small = [&](std::uint64_t n) {
      return static_cast<std::int64_t>(random.below(2 * n + 1)) - static_cast<std::int64_t>(n);
    };
    GridPoint shift = map.vector({small(4), small(4)});
    const std::uint64_t kind = random.below(4);
    if (kind == 0) shift = shift + GridPoint{small(1), small(1)};  // all but touching
    if (kind == 1) {                                               // one of them turned by half a turn
      for (GridPoint& p : b->points) p = map.at + map.at - p;
      shift = shift + map.vector({8, 8});
    }
    const std::int64_t gap = std::max<std::int64_t>(0, small(3) + map.scale * small(5));
    compare(*a, *b, shift, gap, counts);
    if (HasFatalFailure()) {
      ADD_FAILURE() << "case " << i;
      return;
    }
  }
  const auto share = [&](int count) { return static_cast<double>(count) / static_cast<double>(cases); };
  EXPECT_GT(share(counts.meet), 0.15);
  EXPECT_GT(share(counts.meet + counts.apart), 0.9) << "cases that are no outlines";
  EXPECT_GT(share(counts.apart), 0.05);
  EXPECT_GT(share(counts.within), 0.002);
  EXPECT_GT(share(counts.near), 0.1);
  EXPECT_GT(share(counts.far), 0.1);
}

TEST(LayoutRelationsDifferential, TurnedAndRoundedOutlinesInNearContact) {
  Random random(cases::seed(), 4002);
  std::vector<cases::LatticeLoops> pool;
  for (int i = 0; i < 200; ++i) pool.push_back(cases::lattice_polygon(random));
  Counts counts;
  const std::size_t cases = cases::case_count(10'000);
  for (std::size_t i = 0; i < cases; ++i) {
    cases::LatticeMap map = cases::lattice_map(random);
    map.at = {};
    const auto a = cases::mapped(pool[random.below(pool.size())], map);
    const auto b = cases::mapped(pool[random.below(pool.size())], map);
    if (!a || !b) continue;
    const geom::GridRotation rotation = geom::rotation_from_degrees(random.uniform(-180, 180));
    const bool mirrored = random.below(2) == 0;
    // Both turned alike touch as before but for the rounding of each vertex.
    const GridRegion one = turned(*a, rotation, mirrored), other = turned(*b, rotation, mirrored);
    const GridPoint by{static_cast<std::int64_t>(random.below(9)) - 4,
                       static_cast<std::int64_t>(random.below(9)) - 4};
    compare(one, other, geom::turned(map.vector(by), rotation, mirrored), map.scale, counts);
    if (HasFatalFailure()) {
      ADD_FAILURE() << "case " << i;
      return;
    }
  }
  EXPECT_GT(counts.meet, static_cast<int>(cases / 5));
  EXPECT_GT(counts.apart, static_cast<int>(cases / 50));
}

TEST(LayoutRelationsDifferential, ManyOutlinesAreSetsOfCells) {
  Random random(cases::seed(), 4003);
  std::vector<cases::Cells> pool;
  for (int i = 0; i < 200; ++i) pool.push_back(cases::random_cells(random));
  int yes = 0, no = 0;
  const std::size_t cases = cases::case_count(10'000);
  for (std::size_t i = 0; i < cases; ++i) {
    const cases::LatticeMap map = cases::lattice_map(random);
    std::vector<verify::GridOutline> outlines;
    std::vector<const cases::Cells*> cells;
    for (int k = 0; k < 5; ++k) {
      cells.push_back(&pool[random.below(pool.size())]);
      const auto region = cases::mapped(cells.back()->loops, map);
      if (!region) break;
      outlines.push_back(checked(*region));
    }
    if (outlines.size() != 5) continue;
    const std::size_t ins = 1 + random.below(3), all = ins + random.below(6 - ins);
    std::vector<const verify::GridOutline*> in, out;
    for (std::size_t k = 0; k < all; ++k) (k < ins ? in : out).push_back(&outlines[k]);
    bool expected = false;
    for (std::size_t cell = 0; cell < cells[0]->in.size(); ++cell) {
      bool here = true;
      for (std::size_t k = 0; k < all; ++k) here = here && cells[k]->in[cell] == (k < ins);
      expected = expected || here;
    }
    ASSERT_EQ(verify::have_common_disc(in, out), expected) << "case " << i;
    ++(expected ? yes : no);
  }
  EXPECT_GT(yes, static_cast<int>(cases / 5));
  EXPECT_GT(no, static_cast<int>(cases / 50));
}

}  // namespace
}  // namespace lekalo::verify_layout_relations_test
