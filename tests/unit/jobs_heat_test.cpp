#include "lekalo/jobs/heat.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace lekalo::jobs::jobs_heat_test {
namespace {

const std::string kPocket =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[20,0]}},{"line":{"from":[20,0],"to":[20,16]}},)"
    R"({"line":{"from":[20,16],"to":[0,16]}},{"line":{"from":[0,16],"to":[0,0]}}]})";

/// Clears the pocket but for 0.2 mm, waits, and takes that off the walls.
std::string program(const std::string& wait) {
  return "G21 G90 G17\nG0 X3.2 Y3.2 Z5\nG1 Z-4 F200\nG1 X16.8 F600\nG1 Y12.8\nG1 X3.2\nG1 Y3.2\nG1 Y8\nG1 "
         "X16.8\n" +
         wait + "G1 X17 Y8\nG1 Y13\nG1 X3\nG1 Y3\nG1 X17\nG1 Y8\nG0 Z5\n";
}

heat::Material material(double share_least, double share_greatest, const char* name = "6061-T6") {
  heat::MaterialWords words{name, {}};
  const auto state = [&](heat::Property p, heat::Interval value) {
    words.stated[static_cast<std::size_t>(p)] = value;
  };
  state(heat::Property::share, {share_least, share_greatest});
  if (std::string(name) == "PMMA") {
    state(heat::Property::cutting_force, {200, 200});
    state(heat::Property::force_exponent, {0.2, 0.2});
    state(heat::Property::poisson, {0.37, 0.37});
  }
  return *heat::material_of(words);
}

HeatJob job_of(const std::string& wait = "") {
  HeatJob job;
  job.source.program = {"part.ngc", program(wait)};
  job.source.pocket = {"pocket.json", kPocket};
  job.source.machining.tool_diameter = 6;
  job.source.cutting.teeth = 3, job.source.cutting.spindle_rpm = 8000;
  job.source.stock.block = heat::read_stock("40x36x10");
  job.material = material(0.1, 0.1);
  job.film = {20, 20};
  job.pitch = 2.5;
  return job;
}

HeatFound run(const HeatJob& job) {
  Result<HeatFound> found = heat(job);
  if (!found) {
    ADD_FAILURE() << found.error().message;
    return {};
  }
  return std::move(*found);
}

/// That of job_of(), on two threads.
const HeatFound& usual() {
  static const HeatFound found = run(job_of());
  return found;
}

TEST(JobsHeat, AfterALongWaitOnlyPlainGrowthIsLeft) {
  HeatJob job = job_of("G4 P120\n");
  job.film = {0, 0};
  const HeatFound found = run(job);
  // What is stored then is spread over the whole block; the last pass adds a little.
  const double capacity = 2700 * 896e-9 * (40 * 36 * 10 - 20 * 16 * 4), warm = found.book.stored / capacity;
  EXPECT_GT(warm, 0.3);
  EXPECT_NEAR(found.scaling.factor - 1, 23.6e-6 * warm, 0.1 * 23.6e-6 * warm);
  const double growth = 23.6e-6 * warm * 10 * 1000;
  for (const WallPoint& w : found.walls) {
    const double along = (w.x - 10) * w.outward[0] + (w.y - 8) * w.outward[1];
    EXPECT_NEAR(w.error_um, -23.6e-6 * warm * along * 1000, 0.15 * growth) << w.x << " " << w.y << " " << w.z;
  }
  EXPECT_LT(std::max(std::abs(found.scaling.left.least), found.scaling.left.most), 0.15 * growth);
}

TEST(JobsHeat, WallsOfMoreThanAMillionPlacesAreRefused) {
  HeatJob job = job_of();
  job.source.pocket.bytes =
      R"({"units": "mm", "outer": [{"line": {"from": [0, 0], "to": [4e5, 0]}},
    {"line": {"from": [4e5, 0], "to": [4e5, 4e5]}}, {"line": {"from": [4e5, 4e5], "to": [0, 4e5]}},
    {"line": {"from": [0, 4e5], "to": [0, 0]}}]})";
  job.source.stock.block = heat::read_stock("40x36x10@-10,-10");
  const Result<HeatFound> found = heat(job);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().message,
            "pocket.json: its walls have more than 1000000 places 2.5 mm apart; choose larger voxels");
}

