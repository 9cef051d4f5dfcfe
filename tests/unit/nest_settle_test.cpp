#include "nest/exact/settle.hpp"

#include <gtest/gtest.h>

#include "lekalo/layout/check.hpp"
#include "nest/exact/builder.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::nest::nest_settle_test {
namespace {

/// Squares of 10, 8 and 10 mm on a sheet of 40 x 10.
class Squares : public testing::Test {
 protected:
  Squares() {
    document_.placements.clear();
    document_.stocks[0].outline = cases::outline_of({cases::box_loop(0, 0, 40, 10)});
    document_.parts.assign(3, document_.parts[0]);
    document_.parts[1].outline = cases::outline_of({cases::box_loop(0, 0, 8, 8)});
    for (std::size_t p = 0; p < 3; ++p) {
      document_.parts[p].id = "p" + std::to_string(p);
      document_.parts[p].rotations = {{0, 0}};
      document_.parts[p].demand = 1;
    }
    problem_.emplace(document_, SearchOptions{});
    for (std::uint32_t p = 0; p < 3; ++p) {
      items_.parts.push_back(p);
      items_.forms.push_back(problem_->forms_of(p));
    }
  }
  State lying_at(std::vector<double> x) const {
    State state = empty_state(*problem_, items_);
    for (std::size_t i = 0; i < 3; ++i) state.spots[i] = {x[i], 0, items_.forms[i].first, 0};
    state.open_bins = {0};
    return state;
  }
  std::vector<double> lefts(const Settled& settled) const {
    std::vector<double> x;
    for (const layout::Placement& p : settled.document.placements) x.push_back(geom::mm_from_grid(p.at.x));
    return x;
  }
  layout::Document document_ = cases::two_squares();
  std::optional<Problem> problem_;
  Items items_;
};

TEST_F(Squares, AreShiftedByWhatRoundingLeft) {
  const Settled done = settled(*problem_, items_, lying_at({-1e-7, 10 - 2e-7, 18 - 3e-7}));
  EXPECT_TRUE(done.is_whole);
  EXPECT_TRUE(layout::check(done.document).empty());
  EXPECT_EQ(done.document.placements.size(), 3u);
}

TEST_F(Squares, OnlyWhatBreaksARuleIsTakenOut) {
  document_.stocks[0].outline = cases::outline_of({cases::box_loop(0, 0, 18, 10)});
  problem_.emplace(document_, SearchOptions{});
  const Settled done = settled(*problem_, items_, lying_at({0, 10, 5}));
  EXPECT_FALSE(done.is_whole);
  EXPECT_TRUE(layout::check(done.document).empty());
  EXPECT_EQ(done.state.spots[2].bin, kNowhere) << "it overlaps both others, which fit beside one another";
  EXPECT_EQ(lefts(done), (std::vector<double>{0, 10}));
  const Settled first_one = settled(*problem_, items_, lying_at({8, 10, 0}));
  EXPECT_EQ(first_one.state.spots[0].bin, kNowhere);
  EXPECT_EQ(lefts(first_one), (std::vector<double>{10, 0}));
}

TEST_F(Squares, OfEqualsTheSmallerOneIsTakenOut) {
  document_.stocks[0].outline = cases::outline_of({cases::box_loop(0, 0, 20, 10)});
  problem_.emplace(document_, SearchOptions{});
  const Settled done = settled(*problem_, items_, lying_at({0, 2, 10}));
  EXPECT_EQ(done.state.spots[1].bin, kNowhere);
  EXPECT_EQ(lefts(done), (std::vector<double>{0, 10}));
}

TEST_F(Squares, TheRestFindsAnotherPlace) {
  const Settled done = settled(*problem_, items_, lying_at({0, 3, 11}));
  State rest = done.state;
  rest.spots[1].bin = kNowhere;  // as if it had been taken out
  Placer placer(*problem_, items_, Random(1));
  const State again = built(*problem_, items_, placer, rest, by_size(*problem_, items_), {});
  const Settled whole = settled(*problem_, items_, again);
  EXPECT_TRUE(whole.is_whole);
  EXPECT_EQ(whole.document.placements.size(), 3u);
  // Items that were settled already stay to the step.
  EXPECT_EQ(again.spots[0].x, rest.spots[0].x);
  EXPECT_EQ(again.spots[2].x, rest.spots[2].x);
}

}  // namespace
}  // namespace lekalo::nest::nest_settle_test
