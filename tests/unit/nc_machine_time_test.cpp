#include "lekalo/nc/machine_time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "lekalo/nc/profile.hpp"
#include "support/profile_parts.hpp"

namespace lekalo::nc::nc_machine_time_test {
namespace {

MachineModel machine(JunctionRule rule) {
  MachineModel made;
  made.rapid_mm_per_min.fill(12000);  // 200 mm/s
  made.acceleration_mm_per_s2.fill(1000);
  made.junctions = rule;
  return made;
}

TimedProgram timed(const std::string& words, const MachineModel& by) {
  auto made = timed_program("G21 G17 G90\n" + words + "M2\n", "p.nc", 1, by);
  if (!made) throw std::logic_error("test input: " + made.error().message);
  return *std::move(made);
}
double seconds(const std::string& words, const MachineModel& by) {
  double sum = 0;
  for (const TimedMotion& motion : timed(words, by).motions) sum += motion.seconds;
  return sum;
}
std::string trouble(const std::string& words) {
  const auto made = timed_program(words, "p.nc", 1, machine(JunctionRule::exact_stop));
  return made ? "none" : made.error().message;
}

/// The trapezoid by hand: the length at the top speed, and once the time to reach it.
double trapezoid(double length, double speed, double acceleration) {
  return length >= speed * speed / acceleration ? length / speed + speed / acceleration
                                                : 2 * std::sqrt(length / acceleration);
}

TEST(MachineTime, AMotionByItselfIsATrapezoidOrATriangle) {
  const MachineModel by = machine(JunctionRule::exact_stop);
  EXPECT_NEAR(seconds("G1 X100 F6000\n", by), trapezoid(100, 100, 1000), 1e-12);
  EXPECT_NEAR(seconds("G1 X5 F6000\n", by), trapezoid(5, 100, 1000), 1e-12);
  EXPECT_NEAR(seconds("G0 X100\n", by), trapezoid(100, 200, 1000), 1e-12);
  // Both axes carry a diagonal; its speed and its acceleration are larger by the root of 2.
  const double root = std::numbers::sqrt2;
  EXPECT_NEAR(seconds("G0 X100 Y100\n", by), trapezoid(100 * root, 200 * root, 1000 * root), 1e-12);
  EXPECT_NEAR(seconds("G20\nG1 X2 F60\n", by), trapezoid(50.8, 25.4, 1000), 1e-12);
}

TEST(MachineTime, AMachineStandsStillWhereAToolIsChanged) {
  const MachineModel by = machine(JunctionRule::exact_path);
  const double one = seconds("G1 X100 F6000\n", by);
  EXPECT_LT(seconds("G1 X100 F6000\nX200\n", by), 2 * one - 1e-3);
  EXPECT_NEAR(seconds("G1 X100 F6000\nT2 M6\nG43 H2\nX200\n", by), 2 * one, 1e-12);
}

TEST(MachineTime, EachAxisHasLimitsOfItsOwn) {
  MachineModel by = machine(JunctionRule::exact_stop);
  by.rapid_mm_per_min = {12000, 6000, 600};
  by.acceleration_mm_per_s2 = {1000, 500, 50};
  EXPECT_NEAR(seconds("G0 Y100\n", by), trapezoid(100, 100, 500), 1e-12);
  EXPECT_NEAR(seconds("G0 X100 Y100\n", by),
              trapezoid(100 * std::numbers::sqrt2, 100 * std::numbers::sqrt2, 500 * std::numbers::sqrt2),
              1e-12);
  // The first height is where the machine stands.
  EXPECT_NEAR(seconds("G0 Z5\nG1 Z-5 F6000\n", by), trapezoid(10, 10, 50), 1e-12);
}

TEST(MachineTime, AnExactStopRestsBetweenMotionsThatRunOn) {
  const std::string two = "G1 X50 F6000\nX100\n";
  EXPECT_NEAR(seconds(two, machine(JunctionRule::exact_stop)), 2 * trapezoid(50, 100, 1000), 1e-12);
  EXPECT_NEAR(seconds(two, machine(JunctionRule::exact_path)), trapezoid(100, 100, 1000), 1e-12);
  EXPECT_NEAR(seconds(two, machine(JunctionRule::deviation)), trapezoid(100, 100, 1000), 1e-12);
}

TEST(MachineTime, AnExactPathPassesTangentsAloneAndTheLimitFollowsTheSpeed) {
  const MachineModel by = machine(JunctionRule::exact_path);
  // At 100 mm/s a turn of 0.1 a T / v = 1 mrad passes, a larger one does not.
  const auto bent = [&](const char* y) {
    return seconds(std::string("G1 X50 F6000\nX100 Y") + y + "\n", by);
  };
  EXPECT_NEAR(bent("0.0499"), trapezoid(100, 100, 1000), 1e-4);
  EXPECT_NEAR(bent("0.0501"), 2 * trapezoid(50, 100, 1000), 1e-4);
  // Slower motions may turn by more.
  const std::string slow = "G1 X50 F600\nX100 Y0.2\n";
  EXPECT_NEAR(seconds(slow, by), trapezoid(100, 10, 1000), 1e-3);
}

TEST(MachineTime, AnArcKeepsAShareOfTheAccelerationForTheWayAcrossIt) {
  // 0.866 a = v^2 / r on the arc, and half of a is left along it.
  const double speed = std::sqrt(std::sqrt(0.75) * 1000 * 5), half = 5 * std::numbers::pi;
  EXPECT_NEAR(seconds("F12000\nG3 X-10 I-5 J0\n", machine(JunctionRule::exact_path)),
              trapezoid(half, speed, 500), 1e-9);
  // A slow arc has nearly all of it left.
  EXPECT_NEAR(seconds("F60\nG3 X-10 I-5 J0\n", machine(JunctionRule::exact_path)), trapezoid(half, 1, 1000),
              1e-5);
  // A whole circle is two arcs that pass into each other.
  EXPECT_NEAR(seconds("F12000\nG2 X10 I5 J0\nG2 X0 I-5 J0\n", machine(JunctionRule::exact_path)),
              trapezoid(2 * half, speed, 500), 1e-9);
  // GRBL: chords within 0.002 mm, passed by the junction deviation of 0.01 mm: sqrt(a r d / t).
  EXPECT_NEAR(seconds("F60000\nG3 X-10 I-5 J0\n", machine(JunctionRule::deviation)),
              trapezoid(half, std::sqrt(1000 * 5 * 0.01 / 0.002), 1000), 2e-4);
}

TEST(MachineTime, AJunctionDeviationSlowsDownByTheAngle) {
  MachineModel by = machine(JunctionRule::deviation);
  // A right angle is passed at v^2 = a d / (sqrt(2) - 1); along its bisector the acceleration is sqrt(2) a.
  const double square = std::numbers::sqrt2 * 1000 * 0.01 / (std::numbers::sqrt2 - 1), v = std::sqrt(square);
  const double one = 50 + square / 2000 - 100 * 100 / 1000.0;  // at the full speed, mm
  EXPECT_NEAR(seconds("G1 X50 F6000\nY50\n", by), 2 * (0.1 + (100 - v) / 1000 + one / 100), 1e-9);
  // Straight back is a stop.
  EXPECT_NEAR(seconds("G1 X50 F6000\nX0\n", by), 2 * trapezoid(50, 100, 1000), 1e-12);
}

TEST(MachineTime, TheControlWaitsWhereItStops) {
  MachineModel by = machine(JunctionRule::exact_stop);
  by.settle_s = 0.5;
  EXPECT_NEAR(seconds("G1 X50 F6000\nX100\n", by), 2 * trapezoid(50, 100, 1000) + 1, 1e-12);
  by.junctions = JunctionRule::exact_path;
  EXPECT_NEAR(seconds("G1 X50 F6000\nX100\nY50\n", by),
              trapezoid(100, 100, 1000) + trapezoid(50, 100, 1000) + 1, 1e-12);
}

TEST(MachineTime, CutsPiercesAndTravelAreToldApart) {
  const TimedProgram beam =
      timed("G0 X10\nM3\nG4 P0.25\nG1 X20 F600\nM5\nG0 X0\n", machine(JunctionRule::exact_path));
  ASSERT_EQ(beam.motions.size(), 4U);
  const std::vector<TimedKind> kinds{TimedKind::travel, TimedKind::pierce, TimedKind::cut, TimedKind::travel};
  for (std::size_t i = 0; i < kinds.size(); ++i) EXPECT_EQ(beam.motions[i].kind, kinds[i]) << i;
  EXPECT_EQ(beam.motions[1].seconds, 0.25);
  EXPECT_EQ(beam.motions[2].line, 5U);
  EXPECT_EQ(beam.pierces, std::vector<std::size_t>{3});
  // A router goes down once for each cut, and further down for each pass.
  const TimedProgram router = timed(
      "G0 Z5\nM3 S100\nG0 X10\nG1 Z-1 F60\nX20 F600\nZ-2 F60\nX10 F600\nG0 Z5\nG0 X30\nG1 Z-1\nX40\nG0 "
      "Z5\nM5\n",
      machine(JunctionRule::exact_path));
  EXPECT_EQ(router.pierces, (std::vector<std::size_t>{5, 11}));
}

TEST(MachineTime, AProgramHasALineRangeForEachCutAndTheTimesAreThoseOfItsMotions) {
  ProfileOptions options;
  options.kerf_mm = 0.2, options.feed_mm_per_min = 6000, options.lead_in_mm = 2, options.pierce_s = 0.1;
  const auto made = profile_program(cases::random_parts(1, 3), "parts", options);
  ASSERT_TRUE(made) << made.error().message;
  const auto timed = timed_program(made->text, "parts", 1, machine(JunctionRule::exact_path));
  ASSERT_TRUE(timed) << timed.error().message;
  EXPECT_EQ(made->lines_of_cuts.size(), made->cuts);
  EXPECT_EQ(timed->pierces.size(), made->cuts);
  double cut = 0, travel = 0;
  std::size_t at = 0;
  for (const TimedMotion& motion : timed->motions) {
    (motion.kind == TimedKind::travel ? travel : cut) += motion.length_mm;
    if (motion.kind != TimedKind::cut) continue;
    while (made->lines_of_cuts.at(at).last < motion.line) ++at;
    EXPECT_LE(made->lines_of_cuts[at].first, motion.line);
  }
  EXPECT_NEAR(cut, made->cut_mm, 1e-6 * cut);
  EXPECT_NEAR(travel, made->travel_mm, 1e-6 * travel);
  for (std::size_t i = 1; i < made->lines_of_cuts.size(); ++i)
    EXPECT_LT(made->lines_of_cuts[i - 1].last, made->lines_of_cuts[i].first);
}

TEST(MachineTime, WordsThatAProfileProgramHasNotAreRefusedWithTheirLine) {
  EXPECT_EQ(trouble("G21\nG91\n"), "p.nc:2: a profile program has no G91");
  EXPECT_EQ(trouble("G21\nG1 X5\n"), "p.nc:2: a motion with a feed, and no F before it");
  EXPECT_EQ(trouble("G4\n"), "p.nc:1: a wait without its time");
  EXPECT_EQ(trouble("F100\nG2 X5 R9\n"), "p.nc:2: a profile program has no word R");
  EXPECT_EQ(trouble("F100\nG2 X5\n"), "p.nc:2: an arc without I and J, or with Z");
  EXPECT_EQ(trouble("F100\nG2 X5 I0 J0\n"), "p.nc:2: an arc about a point of it");
  EXPECT_EQ(trouble("G1 X[1+2]\n").substr(0, 7), "p.nc:1:");
}

}  // namespace
}  // namespace lekalo::nc::nc_machine_time_test