TEST(JobsHeat, AWarmPocketIsTooSmallWhenItIsCold) {
  const HeatFound& found = usual();
  EXPECT_LT(found.errors.mean, 0);
  EXPECT_LE(found.errors.least, found.errors.mean);
  EXPECT_LE(found.errors.mean, found.errors.most);
  EXPECT_GT(found.scaling.factor, 1);
  EXPECT_GT(found.warmest_k.least, 0);
  // 8, 7, 8 and 7 places on two heights, of which the tool gets to none a millimetre from a corner.
  EXPECT_EQ(found.walls.size(), 44U);
  EXPECT_EQ(found.uncut, 16U);
  for (const WallPoint& w : found.walls) EXPECT_GT(w.seconds, 6);
}

TEST(JobsHeat, ThePassThatGoesDeepestIntoTheColdPartDecides) {
  // Two levels. The pocket grows, so that the second does not reach the upper wall again.
  HeatJob job = job_of();
  std::string& program = job.source.program.bytes;
  program = "G21 G90 G17\n";
  for (const char* z : {"-2", "-4"})
    program += std::string("G0 X3 Y3 Z5\nG1 Z") + z +
               " F200\nG1 X17 F600\nG1 Y13\nG1 X3\nG1 Y3\nG1 Y8\nG1 X17\nG0 Z5\n";
  const HeatFound found = run(job);
  double upper = 0, lower = 1e9;
  for (const WallPoint& w : found.walls) {
    if (w.z > -2) upper = std::max(upper, w.seconds);
    if (w.z < -2) lower = std::min(lower, w.seconds);
  }
  EXPECT_LT(upper, found.source.work.seconds / 2);
  EXPECT_GT(lower, found.source.work.seconds / 2);
}

// With heights that divided the whole wall at once, voxels of 3 mm put the only one on the border of the
// levels, and the colder pass above told how far off the wall was: half of what other voxels said.
TEST(JobsHeat, LevelsAndNotVoxelsSayWhichPassCutsAWall) {
  HeatJob job = job_of();
  std::string levels = "G21 G90 G17\n";
  for (const char* depth : {"2", "4"})
    levels += std::string("G0 X6 Y6 Z5\nG1 Z-") + depth +
              " F200\nG1 X14 F600\nG1 Y10\nG1 X6\nG1 Y6\nG1 X3 Y3\nG1 X17\nG1 Y13\nG1 X3\nG1 Y3\nG0 Z5\n";
  job.source.program.bytes = levels;
  double fine = 0;
  for (const double pitch : {2.0, 3.0, 4.0}) {
    job.pitch = pitch;
    const HeatFound found = run(job);
    for (const WallPoint& w : found.walls) EXPECT_TRUE(w.z == -1 || w.z == -3) << pitch << ' ' << w.z;
    if (pitch == 2) fine = found.errors.largest();
    EXPECT_NEAR(found.errors.largest(), fine, 0.15 * fine) << pitch;
  }
  EXPECT_GT(fine, 1);
}

TEST(JobsHeat, HeatIsBooked) {
  const HeatFound& found = usual();
  const double into = found.source.work.work_j.middle() * 0.1;
  EXPECT_NEAR(found.book.in + found.not_placed_j, into, 1e-9 * into);
  EXPECT_LT(found.not_placed_j, 0.02 * into);
  EXPECT_LT(found.book.balance(), 1e-3);
  EXPECT_GT(found.book.removed, 0);
  EXPECT_GT(found.book.lost, 0);
}

TEST(JobsHeat, WithoutAShareNothingMoves) {
  HeatJob job = job_of();
  job.material = material(0, 0);
  const HeatFound found = run(job);
  for (const WallPoint& w : found.walls) {
    EXPECT_EQ(w.error_um, 0);
    EXPECT_EQ(w.errors_um, (heat::Interval{0, 0}));
  }
  EXPECT_EQ(found.scaling.factor, 1);
  EXPECT_EQ(found.largest_um, (heat::Interval{0, 0}));
}

