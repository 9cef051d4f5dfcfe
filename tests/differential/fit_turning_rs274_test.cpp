// LinuxCNC's own interpreter runs turning programs of `lekalo fit`: its canonical motions are the profile.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "lekalo/jobs/fit.hpp"
#include "support/places.hpp"
#include "support/rs274.hpp"

namespace lekalo::fit_turning_rs274_test {
namespace {

using fit::Surface;
using fit::TurnedPoint;

const rs274::Oracle& oracle() {
  static const rs274::Oracle instance(cases::source_dir() + "/tests/support/rs274.sh");
  return instance;
}

jobs::Fitted made(Surface surface, bool radius) {
  jobs::FitJob job;
  job.diameter = 18, job.interference = 0.04;
  job.hub_outer = 36, job.length = 18, job.shaft_length = 40, job.bore = 8, job.from_end = 6;
  job.material.name = "C45", job.material.yield_mpa = 2000;
  job.cylindrical = surface;
  job.table_as = "profile.csv", job.program_as = "profile.ngc";
  job.turning.radius = radius, job.turning.feed_mm_per_min = 40, job.turning.spindle_rpm = 800;
  return jobs::fit(job).value();
}

/// The profile as its own file has it, from right to left.
std::vector<TurnedPoint> points_of(const std::string& table) {
  std::vector<TurnedPoint> points;
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line))
    points.push_back({std::stod(line), std::stod(line.substr(line.find(',') + 1))});
  return points;
}

/// The ends of all feeds, z from the right face, and where the first begins.
std::vector<TurnedPoint> cuts_of(const std::vector<rs274::Call>& calls) {
  std::vector<TurnedPoint> cuts;
  TurnedPoint here;
  for (const rs274::Call& call : calls) {
    EXPECT_FALSE(call.arc());
    if (!call.straight()) continue;
    const TurnedPoint to{call.end()[2] * call.unit, 2 * call.end()[0] * call.unit};
    if (call.name == "STRAIGHT_FEED") {
      if (cuts.empty()) cuts.push_back(here);
      cuts.push_back(to);
    }
    EXPECT_EQ(call.end()[1], 0);
    here = to;
  }
  return cuts;
}

/// How far the cuts are from the profile at most, mm of the diameter or along the axis.
double off(const std::vector<TurnedPoint>& cuts, const std::vector<TurnedPoint>& profile, double face) {
  if (cuts.size() != profile.size() + 2) return HUGE_VAL;
  double most = 0;
  for (std::size_t i = 0; i < profile.size(); ++i)
    most = std::max({most, std::abs(cuts[i + 1].z - (profile[i].z - face)),
                     std::abs(cuts[i + 1].diameter - profile[i].diameter)});
  return most;
}

std::size_t count(const std::vector<rs274::Call>& calls, const char* name, const char* with = "") {
  std::size_t n = 0;
  for (const rs274::Call& call : calls)
    n += call.name == name && call.arguments.find(with) != std::string::npos ? 1 : 0;
  return n;
}

/// A rapid goes along the axis before the face, or away from the surface.
void expect_no_rapid_at_the_part(const std::vector<rs274::Call>& calls, Surface surface,
                                 const std::vector<TurnedPoint>& profile) {
  double least = HUGE_VAL, most = 0;
  for (const TurnedPoint& p : profile) least = std::min(least, p.diameter), most = std::max(most, p.diameter);
  TurnedPoint here{1e3, 0};  // the interpreter begins at 0; a machine is told first to go before the face
  for (const rs274::Call& call : calls) {
    if (!call.straight()) continue;
    const TurnedPoint to{call.end()[2], 2 * call.end()[0]};
    const auto beside = [&](const TurnedPoint& p) {
      return surface == Surface::bore ? p.diameter < least - 0.1 : p.diameter > most + 0.1;
    };
    const bool behind = to.z < profile.back().z - profile.front().z - 0.9 && here.z == to.z;
    const bool away = (here.z >= 0.999 && to.z >= 0.999) || (beside(here) && beside(to)) || behind;
    EXPECT_TRUE(away || call.name != "STRAIGHT_TRAVERSE") << call.arguments;
    here = to;
  }
}

TEST(FitTurningRs274, TheInterpreterTurnsTheProfileByDiameterAndByRadius) {
  for (const Surface surface : {Surface::outside, Surface::bore, Surface::seat})
    for (const bool radius : {false, true}) {
      SCOPED_TRACE(fmt::format("{}, {}", fit::name_of(surface), radius ? "radius" : "diameter"));
      const jobs::Fitted fitted = made(surface, radius);
      const std::vector<TurnedPoint> profile = points_of(fitted.table);
      ASSERT_GT(profile.size(), 20U);
      const double face = fitted.corrected->face;
      const rs274::Run run = oracle().run(fitted.program);
      ASSERT_TRUE(run.accepted) << run.errors;
      // The interpreter prints radii with four decimals.
      EXPECT_LE(off(cuts_of(run.calls), profile, face), 1.0001e-4);
      expect_no_rapid_at_the_part(run.calls, surface, profile);
      EXPECT_EQ(count(run.calls, "SELECT_PLANE", "XZ"), 1U);
      EXPECT_EQ(count(run.calls, "START_SPINDLE_CLOCKWISE"), 1U);
      EXPECT_GE(count(run.calls, "STOP_SPINDLE_TURNING"), 1U);
      EXPECT_EQ(count(run.calls, "SET_FEED_RATE", "40.0"), 1U);
      EXPECT_EQ(count(run.calls, "PROGRAM_END"), 1U);

      // The other word for X is another part.
      std::string other = fitted.program;
      const std::size_t word = other.find(radius ? " G8 " : " G7 ");
      ASSERT_NE(word, std::string::npos);
      other[word + 2] = radius ? '7' : '8';
      const rs274::Run wrong = oracle().run(other);
      ASSERT_TRUE(wrong.accepted) << wrong.errors;
      EXPECT_GT(off(cuts_of(wrong.calls), profile, face), 1);
    }
}

}  // namespace
}  // namespace lekalo::fit_turning_rs274_test
