// LinuxCNC runs ten programs on a simulated machine, and takes within a tenth of the time that is computed.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "lekalo/nc/machine_time.hpp"
#include "lekalo/nc/profile.hpp"
#include "support/cases.hpp"
#include "support/places.hpp"
#include "support/profile_parts.hpp"
#include "support/rs274.hpp"

namespace lekalo::nc::nc_machine_time_linuxcnc_test {
namespace {

constexpr double kSpeed = 200, kAcceleration = 1000;  // mm/s, mm/s^2

/// A program of its own kind for each of ten numbers: three kinds of machine, leads, units and feeds.
ProfileOptions options_of(std::size_t i) {
  ProfileOptions o;
  o.kerf_mm = 0.2 + 0.1 * static_cast<double>(i % 3);
  o.feed_mm_per_min = 2000 + 1000 * static_cast<double>(i);
  o.lead = i % 2 == 0 ? LeadShape::line : LeadShape::arc;
  o.lead_in_mm = static_cast<double>(i % 4);
  o.unit = i == 7 ? LengthUnit::inch : LengthUnit::millimetre;
  if (i % 5 == 4) {
    o.process = Process::router, o.speed = 1000, o.depth_mm = 3, o.pass_mm = 1.5, o.plunge_mm_per_min = 1200;
  } else {
    o.process = i % 2 == 0 ? Process::laser : Process::plasma, o.pierce_s = 0.1 * static_cast<double>(i % 3);
  }
  return o;
}

TEST(MachineTimeAgainstLinuxCnc, TenProgramsTakeTheTimeThatIsComputed) {
  if (std::getenv("LEKALO_FULL") == nullptr) GTEST_SKIP() << "takes minutes; LEKALO_FULL=1 runs it";
  const rs274::ScratchFolder folder;
  MachineModel machine;
  machine.rapid_mm_per_min.fill(60 * kSpeed);
  machine.acceleration_mm_per_s2.fill(kAcceleration);
  std::string command = fmt::format("'{}/tests/support/linuxcnc.sh' '{}' {} {}", cases::source_dir(),
                                    folder.path().string(), kSpeed, kAcceleration);
  std::vector<double> computed;
  for (std::size_t i = 0; i < 10; ++i) {
    std::vector<ProfilePart> parts = cases::random_parts(cases::seed(), i);
    if (parts.size() > 4) parts.resize(4);  // washers keep what lies in their holes: the ids before
    const auto made = profile_program(parts, fmt::format("program {}", i), options_of(i));
    ASSERT_TRUE(made) << made.error().message;
    const std::filesystem::path file = folder.path() / fmt::format("{}.ngc", i);
    std::ofstream(file) << made->text;
    command += fmt::format(" '{}'", file.string());
    const auto timed = timed_program(made->text, file.string(), 1, machine);
    ASSERT_TRUE(timed) << timed.error().message;
    double sum = 0;
    for (const TimedMotion& motion : timed->motions) sum += motion.seconds;
    computed.push_back(sum);
  }
  const std::string said = (folder.path() / "seconds.txt").string();
  ASSERT_EQ(std::system((command + " > '" + said + "'").c_str()), 0);
  const std::string output = rs274::read_file(said);
  std::istringstream lines(output);
  for (std::size_t i = 0; i < computed.size(); ++i) {
    double taken = 0;
    ASSERT_TRUE(lines >> taken) << output;
    EXPECT_NEAR(computed[i], taken, 0.1 * taken) << "program " << i;
    fmt::print("program {}: computed {:.2f} s, LinuxCNC {:.2f} s, {:+.1f} %\n", i, computed[i], taken,
               100 * (computed[i] / taken - 1));
  }
}

}  // namespace
}  // namespace lekalo::nc::nc_machine_time_linuxcnc_test