TEST(JobsHeat, ErrorsAreInProportionToTheShareAndTheIntervalsHoldThem) {
  HeatJob job = job_of();
  const HeatFound& once = usual();
  job.material = material(0.05, 0.15);
  const HeatFound wide = run(job);
  ASSERT_EQ(once.walls.size(), wide.walls.size());
  const heat::Interval work = once.source.work.work_j;
  for (std::size_t i = 0; i < once.walls.size(); ++i) {
    const WallPoint &a = once.walls[i], &b = wide.walls[i];
    EXPECT_NEAR(a.error_um, b.error_um, 1e-12);
    EXPECT_LE(b.errors_um.least, a.errors_um.least + 1e-12);
    EXPECT_GE(b.errors_um.greatest, a.errors_um.greatest - 1e-12);
    const double most = 1.5 * work.greatest / work.middle() * a.error_um;
    EXPECT_NEAR(a.error_um < 0 ? b.errors_um.least : b.errors_um.greatest, most,
                1e-9 + 1e-9 * std::abs(most));
  }
}

TEST(JobsHeat, WaitingPaysWithFloodAndAnIntervalOfFilmsHoldsTheErrorsOfItsEnds) {
  HeatJob job = job_of("G4 P40\n");
  job.film = {10, 2000};
  const HeatFound wide = run(job);
  job.film = {10, 10};
  const HeatFound dry = run(job);
  job.film = {2000, 2000};
  const HeatFound flood = run(job);
  EXPECT_LT(flood.largest_um.greatest, 0.7 * dry.largest_um.greatest);
  for (const HeatFound* one : {&dry, &flood})
    for (std::size_t i = 0; i < one->walls.size(); ++i) {
      EXPECT_LE(wide.walls[i].errors_um.least, one->walls[i].error_um + 1e-9);
      EXPECT_GE(wide.walls[i].errors_um.greatest, one->walls[i].error_um - 1e-9);
    }
}

TEST(JobsHeat, ThreadsChangeNothing) {
  HeatJob job = job_of();
  job.threads = 1, job.record = true;
  const HeatFound one = run(job);
  const HeatFound& two = usual();
  for (std::size_t i = 0; i < one.walls.size(); ++i) EXPECT_EQ(one.walls[i].error_um, two.walls[i].error_um);
  EXPECT_EQ(one.work, two.work) << "nor does a record";
  job.threads = 2;
  const HeatFound recorded = run(job);
  EXPECT_EQ(one.record->warmest_k, recorded.record->warmest_k);
  EXPECT_EQ(one.record->stress_mpa, recorded.record->stress_mpa);
  EXPECT_EQ(one.record->frames.back().from_above, recorded.record->frames.back().from_above);
}

TEST(JobsHeat, ARecordHoldsTheExtremesOfTheResult) {
  HeatJob job = job_of("G4 P20\n");
  job.record = true;
  const HeatFound found = run(job);
  ASSERT_TRUE(found.record);
  const HeatRecord& r = *found.record;
  EXPECT_NEAR(*std::ranges::max_element(r.warmest_k), found.middle().warmest_k,
              1e-6 * found.middle().warmest_k);
  EXPECT_NEAR(*std::ranges::max_element(r.stress_mpa), found.middle().stress_mpa,
              1e-6 * found.middle().stress_mpa);
  EXPECT_LE(r.frames.size(), kMostHeatFrames + 1);
  EXPECT_NEAR(r.frames.back().seconds, found.source.work.seconds, 1e-9);
  // The last moment is the end, seen from above and from the front.
  const float end = *std::ranges::max_element(r.at_end_k);
  EXPECT_EQ(*std::ranges::max_element(r.frames.back().from_above), end);
  EXPECT_EQ(*std::ranges::max_element(r.frames.back().from_front), end);
  // What is cut away has no temperature, and the floor below is seen in its place.
  const auto at = found.grid.voxel_of({10, 8, -1});
  EXPECT_LT(r.at_end_k[found.grid.cell(at[0], at[1], at[2])], 0);
  EXPECT_GE(r.frames.back().from_above[at[1] * r.count[0] + at[0]], 0);
  // A free block that is warm has grown: its sides lie farther from each other.
  EXPECT_GT(r.moved[found.grid.count[0]].x - r.moved[0].x, 0);
  ASSERT_EQ(r.moved.size(), (found.grid.count[0] + 1) * (found.grid.count[1] + 1));
}

