// LinuxCNC's own interpreter runs profile programs: its canonical motions, swept by the kerf, against the
// parts. It prints four decimals of the program's unit.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "lekalo/nc/profile.hpp"
#include "support/cases.hpp"
#include "support/places.hpp"
#include "support/profile_parts.hpp"
#include "support/rs274.hpp"

namespace lekalo::nc::nc_profile_rs274_test {
namespace {

using cases::Real;

const rs274::Oracle& oracle() {
  static const rs274::Oracle instance(cases::source_dir() + "/tests/support/rs274.sh");
  return instance;
}

struct Swept {
  std::size_t feeds = 0, arcs = 0, spindle_starts = 0, spindle_stops = 0;
  double lowest_z = 0;
  Real deepest = 0;
};

/// Points along every feed of the canonical motions; a traverse is no cut.
Swept swept(const std::vector<rs274::Call>& calls, const std::vector<ProfilePart>& parts, double kerf) {
  Swept sum;
  rs274::Point here;
  double z = 0;
  const auto look = [&](rs274::Point p) {
    for (const ProfilePart& part : parts)
      sum.deepest = std::max(sum.deepest, cases::depth_of_kerf(p, part.region, kerf));
  };
  for (const rs274::Call& call : calls) {
    if (call.name == "START_SPINDLE_CLOCKWISE") ++sum.spindle_starts;
    if (call.name == "STOP_SPINDLE_TURNING") ++sum.spindle_stops;
    if (!call.straight() && !call.arc()) continue;
    const double unit = call.unit;
    const rs274::Point to{Real(call.numbers[0]) * unit, Real(call.numbers[1]) * unit};
    if (call.arc()) {
      // first_end, second_end, first_axis, second_axis, rotation, axis_end_point
      const Real cx = Real(call.numbers[2]) * unit, cy = Real(call.numbers[3]) * unit;
      const bool ccw = call.numbers[4] > 0;
      const Real radius = std::hypot(here.x - cx, here.y - cy), begin = std::atan2(here.y - cy, here.x - cx);
      Real sweep = std::atan2(to.y - cy, to.x - cx) - begin;
      while (ccw && sweep <= 0) sweep += 2 * rs274::kPi;
      while (!ccw && sweep >= 0) sweep -= 2 * rs274::kPi;
      for (int k = 0; k <= 16; ++k)
        look(
            {cx + radius * std::cos(begin + sweep * k / 16), cy + radius * std::sin(begin + sweep * k / 16)});
      ++sum.arcs, ++sum.feeds;
    } else {
      z = call.numbers[2] * unit;
      if (call.name == "STRAIGHT_FEED") {
        for (int k = 0; k <= 16; ++k)
          look({here.x + (to.x - here.x) * k / 16, here.y + (to.y - here.y) * k / 16});
        ++sum.feeds;
      }
    }
    sum.lowest_z = std::min(sum.lowest_z, z);
    here = to;
  }
  return sum;
}

TEST(NcProfileRs274, TheInterpreterCutsBesideEveryPart) {
  std::size_t arcs = 0;
  for (std::size_t index = 0; index < cases::case_count(6); ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    const std::vector<ProfilePart> parts = cases::random_parts(cases::seed(), 500 + index);
    Random random(cases::seed(), 55000 + index);
    ProfileOptions options;
    options.process = static_cast<Process>(index % 3);
    options.unit = index % 4 == 1 ? LengthUnit::inch : LengthUnit::millimetre;
    options.lead = index % 2 == 0 ? LeadShape::arc : LeadShape::line;
    options.kerf_mm = random.uniform(0.1, 1.5);
    options.lead_in_mm = random.uniform(0.5, 6);
    options.feed_mm_per_min = 1500, options.speed = index == 0 ? 0 : 9000;
    if (options.process == Process::plasma) options.pierce_s = 0.4;
    if (options.process == Process::router)
      options.depth_mm = 6, options.pass_mm = 2.5, options.plunge_mm_per_min = 200;
    options.holes = {{7, 0.7, 0.5}, {15, std::nullopt, 0.8}};
    const auto made = profile_program(parts, "random", options);
    ASSERT_TRUE(made) << made.error().message;
    const rs274::Run run = oracle().run(made->text);
    ASSERT_TRUE(run.accepted) << run.errors << made->text;
    const Swept sum = swept(run.calls, parts, options.kerf_mm);
    // Four decimals of an inch, in x and y.
    const double printed = 0.75e-4 * millimetres_per(options.unit);
    EXPECT_LE(double(sum.deepest), made->deepest_mm + 2 * printed) << made->text;
    EXPECT_GT(sum.feeds, made->cuts);
    arcs += sum.arcs;
    if (options.process == Process::router) {
      EXPECT_NEAR(sum.lowest_z, -6, 1e-3);
      EXPECT_EQ(sum.spindle_starts, 1U);
    } else {
      EXPECT_EQ(sum.spindle_starts, made->cuts);
      EXPECT_GE(sum.spindle_stops, made->cuts);
    }
    // The same program does enter parts that are half a kerf larger all round: the measure can see it.
    EXPECT_GT(double(swept(run.calls, parts, 3 * options.kerf_mm).deepest), 0.8 * options.kerf_mm);
  }
  EXPECT_GT(arcs, 30U);
}

TEST(NcProfileRs274, TheInterpreterStopsBeforeJointsAndRisesOverTabs) {
  for (std::size_t index = 0; index < cases::case_count(3); ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    const std::vector<ProfilePart> parts = cases::random_parts(cases::seed(), 700 + index);
    ProfileOptions options;
    options.process = static_cast<Process>(index % 3);
    options.kerf_mm = 0.3, options.lead_in_mm = 1, options.feed_mm_per_min = 1500, options.speed = 9000;
    if (options.process == Process::router)
      options.depth_mm = 6, options.pass_mm = 2.5, options.plunge_mm_per_min = 200,
      options.joints.tab_height_mm = 1.5;
    else
      options.pierce_diameter_mm = 0.5;
    options.joints.rule = JointRule::count, options.joints.count = 2, options.joints.width_mm = 0.4;
    const auto made = profile_program(parts, "random", options);
    ASSERT_TRUE(made) << made.error().message;
    ASSERT_GT(made->joints, 0U);
    const rs274::Run run = oracle().run(made->text);
    ASSERT_TRUE(run.accepted) << run.errors << made->text;
    const Swept sum = swept(run.calls, parts, options.kerf_mm);
    EXPECT_LE(double(sum.deepest), made->deepest_mm + 1.5e-4) << made->text;
    if (options.process != Process::router) {
      EXPECT_EQ(sum.spindle_starts, made->cuts - made->jointed_parts + made->joints);
      continue;
    }
    // In the last pass the tool rises to the tabs as often as there are joints.
    std::size_t tabs = 0;
    double z = 0;
    for (const rs274::Call& call : run.calls)
      if (call.straight()) {
        if (call.numbers[2] > -4.5 - 1e-6 && call.numbers[2] < -4.5 + 1e-6 && z < -5.9) ++tabs;
        z = call.numbers[2];
      }
    EXPECT_EQ(tabs, made->joints);
  }
}

}  // namespace
}  // namespace lekalo::nc::nc_profile_rs274_test
