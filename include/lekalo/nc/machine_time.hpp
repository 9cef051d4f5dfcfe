#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::nc {

/// How long a machine takes for a profile program (nc/profile.hpp), motion by motion, from the words that are
/// written. docs/design/quote.md states the rules, and what was measured against a control.

/// How fast a control passes from one motion to the next.
enum class JunctionRule : std::uint8_t {
  exact_stop,  ///< every motion ends at rest: LinuxCNC's G61.1
  exact_path,  ///< LinuxCNC's G61: motions that run on in the same direction pass, all others end at rest
  deviation    ///< GRBL's junction deviation, $11
};

/// A machine with three axes. Rates hold for each axis by itself.
struct MachineModel {
  std::array<double, 3> rapid_mm_per_min{};        ///< of X, Y, Z; 1 to 1e6; feeds are bound by it too
  std::array<double, 3> acceleration_mm_per_s2{};  ///< of X, Y, Z; 1 to 1e6
  JunctionRule junctions = JunctionRule::exact_path;
  double junction_deviation_mm = 0.01;  ///< 1e-4 to 1, for JunctionRule::deviation
  double settle_s = 0;                  ///< 0 to 10: how long the control waits wherever it stops
};

enum class TimedKind : std::uint8_t {
  travel,  ///< G0
  cut,     ///< G1, G2, G3 along X and Y
  pierce   ///< a wait, and a motion with feed along Z alone
};

/// A motion or a wait.
struct TimedMotion {
  std::size_t line = 0;  ///< of the program, from 1
  TimedKind kind = TimedKind::travel;
  double length_mm = 0;  ///< 0 for a wait
  double seconds = 0;
};

struct TimedProgram {
  std::vector<TimedMotion> motions;  ///< in the order of the program
  /// The lines where the beam goes on, or where a tool begins to go down from Z 0 or above.
  std::vector<std::size_t> pierces;
};

/// Reads a program as profile_program() writes it, in any dialect, and computes when the machine is where. A
/// change of tools takes no time.
///
/// \param dwell_units_per_second  of `G4 P`, as in Dialect::dwell
/// Fails with ErrorCode::bad_input and `name:line: reason` for words that a profile program has not. Cost:
/// O(bytes).
[[nodiscard]] Result<TimedProgram> timed_program(std::string_view text, const std::string& name,
                                                 double dwell_units_per_second, const MachineModel& machine);

}  // namespace lekalo::nc