/// A temperature of the model itself at this place and time, of a job whose share is 0.1.
MeasuredTemperature from_model(HeatJob job, heat::Place at, double seconds, double uncertainty_k) {
  job.measured = {{job.ambient_c, at, seconds, 1000}};
  const HeatFound found = run(job);
  return {job.ambient_c + 0.1 * found.cases[0].rises_k[0], at, seconds, uncertainty_k};
}

TEST(JobsHeat, AMeasuredTemperatureFindsTheShareThatMadeIt) {
  HeatJob job = job_of();
  // The force is known, so that the share alone is in doubt.
  job.material.values[static_cast<std::size_t>(heat::Property::cutting_force)] = {400, 400};
  job.material.values[static_cast<std::size_t>(heat::Property::force_exponent)] = {0.25, 0.25};
  const HeatFound truth = run(job);
  const MeasuredTemperature m = from_model(job, {10, 8, -6}, 12, 0.05);
  ASSERT_GT(m.celsius, 20.3);
  job.material.values[static_cast<std::size_t>(heat::Property::share)] = {0.01, 0.9};
  job.measured = {m};
  const HeatFound found = run(job);
  const double part = 0.05 / (m.celsius - 20);
  EXPECT_NEAR(found.share.least, (1 - part) * 0.1, 1e-9);
  EXPECT_NEAR(found.share.greatest, (1 + part) * 0.1, 1e-9);
  EXPECT_NEAR(found.heat_parts.least, 1 - part, 1e-9);
  EXPECT_NEAR(found.heat_parts.greatest, 1 + part, 1e-9);
  // The errors at the middles are those of the share that was true.
  for (std::size_t i = 0; i < found.walls.size(); ++i)
    EXPECT_NEAR(found.walls[i].error_um, truth.walls[i].error_um, 1e-6);
  EXPECT_NEAR(found.sensitivity.share.least, (1 - part) * found.errors.largest(), 1e-9);
}

TEST(JobsHeat, AMeasuredTemperatureNarrowsTheHeatThoughTheForceIsInDoubt) {
  HeatJob job = job_of();
  job.film = {5, 50};
  job.material = material(0.05, 0.2);
  const HeatFound wide = run(job);
  job.measured = {from_model(job_of(), {10, 8, -6}, 12, 0.1), from_model(job_of(), {3, 20, -5}, 11, 0.1)};
  const HeatFound found = run(job);
  const double heat = 0.1 * found.source.work.work_j.middle();
  EXPECT_LE(found.heat_j.least, heat);
  EXPECT_GE(found.heat_j.greatest, heat);
  EXPECT_LE(found.share.least, 0.1);
  EXPECT_GE(found.share.greatest, 0.1);
  const auto width = [](const heat::Interval& i) { return i.greatest - i.least; };
  EXPECT_LT(width(found.largest_um), 0.5 * width(wide.largest_um));
  for (std::size_t i = 0; i < found.walls.size(); ++i) {
    EXPECT_LE(found.walls[i].errors_um.least, usual().walls[i].error_um + 1e-9);
    EXPECT_GE(found.walls[i].errors_um.greatest, usual().walls[i].error_um - 1e-9);
  }
}

TEST(JobsHeat, MeasurementsThatCannotBeAreToldInOneSentence) {
  const auto said = [](std::vector<MeasuredTemperature> measured) {
    HeatJob job = job_of();
    job.material = material(0.05, 0.2);
    job.measured = std::move(measured);
    const Result<HeatFound> found = heat(job);
    return found ? std::string() : found.error().message;
  };
  EXPECT_NE(said({{25, {10, 8, -6}, 1000, 2.5}}).find("state the time from its start"), std::string::npos);
  EXPECT_NE(said({{25, {31, 8, -6}, 10, 2.5}}).find("the place is outside of the stock"), std::string::npos);
  EXPECT_NE(said({{25, {10, 8, 1}, 10, 2.5}}).find("the place is outside of the stock"), std::string::npos);
  EXPECT_NE(said({{25, {10, 3.2, -2}, 10, 2.5}}).find("the place is in the air"), std::string::npos);
  EXPECT_NE(said({{25, {10, 8, -6}, 0, 2.5}}).find("no heat of the program has come there"),
            std::string::npos);
  EXPECT_NE(said({{60, {10, 8, -6}, 12, 2.5}}).find("by what is stated"), std::string::npos);
  const MeasuredTemperature a = from_model(job_of(), {10, 8, -6}, 12, 0.02);
  MeasuredTemperature b = a;
  b.celsius += 0.1;
  EXPECT_NE(said({a, b}).find("leave out the one that is wrong"), std::string::npos) << said({a, b});
  // A place on the floor, on a wall and on the stock's side still stands.
  EXPECT_EQ(said({{21, {10, 8, -4}, 12, 20}, {21, {10, 0, -2}, 12, 20}, {21, {30, 8, -2}, 12, 20}}), "");
}

