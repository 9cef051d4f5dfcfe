// How strands, schedules and moves work together, and a move that is made outside of src/nest.

#include <gtest/gtest.h>

#include "extending/move/src/nest/moves/one_millimetre_less.hpp"
#include "lekalo/layout/check.hpp"
#include "nest/exact/builder.hpp"
#include "nest/exact/settle.hpp"
#include "nest/strand/strand.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::nest::nest_moves_test {
namespace {

/// Four squares of 10 mm, far apart on a strip 10 mm high.
class Row : public testing::Test {
 protected:
  Row() {
    document_.placements.clear();
    document_.stocks[0].kind = layout::StockKind::strip;
    document_.stocks[0].outline = cases::outline_of({cases::box_loop(0, 0, 200, 10)});
    document_.parts.resize(1);
    document_.parts[0].outline = cases::outline_of({cases::box_loop(0, 0, 10, 10)});
    document_.parts[0].rotations = {{0, 0}};
    document_.parts[0].demand = 4;
    problem_.emplace(document_, SearchOptions{});
    items_.parts.assign(4, 0);
    items_.forms.assign(4, problem_->forms_of(0));
    state_ = empty_state(*problem_, items_);
    for (std::size_t i = 0; i < 4; ++i) state_.spots[i] = {25.5 * static_cast<double>(i), 0, 0, kStrip};
    state_.open_bins = {kStrip};
  }
  layout::Document document_ = cases::two_squares();
  std::optional<Problem> problem_;
  Items items_;
  State state_;
};

TEST_F(Row, AMoveOfAStrangerShortensTheStrip) {
  Schedule schedule;
  schedule.add(std::make_unique<OneMillimetreLess>());
  Strand strand(*problem_, items_, Random(1), std::move(schedule));
  strand.start(state_);
  EXPECT_EQ(strand.merit().reach, 86.5);
  strand.run(200'000);
  EXPECT_TRUE(strand.is_done());
  EXPECT_LT(strand.merit().reach, 60);
  EXPECT_GE(strand.merit().reach, 40 - 1e-3);
  const Settled done = settled(*problem_, items_, strand.best());
  EXPECT_TRUE(done.is_whole);
  EXPECT_TRUE(layout::check(done.document).empty());
}

TEST_F(Row, AMoveIsAddedToTheUsualSchedule) {
  Schedule schedule = strip_schedule(0);
  schedule.add(std::make_unique<OneMillimetreLess>());
  Strand strand(*problem_, items_, Random(1), std::move(schedule));
  strand.start(state_);
  strand.run(200'000);
  EXPECT_NEAR(strand.merit().reach, 40, 1e-3);
}

TEST_F(Row, TheSameChanceGivesTheSameState) {
  Strand one(*problem_, items_, 7, 0), two(*problem_, items_, 7, 0);
  for (Strand* strand : {&one, &two}) {
    strand->start(state_);
    strand->run(5'000);
  }
  EXPECT_EQ(one.work(), two.work());
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(one.best().spots[i].x, two.best().spots[i].x);
}

TEST_F(Row, AStripTakesABetterStateWhenItsAttemptHasFailed) {
  Schedule schedule;
  schedule.add(std::make_unique<OneMillimetreLess>());
  Strand strand(*problem_, items_, Random(1), std::move(schedule));
  strand.start(state_);
  State better = state_;
  for (std::size_t i = 0; i < 4; ++i) better.spots[i].x = 10.0 * static_cast<double>(i);
  strand.start(better);
  EXPECT_EQ(strand.merit().reach, 86.5);
  strand.run(200'000);
  EXPECT_EQ(strand.merit().reach, 40);
}

/// Wants so many turns, each over at once, and writes its name.
class Named final : public Move {
 public:
  Named(char name, int turns, std::string& log) : name_(name), turns_(turns), log_(log) {}
  bool begin(Search&) override {
    if (turns_-- <= 0) return false;
    log_ += name_;
    return true;
  }
  Outcome attempt(Search&) override { return Outcome::over; }
  Outcome step(Search&) override { return Outcome::over; }
  Outcome on_valid(Search&) override { return Outcome::over; }
  Outcome on_failure(Search&) override { return Outcome::over; }

 private:
  char name_;
  int turns_;
  std::string& log_;
};

TEST_F(Row, TheFirstMoveThatWantsATurnHasIt) {
  std::string log;
  Schedule schedule;
  schedule.add(std::make_unique<Named>('a', 2, log));
  schedule.add(std::make_unique<Named>('b', 3, log));
  Strand strand(*problem_, items_, Random(1), std::move(schedule));
  strand.start(state_);
  EXPECT_EQ(log, "aabbb");
  EXPECT_TRUE(strand.is_done());
}

TEST_F(Row, AConditionSaysAfterWhichTurnAMoveComes) {
  std::string log;
  Schedule schedule;
  auto other = std::make_unique<Named>('o', 3, log);
  schedule.add(std::make_unique<Named>('c', 9, log),
               [&other = *other](const Move* last) { return last == &other; });
  schedule.add(std::move(other));
  Strand strand(*problem_, items_, Random(1), std::move(schedule));
  strand.start(state_);
  EXPECT_EQ(log, "ocococ");
}

TEST_F(Row, AttemptsThatAreAlwaysInVainEndAStrand) {
  class Vain final : public Move {
   public:
    bool begin(Search&) override { return true; }
    Outcome attempt(Search&) override { return Outcome::failed; }
    Outcome step(Search&) override { return Outcome::failed; }
    Outcome on_valid(Search&) override { return Outcome::failed; }
    Outcome on_failure(Search&) override { return Outcome::under_way; }
  };
  Schedule schedule;
  schedule.add(std::make_unique<Vain>());
  Strand strand(*problem_, items_, Random(1), std::move(schedule));
  strand.start(state_);
  EXPECT_TRUE(strand.is_done());
}

/// Returns the size of the box that holds four squares of 10 mm on a sheet 40 mm wide and 60 mm high.
geom::Point box_of_four_squares(Remnant remnant) {
  layout::Document document = cases::two_squares();
  document.placements.clear();
  document.stocks[0].outline = cases::outline_of({cases::box_loop(0, 0, 40, 60)});
  document.parts.resize(1);
  document.parts[0].outline = cases::outline_of({cases::box_loop(0, 0, 10, 10)});
  document.parts[0].rotations = {{0, 0}};
  document.parts[0].demand = 4;
  Options options;
  options.remnant = remnant;
  RunControl control;
  control.work_limit = 400'000;
  const auto nested = nest(document, options, control);
  EXPECT_TRUE(nested && nested->unplaced.empty());
  geom::Point reach;
  for (const layout::Placement& p : nested->document.placements) {
    const geom::GridBox box = geom::bounds(placed_outline(document.parts[0], p));
    reach.x = std::max(reach.x, geom::mm_from_grid(box.high.x));
    reach.y = std::max(reach.y, geom::mm_from_grid(box.high.y));
  }
  return reach;
}

TEST(Remnant, OneCutAlongTheSideThatLeavesMoreFreesARectangle) {
  EXPECT_NEAR(box_of_four_squares(Remnant::rectangle).y, 10, 0.01);  // in a row, which leaves 40 x 50
}

TEST(Remnant, AStripIsAsHighAsTheSheet) {
  EXPECT_NEAR(box_of_four_squares(Remnant::strip).x, 10, 0.01);  // in a column, which leaves 30 x 60
}

TEST(Remnant, ACornerLeavesAllBeyondTheSmallestBox) {
  const geom::Point box = box_of_four_squares(Remnant::corner);
  EXPECT_NEAR(box.x * box.y, 400, 1);
}

}  // namespace
}  // namespace lekalo::nest::nest_moves_test
