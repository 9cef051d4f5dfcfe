#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/mill/pocket.hpp"
#include "lekalo/mill/ramps.hpp"
#include "support/cases.hpp"
#include "support/judged_path.hpp"
#include "support/pockets.hpp"

// Ramps where the path would meet too much at one depth, judged by the independent checker.

namespace lekalo::mill::mill_ramps_test {
namespace {

using Kind = PathMove::Kind;

constexpr double kHeld = 98.1;  // 1.25 straight passes of 40 %

/// 6.3 mm wide, into a room.
const std::string kGroove = pockets::document(
    pockets::outline({{0, 0}, {30, 0}, {30, -10}, {50, -10}, {50, 16.3}, {30, 16.3}, {30, 6.3}, {0, 6.3}}));

/// Straight down in the room, and along the groove to its end, at each of these depths.
PocketPath through_the_groove(const std::vector<double>& depths) {
  PocketPath path;
  path.moves.push_back({.kind = Kind::rapid, .to = {40, 3.15}, .z = 5});
  for (const double z : depths) {
    path.moves.push_back({.kind = Kind::plunge, .to = {40, 3.15}, .z = z});
    for (const double x : {36.0, 21.0, 18.5, 3.15})
      path.moves.push_back({.kind = Kind::cut, .to = {x, 3.15}, .z = z});
    path.moves.push_back({.kind = Kind::link, .to = {40, 3.15}, .z = z});
  }
  return path;
}

TEST(MillRamps, AGrooveIsCutInThinLayersDownToEachFloor) {
  for (const double angle : {0.02, 0.05, 0.2})
    for (const std::vector<double>& depths : {std::vector{-1.0}, std::vector{-1.5, -3.0, -4.5}}) {
      SCOPED_TRACE(fmt::format("ramp angle {} to {}", angle, depths.back()));
      PocketOptions options;
      options.ramp_angle = angle;
      options.depth = -depths.back();
      options.step_down = -depths.front();
      const JudgedPath before = judged(through_the_groove(depths), kGroove);
      EXPECT_GT(before.report.engagement_max_deg, 170);
      const RampedPath ramped = with_ramps(before.path, loads_of(before), options);
      const JudgedPath after = judged(ramped.path, kGroove);
      EXPECT_LE(after.report.engagement_max_deg, 1);
      EXPECT_LE(after.report.entry_layer_mm, std::min({12 * std::tan(angle), 0.6, -depths.front()}) + 0.11);
      EXPECT_EQ(after.report.gouge_mm, before.report.gouge_mm);
      EXPECT_EQ(after.report.retracts, before.report.retracts);
      EXPECT_EQ(after.report.rapid_cut_mm, 0);
      EXPECT_NEAR(after.report.coverage_percent, before.report.coverage_percent, 1e-9);
      for (std::size_t i = 1; i < ramped.path.moves.size(); ++i) {
        const PathMove &from = ramped.path.moves[i - 1], &to = ramped.path.moves[i];
        if (to.kind == Kind::entry) {
          EXPECT_LE(from.z - to.z, (std::tan(angle) + 1e-9) * norm(to.to - from.to));
        }
      }
      ASSERT_EQ(ramped.ramps.size(), depths.size());
      for (std::size_t i = 0; i < depths.size(); ++i) {
        EXPECT_EQ(ramped.ramps[i].z, depths[i]);
        EXPECT_NEAR(ramped.ramps[i].length, 36.85 + 3, 0.1);  // and a radius of the way back
        EXPECT_NEAR(ramped.ramps[i].engagement_deg, 180, 0.1);
      }
    }
}

TEST(MillRamps, APathThatHoldsTheAngleStaysAsItIs) {
  const std::string room = pockets::document(pockets::outline({{0, 0}, {60, 0}, {60, 40}, {0, 40}}));
  const auto regions = io::parse_regions(room, "pocket.json");
  const auto path = pocket_path(regions->regions, {});
  ASSERT_TRUE(path);
  const RampedPath ramped = with_ramps(*path, loads_of(judged(*path, room)), {});
  EXPECT_TRUE(ramped.ramps.empty());
  EXPECT_TRUE(same(ramped.path, *path));
}

TEST(MillRamps, WhatLastsTooShortOrIsNotTooMuchTakesNone) {
  const PocketPath path = through_the_groove({-1});
  const auto ramps_of = [&](double degrees, double length) {
    std::vector<std::vector<MoveLoad>> loads(path.moves.size());
    loads[3] = {{6, 50, 50}, {length / 2, degrees, 0}, {length / 2, degrees, degrees}, {6, 50, 50}};
    return with_ramps(path, loads, {}).ramps.size();
  };
  EXPECT_EQ(ramps_of(kHeld + 0.5, 0.2), 1U);
  EXPECT_EQ(ramps_of(kHeld - 0.5, 2), 0U);
  EXPECT_EQ(ramps_of(180, 0.1), 0U);
}

/// Whatever is said to be hot, the pocket gets no hotter, is cleared as before, and no more than before.
TEST(MillRamps, RandomRampsCutWhatThePathCuts) {
  for (std::size_t i = 0; i < cases::case_count(6); ++i) {
    Random random(cases::seed(), 1700 + i);
    const std::string pocket = pockets::random_pocket(random, i, 12 + 8 * random.uniform());
    SCOPED_TRACE(pocket);
    const auto regions = io::parse_regions(pocket, "pocket.json");
    ASSERT_TRUE(regions);
    if (geom::fault_of(regions->regions)) continue;
    PocketOptions options;
    options.depth = 1 + 4 * random.uniform();
    options.step_down = 1 + 2 * random.uniform();
    options.ramp_angle = 0.01 + 0.1 * random.uniform();
    const auto path = pocket_path(regions->regions, options);
    if (!path) continue;
    const JudgedPath before = judged(*path, pocket);
    auto loads = loads_of(before);
    for (auto& of_move : loads)
      for (MoveLoad& load : of_move)
        load.engagement_deg = random.uniform() < 0.01 ? 180 * random.uniform() : load.engagement_deg;
    for (int k = 0; k < 5; ++k)
      for (MoveLoad& load : loads[random.below(loads.size())]) load.engagement_deg = 120;
    const RampedPath ramped = with_ramps(*path, loads, options);
    const JudgedPath after = judged(ramped.path, pocket);
    EXPECT_LE(after.report.engagement_max_deg, before.report.engagement_max_deg + 0.5);
    // The path in plan is the same, but a ramp divides the moves it begins and ends in, and each part is
    // written within 0.001 mm of the path (docs/design/pocket-program.md).
    EXPECT_LE(after.report.gouge_mm, before.report.gouge_mm + 1e-3);
    EXPECT_NEAR(after.report.coverage_percent, before.report.coverage_percent, 1e-3);
    EXPECT_EQ(after.report.rapid_cut_mm, 0);
    EXPECT_EQ(after.report.retracts, before.report.retracts);
    EXPECT_LE(after.report.entry_layer_mm, std::max(before.report.entry_layer_mm,
                                                    std::min(12 * std::tan(options.ramp_angle), 0.6) + 0.12) +
                                               0.1);
  }
}

}  // namespace
}  // namespace lekalo::mill::mill_ramps_test
