#include <gtest/gtest.h>

#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/nest/nest.hpp"
#include "nest/separator/cost_sums.hpp"
#include "nest/separator/lattice_unit.hpp"
#include "nest/separator/separator.hpp"
#include "nest/strand/strand.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::nest::nest_separator_test {
namespace {

/// Parts of whole millimetres at quarter turns on a strip.
layout::Document whole_millimetres(std::vector<std::vector<geom::GridPoint>> loops, double height) {
  layout::Document document = cases::two_squares();
  const layout::Part part = document.parts[0];
  document.placements.clear();
  document.parts.clear();
  for (auto& loop : loops) {
    document.parts.push_back(part);
    document.parts.back().id = "p" + std::to_string(document.parts.size());
    document.parts.back().outline = cases::outline_of({std::move(loop)});
    document.parts.back().rotations = {{0, 0}, {90, 90}, {180, 180}, {270, 270}};
    document.parts.back().demand = 1;
  }
  document.stocks[0].kind = layout::StockKind::strip;
  document.stocks[0].outline =
      cases::outline_of({cases::box_loop(0, 0, geom::mm_from_grid(layout::kLongestStrip), height)});
  return document;
}

std::vector<geom::GridPoint> l_shape(double size) {
  return {cases::grid_point(0, 0), cases::grid_point(size, 0),     cases::grid_point(size, 2),
          cases::grid_point(2, 2), cases::grid_point(2, size - 1), cases::grid_point(0, size - 1)};
}

Items items_of(const Problem& problem) {
  Items items;
  for (std::uint32_t p = 0; p < problem.document().parts.size(); ++p) {
    items.parts.push_back(p);
    items.forms.push_back(problem.forms_of(p));
  }
  return items;
}

TEST(CostGrid, IsTheSumOfTheCostsAtEveryNode) {
  const layout::Document document =
      whole_millimetres({l_shape(5), l_shape(7), cases::box_loop(0, 0, 4, 3)}, 20);
  const Problem problem(document, {});
  const auto cost = [&](const Form& a, const Form& b, double dx, double dy) {
    const double depth = problem.depth(a, b, dx, dy);
    return static_cast<float>(depth > 1e-6 ? depth : 0);
  };
  CostGrid grid(problem, 1, cost);
  Random random(cases::seed(), 7);
  std::size_t free = 0;
  for (std::size_t i = 0; i < cases::case_count(50); ++i) {
    const auto any_form = [&] { return static_cast<std::uint32_t>(random.below(problem.forms().size())); };
    const auto moved = any_form();
    const double x0 = -3.0 + static_cast<double>(random.below(6)), y0 = 2;
    NodeGrid nodes;
    nodes.begin(x0, y0, 21, 13);
    struct Item {
      std::uint32_t form;
      double x, y;
      float weight;
    };
    std::vector<Item> items;
    for (int k = 0; k < 4; ++k) {
      items.push_back({any_form(), static_cast<double>(random.below(22)),
                       static_cast<double>(random.below(18)), static_cast<float>(1 + random.below(3))});
      grid.add(nodes, items.back().form, moved, items.back().x, items.back().y, items.back().weight);
    }
    for (std::uint32_t r = 0; r < nodes.rows; ++r)
      for (std::uint32_t c = 0; c < nodes.columns; ++c) {
        float sum = 0;
        for (const Item& item : items)
          sum += item.weight *
                 cost(problem.forms()[item.form], problem.forms()[moved], x0 + c - item.x, y0 + r - item.y);
        EXPECT_NEAR(nodes.row(r)[c], sum, 12.0 / (1 << 14)) << "case " << i << " of seed " << cases::seed();
        free += sum == 0 ? 1 : 0;
      }
  }
  EXPECT_GT(free, 0u);
}

TEST(CostSums, AreTheSameAsAddedUpAnew) {
  const layout::Document document =
      whole_millimetres({l_shape(5), l_shape(7), cases::box_loop(0, 0, 4, 3)}, 20);
  const Problem problem(document, {});
  CostGrid grid(problem, 0.37, [&](const Form& a, const Form& b, double dx, double dy) {
    return static_cast<float>(0.1 * std::max(0.0, problem.depth(a, b, dx, dy)));
  });
  const auto forms = static_cast<std::uint32_t>(problem.forms().size());
  CostSums sums(2, forms);
  Random random(cases::seed(), 8);
  NodeGrid fixed;  // what does not move on the second bin
  fixed.begin(0.5, 1, 41, 30);
  grid.add(fixed, 1, 2, 7, 6, 1);
  std::vector<Spot> spots(12, Spot{0, 0, 0, kNowhere});
  for (std::size_t i = 0; i < cases::case_count(300); ++i) {
    // Some move, to another bin or nowhere too.
    for (std::size_t moved = 1 + random.below(random.below(10) == 0 ? 12 : 3); moved > 0; --moved) {
      const std::uint64_t bin = random.below(3);
      spots[random.below(spots.size())] = {random.uniform(-1, 21), random.uniform(0, 18),
                                           static_cast<std::uint32_t>(random.below(forms)),
                                           bin == 2 ? kNowhere : static_cast<std::uint32_t>(bin)};
    }
    const auto form = static_cast<std::uint32_t>(random.below(3));
    const auto bin = static_cast<std::uint32_t>(random.below(2));
    const auto columns = static_cast<std::uint32_t>(40 + random.below(2));
    const NodeGrid* rest = bin == 1 ? &fixed : nullptr;
    const NodeGrid& now = sums.now(grid, form, bin, 0.5, 1, columns, 30, spots, rest);
    NodeGrid anew;
    anew.begin(0.5, 1, columns, 30);
    if (rest != nullptr) anew.add(*rest, 0, 0, 1);
    for (const Spot& s : spots)
      if (s.bin == bin) grid.add(anew, s.form, form, s.x, s.y, 1);
    ASSERT_EQ(now.sums, anew.sums) << "case " << i << " of seed " << cases::seed();
  }
}

/// A window of what obstacles cost together is the sum of their costs there.
TEST(CostGrid, AddsObstaclesTogetherAndWindowsOfThem) {
  const layout::Document document =
      whole_millimetres({l_shape(5), l_shape(7), cases::box_loop(0, 0, 4, 3)}, 20);
  const Problem problem(document, {});
  const auto cost = [&](const Form& a, const Form& b, double dx, double dy) {
    return static_cast<float>(0.1 * std::max(0.0, problem.depth(a, b, dx, dy)));
  };
  CostGrid grid(problem, 0.5, cost);
  const std::vector<Obstacle> obstacles = {{0, 3, 4}, {5, 9, 8}, {9, 4, 5}};
  NodeGrid all;
  all.begin(0.5, 1, 45, 30);
  grid.add_obstacles(all, obstacles, 2);
  NodeGrid window;
  window.begin(0.5 + 0.5 * 7, 1 + 0.5 * 3, 19, 11);
  window.add(all, 7, 3, 2);
  std::size_t costly = 0;
  for (std::uint32_t r = 0; r < window.rows; ++r)
    for (std::uint32_t c = 0; c < window.columns; ++c) {
      float sum = 0;
      for (const Obstacle& o : obstacles)
        sum += 2 * cost(problem.forms()[o.form], problem.forms()[2], window.x0 + 0.5 * c - o.x,
                        window.y0 + 0.5 * r - o.y);
      EXPECT_NEAR(window.row(r)[c], sum, 6.0 / (1 << 14));
      costly += sum > 0 ? 1 : 0;
    }
  EXPECT_GT(costly, 0u);
}

/// Items that slide away from a point stay valid, come no nearer to it, and leave room there.
TEST(MakeRoom, SlidesEverythingAwayFromAPoint) {
  layout::Document document =
      whole_millimetres({cases::box_loop(0, 0, 4, 4), cases::box_loop(0, 0, 4, 4), l_shape(5),
                         cases::box_loop(0, 0, 6, 3), l_shape(4), cases::box_loop(0, 0, 3, 3)},
                        40);
  document.stocks[0].kind = layout::StockKind::sheet;
  document.stocks[0].outline = cases::outline_of({cases::box_loop(0, 0, 40, 40)});
  const Problem problem(document, {});
  const Items items = items_of(problem);
  Random random(cases::seed(), 9);
  for (std::size_t n = 0; n < cases::case_count(100); ++n) {
    SCOPED_TRACE("case " + std::to_string(n) + " of seed " + std::to_string(cases::seed()));
    Separator separator(problem, items, Random(n));
    State state;
    for (std::size_t i = 0; i < items.movable(); ++i) {  // each in a cell of its own
      const Forms& forms = items.forms[i];
      const auto form = forms.first + static_cast<std::uint32_t>(random.below(forms.last - forms.first));
      const Box& box = problem.forms()[form].box;
      state.spots.push_back({13.0 * static_cast<double>(i % 3) + random.uniform(0, 6) - box.x0,
                             20.0 * static_cast<double>(i / 3) + random.uniform(0, 13) - box.y0, form, 0});
    }
    state.ends = state.tops = {40};
    state.open_bins = {0};
    separator.load(state);
    ASSERT_LE(separator.overlap(), 0);
    const geom::Point at = {random.uniform(0, 40), random.uniform(0, 40)};
    const auto far = [&](std::size_t i) {
      const Spot& spot = separator.state().spots[i];
      const Box& box = problem.forms()[spot.form].box;
      return std::hypot(spot.x + 0.5 * (box.x0 + box.x1) - at.x, spot.y + 0.5 * (box.y0 + box.y1) - at.y);
    };
    std::vector<double> before;
    for (std::size_t i = 0; i < items.movable(); ++i) before.push_back(far(i));
    separator.make_room(0, at);
    EXPECT_LE(separator.overlap(), 0);
    double more = 0;
    for (std::size_t i = 0; i < items.movable(); ++i) {
      EXPECT_GE(far(i), before[i] - 1e-9);
      more += far(i) - before[i];
      const Spot& spot = separator.state().spots[i];
      const Box& box = problem.forms()[spot.form].box;
      EXPECT_TRUE(spot.x + box.x0 >= -1e-9 && spot.x + box.x1 <= 40 + 1e-9 && spot.y + box.y0 >= -1e-9 &&
                  spot.y + box.y1 <= 40 + 1e-9);
    }
    EXPECT_GT(more, 10);
  }
}

/// A row of squares with some room between all of them: the fifth goes where that is made one.
TEST(MakeRoom, GathersWhatIsMissingForOneMore) {
  const std::vector<geom::GridPoint> square = cases::box_loop(0, 0, 10, 10);
  layout::Document document = whole_millimetres({square, square, square, square, square}, 10);
  document.stocks[0].kind = layout::StockKind::sheet;
  document.stocks[0].outline = cases::outline_of({cases::box_loop(0, 0, 51, 10)});
  const Problem problem(document, {});
  const Items items = items_of(problem);
  Separator separator(problem, items, Random(1));
  State state;
  for (int k = 0; k < 5; ++k) state.spots.push_back({2.0 + 12 * k, 0, items.forms[0].first, 0});
  state.spots[4].bin = kNowhere;
  state.ends = {51};
  state.tops = {10};
  state.open_bins = {0};
  separator.load(state);
  separator.make_room(0, {25, 5});
  EXPECT_LT(separator.state().spots[1].x, 10.1);
  EXPECT_GT(separator.state().spots[2].x, 30.9);
  separator.put_near(4, 0, {25, 5});
  EXPECT_TRUE(separator.relax(200));
}

/// A full row with a little room between all: places thrown at random hardly ever close it.
TEST(Strand, MakesRoomForTheLastPiece) {
  constexpr std::size_t kSquares = 13;
  layout::Document document = whole_millimetres(std::vector(kSquares, cases::box_loop(0, 0, 10, 10)), 10);
  document.stocks[0].kind = layout::StockKind::sheet;
  document.stocks[0].outline = cases::outline_of({cases::box_loop(0, 0, 130.5, 10)});
  const Problem problem(document, {});
  const Items items = items_of(problem);
  State state;
  for (std::size_t k = 0; k < kSquares; ++k)
    state.spots.push_back({10.85 * static_cast<double>(k), 0, items.forms[k].first, 0});
  state.spots.back().bin = kNowhere;
  state.ends = {130.5};
  state.tops = {10};
  state.open_bins = {0};
  for (const std::uint64_t seed : {1, 2, 3}) {
    Strand strand(problem, items, seed, 0);
    strand.start(state);
    EXPECT_GT(strand.merit().unplaced, 0);
    strand.run(20'000);
    EXPECT_EQ(strand.merit().unplaced, 0) << "seed " << seed;
  }
}

class RelaxedSquares : public testing::Test {
 protected:
  /// Three squares of 4 mm, nearly one upon the other, on so much of a strip of height 4.
  bool relaxed(double length) {
    const layout::Document document = whole_millimetres(
        {cases::box_loop(0, 0, 4, 4), cases::box_loop(0, 0, 4, 4), cases::box_loop(0, 0, 4, 4)}, 4);
    const Problem problem(document, {});
    const Items items = items_of(problem);
    Separator separator(problem, items, Random(1));
    State state;
    for (int k = 0; k < 3; ++k) state.spots.push_back({2.0 + 1.5 * k, 0, items.forms[0].first, 0});
    state.ends = {length};
    state.tops = {4};
    state.open_bins = {0};
    separator.load(state);
    const bool done = separator.relax(200);
    EXPECT_EQ(separator.overlap() <= 0, done);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!done) {
        EXPECT_EQ(separator.state().spots[k].x, state.spots[k].x);
      }
      EXPECT_GE(separator.state().spots[k].x, 0);
      EXPECT_LE(separator.state().spots[k].x, length - 4);
    }
    return done;
  }
};