TEST(JobsHeat, ADatumThatDoesNotStandIsToldInOneSentence) {
  const auto said = [](heat::Place datum) {
    HeatJob job = job_of();
    job.holding.datum = datum;
    const Result<HeatFound> found = heat(job);
    return found ? std::string() : found.error().message;
  };
  EXPECT_EQ(
      said({31, 8, -6}),
      "the datum X 31 Y 8 Z -6: the place is outside of the stock, which goes from X -10 Y -10 Z -10 to X "
      "30 Y 26 Z 0; state it in the program's coordinates, mm");
  EXPECT_NE(said({10, 8, 0.1}).find("the place is outside of the stock"), std::string::npos);
  // The program takes it away in the end, so that nothing would be there to lie still.
  EXPECT_NE(said({10, 3.2, -2}).find("the datum X 10 Y 3.2 Z -2: the place is in the air"),
            std::string::npos);
  EXPECT_EQ(said({30, 26, -10}), "");
}

TEST(JobsHeat, AnOutlineOfABlockIsTheBlock) {
  HeatJob job = job_of();
  job.source.stock.block.reset();
  job.source.stock.outline = File{
      "blank.json",
      R"({"units":"mm","outer":[{"line":{"from":[-10,-10],"to":[30,-10]}},{"line":{"from":[30,-10],"to":[30,26]}},)"
      R"({"line":{"from":[30,26],"to":[-10,26]}},{"line":{"from":[-10,26],"to":[-10,-10]}}]})"};
  job.source.stock.thickness = 10;
  const HeatFound found = run(job);
  ASSERT_EQ(found.walls.size(), usual().walls.size());
  for (std::size_t i = 0; i < found.walls.size(); ++i)
    // Displacements are solved to a part of the load alone.
    EXPECT_NEAR(found.walls[i].error_um, usual().walls[i].error_um, 1e-2 * found.errors.largest());
  EXPECT_NEAR(found.book.lost, usual().book.lost, 1e-4 * usual().book.lost);
}

TEST(JobsHeat, ImpossibleJobsAreToldInOneSentence) {
  const auto complaint_of = [](const HeatJob& job) {
    const Result<HeatFound> found = heat(job);
    return found ? std::string() : found.error().message;
  };
  HeatJob job = job_of();
  job.source.program.bytes = "G21 G90 G17\nG0 X8 Y8 Z5\nG1 Z-1 F200\nG1 X12 F600\n";
  EXPECT_EQ(
      complaint_of(job),
      "part.ngc: the program cuts no wall of pocket.json; the tool, the stock to leave and the pocket have "
      "to be those of the program");
  job = job_of(), job.pitch = 0;
  EXPECT_EQ(complaint_of(job), "voxels of 0 mm cannot be made; state a pitch above 0");
  // Voxels larger than what they divide, and as large as it.
  job = job_of(), job.pitch = 50;
  EXPECT_EQ(
      complaint_of(job),
      "voxels of 50 mm are larger than the thickness of the stock of 10 mm; --voxel 2.5 has 4 across it");
  job = job_of(), job.source.stock.block = heat::read_stock("40x36x30"), job.pitch = 17;
  EXPECT_EQ(complaint_of(job),
            "voxels of 17 mm are larger than a side of the pocket of 16 mm; --voxel 4 has 4 across it");
  job.pitch = 16;
  EXPECT_EQ(complaint_of(job), "");
  job = job_of(), job.material = material(0.5, 0.5, "PMMA");
  EXPECT_NE(complaint_of(job).find("the figures of PMMA hold up to 105"), std::string::npos)
      << complaint_of(job);
}

}  // namespace
}  // namespace lekalo::jobs::jobs_heat_test
