#include "nc_cycle.hpp"

#include <algorithm>

namespace lekalo::verify {
namespace {

/// LinuxCNC lifts the drill by this much to break a chip, and comes back to this much above the last depth.
constexpr double kClearance = 0.254;  // mm, 0.010 inch

std::vector<NcPlunge> pecks(const NcCycle& cycle) {
  const bool breaks_chips = cycle.tenths == 730;
  std::vector<NcPlunge> ways;
  for (double depth = cycle.high - cycle.peck; depth > cycle.low; depth -= cycle.peck) {
    ways.push_back({false, depth});
    ways.push_back({true, breaks_chips ? depth + kClearance : cycle.high});
    if (!breaks_chips) ways.push_back({true, std::min(depth + kClearance, cycle.high)});
  }
  return ways;
}

}  // namespace

std::vector<NcPlunge> plunges_of(const NcCycle& cycle) {
  std::vector<NcPlunge> ways;
  if (cycle.tenths == 730 || cycle.tenths == 830) ways = pecks(cycle);
  ways.push_back({false, cycle.low});
  // Taps come out as they went in, and G85 up to the plane R; drills and stopped bars come out fast.
  const bool feeds_out = cycle.tenths == 740 || cycle.tenths == 840 || cycle.tenths == 890;
  if (cycle.tenths == 850) ways.push_back({false, cycle.high});
  ways.push_back({!feeds_out, cycle.clear});
  return ways;
}

}  // namespace lekalo::verify
