#include "lekalo/nest/nest.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"
#include "nest/exact/builder.hpp"
#include "nest/exact/settle.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::nest::nest_test {
namespace {

layout::Document small_order(std::size_t index) {
  layout::Document document = cases::random_order(cases::seed(), index);
  for (layout::Part& part : document.parts) part.demand = 2;
  return document;
}

Nested nested(const layout::Document& document, unsigned threads, std::uint64_t work) {
  Options options;
  options.threads = threads;
  options.seed = 5;
  options.angles = 4;
  RunControl control;
  control.work_limit = work;
  auto result = nest(document, options, control);
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

TEST(Nest, EveryLayoutPassesTheCheckAndEveryPieceIsPlacedOrNamed) {
  for (std::size_t i = 0; i < cases::case_count(5); ++i) {
    const layout::Document document = small_order(i);
    const Nested found = nested(document, 1, 50'000);
    EXPECT_TRUE(layout::check(found.document).empty()) << "case " << i << " of seed " << cases::seed();
    std::vector<std::int64_t> count(document.parts.size(), 0);
    for (const layout::Placement& p : found.document.placements) ++count[p.part];
    for (const Unplaced& u : found.unplaced) count[u.part] += u.count;
    for (std::uint32_t p = 0; p < count.size(); ++p)
      EXPECT_EQ(count[p], layout::wanted(document, p)) << "case " << i << ", part " << p;
  }
}

TEST(Nest, TheSameBytesWhateverTheThreads) {
  for (std::size_t i = 0; i < cases::case_count(1); ++i) {
    const layout::Document document = small_order(20 + i);
    const Nested one = nested(document, 1, 500'000), two = nested(document, 2, 500'000);
    EXPECT_EQ(io::write_layout(one.document), io::write_layout(two.document)) << "case " << i;
    EXPECT_EQ(one.work, two.work);
    // The work that a run says it took repeats it.
    EXPECT_EQ(io::write_layout(nested(document, 2, one.work).document), io::write_layout(one.document));
  }
}

TEST(Nest, LockedPlacementsStay) {
  layout::Document document = cases::two_squares();
  document.parts[0].demand = 30;
  document.placements[0].locked = true;
  const Nested found = nested(document, 1, 100'000);
  ASSERT_FALSE(found.document.placements.empty());
  EXPECT_EQ(found.document.placements[0], document.placements[0]);
  EXPECT_EQ(found.document.placements.size(), std::size_t{30});
  EXPECT_TRUE(layout::check(found.document).empty());
}

TEST(Nest, KitsGetTheirLeftAndRightPieces) {
  layout::Document document = cases::two_squares();
  layout::Part& part = document.parts[0];  // an L, which mirrored is another one
  part.outline =
      cases::outline_of({{cases::grid_point(0, 0), cases::grid_point(10, 0), cases::grid_point(10, 3),
                          cases::grid_point(3, 3), cases::grid_point(3, 6), cases::grid_point(0, 6)}});
  part.may_mirror = true;
  part.demand = 1;
  document.kits = {{"pair", "", 4, 1, {{0, 1, false}, {0, 2, true}}}};
  document.placements.resize(1);
  document.placements[0].locked = true;  // one of the four upright ones
  const Nested found = nested(document, 1, 100'000);
  EXPECT_TRUE(found.unplaced.empty());
  const layout::Completeness done = layout::completeness(found.document);
  EXPECT_EQ(done.kits[0].complete, 4);
  EXPECT_EQ(done.surplus[0], 0);
  EXPECT_EQ(done.placed[0].total(), 13);
  EXPECT_GE(done.placed[0].mirrored, 8);
}

TEST(Nest, SquaresFillASheetToTheLast) {
  layout::Document document = cases::two_squares();
  document.placements.clear();
  document.stocks[0].outline = cases::outline_of({cases::box_loop(0, 0, 30, 20)});
  document.parts[0].demand = 6;
  document.parts[0].rotations = {{0, 0}};
  const Nested found = nested(document, 1, 400'000);
  EXPECT_TRUE(found.unplaced.empty());
  EXPECT_TRUE(layout::check(found.document).empty());
}

TEST(Nest, SaysWhyAPieceIsNotPlaced) {
  layout::Document document = cases::two_squares();
  document.placements.clear();
  document.parts[0].demand = 1;
  layout::Part large = document.parts[0];
  large.id = "large";
  large.outline = cases::outline_of({cases::box_loop(0, 0, 101, 10)});
  large.rotations = {{0, 0}, {90, 90}};
  layout::Part many = document.parts[0];
  many.id = "many";
  many.outline = cases::outline_of({cases::box_loop(0, 0, 60, 60)});
  many.demand = 2;
  many.rotations = {{0, 0}};
  layout::Part askew = document.parts[0];
  askew.id = "askew";
  askew.rotations = {{0, 0}};
  askew.grain = layout::Grain{45, 1};
  document.stocks[0].grain_degrees = 0;
  document.parts.insert(document.parts.end(), {large, many, askew});
  const Nested found = nested(document, 1, 100'000);
  const std::vector<Unplaced> expected = {
      {1, 1, Reason::too_large}, {2, 1, Reason::no_stock}, {3, 1, Reason::no_angle}};
  EXPECT_EQ(found.unplaced, expected);
}

TEST(Nest, RefusesWhatCannotBeNested) {
  layout::Document document = cases::two_squares();
  const RunControl control;
  Options from_scratch;
  from_scratch.from_given = false;
  EXPECT_FALSE(nest(document, from_scratch, control));  // nothing wanted
  document.parts[0].demand = 1;
  document.placements[1].at = document.placements[0].at;
  document.placements[0].locked = document.placements[1].locked = true;
  const auto overlapping = nest(document, {}, control);
  ASSERT_FALSE(overlapping);
  EXPECT_NE(overlapping.error().message.find("placement 1, which is to stay"), std::string::npos);
  document.placements.clear();
  document.stocks.clear();
  EXPECT_FALSE(nest(document, {}, control));
}

TEST(Nest, StopsWithTheBestSoFar) {
  const std::atomic<bool> stop{true};
  RunControl control;
  control.stop = &stop;
  layout::Document document = small_order(1);
  const auto found = nest(document, {}, control);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->merges, 1u);
  EXPECT_TRUE(layout::check(found->document).empty());
}

/// A place that the placer calls free is free by the exact check, whatever the rules.
TEST(Placer, WhatItPlacesBreaksNoRule) {
  std::size_t placed = 0;
  for (std::size_t index = 0; index < cases::case_count(30); ++index) {
    layout::Document document = cases::random_order(cases::seed(), index);
    for (layout::Part& part : document.parts) part.demand = 3;
    const Problem problem(document, {4, false, 64});
    Items items;
    for (std::uint32_t p = 0; p < document.parts.size(); ++p)
      for (int k = 0; k < 3; ++k) {
        if (problem.forms_of(p).first == problem.forms_of(p).last) continue;
        items.parts.push_back(p);
        items.forms.push_back(problem.forms_of(p));
      }
    if (items.movable() == 0) continue;
    Placer placer(problem, items, Random(index));
    const State state =
        built(problem, items, placer, empty_state(problem, items), by_size(problem, items), {});
    const Settled done = settled(problem, items, state);
    EXPECT_TRUE(done.is_whole) << "case " << index << " of seed " << cases::seed();
    placed += done.document.placements.size();
  }
  EXPECT_GT(placed, 0u);
}

}  // namespace
}  // namespace lekalo::nest::nest_test