TEST_F(RelaxedSquares, LieBesideOneAnotherWhereThereIsRoom) {
  EXPECT_TRUE(relaxed(20));
  EXPECT_TRUE(relaxed(12.01));
}

TEST_F(RelaxedSquares, AreBackWhereTheyWereWithoutRoom) { EXPECT_FALSE(relaxed(11)); }

TEST(LatticeUnit, IsWhatAllCornersShare) {
  layout::Document document = whole_millimetres({l_shape(20), cases::box_loop(0, 0, 10, 16)}, 20);
  const auto unit_of = [](const layout::Document& d) {
    const Problem problem(d, {});
    return lattice_unit(problem, items_of(problem));
  };
  EXPECT_EQ(unit_of(document), 1);
  document.rules.gap = geom::grid_from_mm(0.5);
  EXPECT_EQ(unit_of(document), 0.5);
  document.rules.gap = geom::grid_from_mm(0.01);
  EXPECT_EQ(unit_of(document), 0);  // too many places
  document.rules.gap = 0;
  document.parts[0].rotations = {{10, 10}};
  EXPECT_EQ(unit_of(document), 0);
  document.parts.erase(document.parts.begin());
  EXPECT_EQ(unit_of(document), 0);  // 2 mm: too few places to speak of
}

/// A rectangle of 10 x 6 sawn to pieces closes without a gap.
TEST(Nest, PuzzlesClose) {
  const auto corner = cases::grid_point;
  const layout::Document document =
      whole_millimetres({{corner(0, 0), corner(5, 0), corner(5, 2), corner(2, 2), corner(2, 6), corner(0, 6)},
                         cases::box_loop(0, 0, 3, 4),
                         {corner(0, 0), corner(5, 0), corner(5, 3), corner(2, 3), corner(2, 6), corner(0, 6)},
                         cases::box_loop(0, 0, 3, 3)},
                        6);
  Options options;
  options.seed = 3;
  RunControl control;
  control.work_limit = 1'000'000;
  const auto found = nest(document, options, control);
  ASSERT_TRUE(found);
  EXPECT_TRUE(layout::check(found->document).empty());
  EXPECT_TRUE(found->unplaced.empty());
  const layout::Completeness done = layout::completeness(found->document);
  EXPECT_EQ(done.sheets[0].used_length_mm, 10);
}

}  // namespace
}  // namespace lekalo::nest::nest_separator_test
