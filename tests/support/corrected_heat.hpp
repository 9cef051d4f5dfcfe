#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "lekalo/heat/material.hpp"
#include "lekalo/heat/stock.hpp"
#include "lekalo/jobs/heat_correction.hpp"

namespace lekalo::cases {

/// A pocket that a tool of 6 mm with 3 teeth mills dry into a block of aluminium, all figures of it in no
/// doubt.
inline jobs::HeatJob heat_job(std::string program, std::string pocket, const char* stock, double share,
                              double pitch) {
  using heat::Property;
  jobs::HeatJob job;
  job.source.program = {"part.ngc", std::move(program)};
  job.source.pocket = {"pocket.json", std::move(pocket)};
  job.source.machining.tool_diameter = 6;
  job.source.cutting.teeth = 3, job.source.cutting.spindle_rpm = 8000;
  job.source.stock.block = heat::read_stock(stock);
  heat::MaterialWords words{"6061-T6", {}};
  const auto state = [&](Property p, double value) {
    words.stated[static_cast<std::size_t>(p)] = heat::Interval{value, value};
  };
  state(Property::share, share);
  state(Property::cutting_force, 700);
  state(Property::force_exponent, 0.25);
  job.material = *heat::material_of(words);
  job.film = {20, 20};
  job.pitch = pitch;
  return job;
}

struct CorrectedHeat {
  jobs::HeatFound found;
  jobs::HeatCorrection correction;
};

inline CorrectedHeat corrected_heat(const jobs::HeatJob& job, const jobs::CorrectionWish& wish = {}) {
  Result<jobs::HeatFound> found = jobs::heat(job);
  if (!found) {
    ADD_FAILURE() << found.error().message;
    return {};
  }
  Result<jobs::HeatCorrection> correction = jobs::heat_correction(job, *found, wish);
  if (!correction) {
    ADD_FAILURE() << correction.error().message;
    return {};
  }
  return {std::move(*found), std::move(*correction)};
}

/// What every corrected program holds. The last round would have moved no pass on by more than a tenth of the
/// largest error: the iteration comes to rest.
inline void expect_better(const jobs::HeatFound& found, const jobs::HeatCorrection& made) {
  EXPECT_EQ(made.why_not, "");
  EXPECT_FALSE(made.program.empty());
  EXPECT_LE(made.after.largest(), 0.2 * found.errors.largest());
  EXPECT_LT(made.after.largest(), found.scaling.left.largest());
  EXPECT_LE(made.after_over.most.greatest, 1);
  EXPECT_LE(made.after_over.largest.greatest, found.largest_um.greatest);
  EXPECT_GE(made.rounds, 1);
  EXPECT_LE(made.rounds, 3);
  EXPECT_LE(made.still_um, 0.1 * found.errors.largest());
}

/// The largest error of the walls whose material lies outside of a circle about the origin, and of those
/// about which the pocket goes, um, with its sign.
struct OppositeWalls {
  double outer = 0, island = 0;
};
inline OppositeWalls opposite_walls(const jobs::HeatFound& found) {
  OppositeWalls walls;
  for (const jobs::WallPoint& w : found.walls) {
    double& side = w.x * w.outward[0] + w.y * w.outward[1] > 0 ? walls.outer : walls.island;
    side = std::abs(w.error_um) > std::abs(side) ? w.error_um : side;
  }
  return walls;
}

}  // namespace lekalo::cases
