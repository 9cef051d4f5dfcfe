#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/mill/relief.hpp"
#include "support/cases.hpp"
#include "support/judged_path.hpp"
#include "support/pockets.hpp"

// Shallower passes ahead of what is too hot, judged by the independent checker.

namespace lekalo::mill::mill_relief_test {
namespace {

using Kind = PathMove::Kind;

const std::string kRoom = pockets::document(pockets::outline({{0, 0}, {60, 0}, {60, 40}, {0, 40}}));

JudgedPath relieved(const PocketPath& path, const std::string& pocket) {
  JudgedPath now = judged(path, pocket);
  const auto regions = io::parse_regions(pocket, "pocket.json");
  auto relief = Relief::make(path, regions->regions, {});
  EXPECT_TRUE(relief);
  for (int round = 0;; ++round) {
    EXPECT_LT(round, 20);
    const bool goes_on = round < 20 && relief->improve(loads_of(now));
    now = judged(relief->path(), pocket);
    if (!goes_on) return now;
  }
}

/// Degrees above what a path of this step-over holds, times mm.
double excess(const verify::SimulateReport& report) {
  double sum = 0;
  for (const verify::EngagementSample& s : report.samples)
    if (!s.entry) sum += std::max(0.0, s.engagement - 98.08) * s.length;
  return sum;
}

/// A slot, and beside it a pass that takes 5 mm of its 6: the rim meets 132 degrees, on the left or the
/// right.
PocketPath wide_pass(double y, Kind second) {
  PocketPath path;
  path.moves = {{Kind::rapid, {10, 20}, 5}, {Kind::plunge, {10, 20}, -1}, {Kind::slot, {50, 20}, -1},
                {Kind::link, {10, 20}, -1}, {second, {10, y}, -1},        {second, {50, y}, -1}};
  return path;
}

TEST(MillRelief, APassTooFarFromTheOneBeforeIsCutInTwo) {
  for (const double y : {15.0, 25.0})
    for (const Kind kind : {Kind::cut, Kind::link}) {
      SCOPED_TRACE(fmt::format("y {} kind {}", y, static_cast<int>(kind)));
      const PocketPath given = wide_pass(y, kind);
      const JudgedPath before = judged(given, kRoom), after = relieved(given, kRoom);
      const auto hottest = [&](const JudgedPath& of) {
        double most = 0;
        for (const verify::EngagementSample& s : of.report.samples)
          if (std::abs(s.y - y) < 4 && s.x > 18 && s.x < 45) most = std::max(most, s.engagement);
        return most;
      };
      EXPECT_GT(hottest(before), 130);
      EXPECT_LE(hottest(after), 98.1);
      EXPECT_FALSE(same(after.path, given));
      EXPECT_EQ(after.report.gouge_mm, 0);
      EXPECT_EQ(after.report.retracts, 0U);
      EXPECT_GE(after.report.coverage_percent, before.report.coverage_percent);
    }
}

TEST(MillRelief, APathThatHoldsTheAngleStaysAsItIs) {
  const auto regions = io::parse_regions(kRoom, "pocket.json");
  const auto path = pocket_path(regions->regions, {});
  ASSERT_TRUE(path);
  EXPECT_TRUE(same(relieved(*path, kRoom).path, *path));
}

/// A groove: there is no side to come from, and nothing is tried beyond its walls.
TEST(MillRelief, WhereThereIsNoRoomBesideNothingIsChanged) {
  const std::string groove = pockets::document(pockets::outline({{0, 0}, {60, 0}, {60, 6.3}, {0, 6.3}}));
  PocketPath path;
  path.moves = {{Kind::rapid, {5, 3.15}, 5}, {Kind::plunge, {5, 3.15}, -1}, {Kind::cut, {55, 3.15}, -1}};
  const JudgedPath after = relieved(path, groove);
  EXPECT_TRUE(same(after.path, path));
  EXPECT_EQ(after.report.gouge_mm, 0);
}

/// There the move before has no length; its place along the path was once taken for one of the cut's.
TEST(MillRelief, AHotStretchAtTheVeryBeginningIsNoExit) {
  PocketPath path;
  path.moves = {{Kind::rapid, {10, 20}, 5}, {Kind::plunge, {10, 20}, -1}, {Kind::cut, {50, 20}, -1}};
  const JudgedPath after = relieved(path, kRoom);
  for (const PathMove& move : after.path.moves) EXPECT_TRUE(std::isfinite(move.to.x + move.to.y));
  EXPECT_EQ(after.report.gouge_mm, 0);
  EXPECT_EQ(after.report.retracts, 0U);
}

/// Of these two a chord of a pass once crossed a wall between two of its places, 0.04 mm into what stays.
TEST(MillRelief, AChordOfAPassAcrossAWallIsNotWritten) {
  for (const std::size_t i : {std::size_t{62}, std::size_t{73}}) {
    Random random(1, 700 + i);
    const std::string pocket = pockets::random_pocket(random, i, 12 + 20 * random.uniform());
    const auto regions = io::parse_regions(pocket, "pocket.json");
    const auto path = pocket_path(regions->regions, {});
    ASSERT_TRUE(path);
    const JudgedPath after = relieved(*path, pocket);
    EXPECT_FALSE(same(after.path, *path));
    EXPECT_LE(after.report.gouge_mm, 0.0025);
    EXPECT_LE(after.report.engagement_max_deg, 98.1);
  }
}

TEST(MillRelief, RandomPocketsGetNoHotterAndStayCleared) {
  double given = 0, left = 0;
  for (std::size_t i = 0; i < cases::case_count(3); ++i) {
    Random random(cases::seed(), 700 + i);
    const std::string pocket = pockets::random_pocket(random, i, 12 + 16 * random.uniform());
    SCOPED_TRACE(pocket);
    const auto regions = io::parse_regions(pocket, "pocket.json");
    ASSERT_TRUE(regions);
    if (geom::fault_of(regions->regions)) continue;
    const auto path = pocket_path(regions->regions, {});
    if (!path) continue;
    const JudgedPath before = judged(*path, pocket), after = relieved(*path, pocket);
    EXPECT_LE(excess(after.report), excess(before.report) + 0.05);
    EXPECT_GE(after.report.coverage_percent, 99.99);
    EXPECT_LE(after.report.uncut_width_mm, 0.02);
    EXPECT_LE(after.report.gouge_mm, 0.0045);
    EXPECT_EQ(after.report.rapid_cut_mm, 0);
    EXPECT_EQ(after.report.retracts, before.report.retracts);
    given += excess(before.report), left += excess(after.report);
  }
  EXPECT_LE(left, given);
}

}  // namespace
}  // namespace lekalo::mill::mill_relief_test
