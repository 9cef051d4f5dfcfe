#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lekalo::verify {

/// The words of LinuxCNC's language that the checker knows; docs/cli.md lists them for people. Any other word
/// is refused, because nobody could say where the tool is after it.

/// Two codes of one group exclude each other within a block.
enum class Group {
  motion,
  dwell,
  plane,
  unit,
  distance,
  centre,
  feed_mode,
  compensation,
  tool_length,
  work_offset,
  path_control,
  retract,
  spindle_mode,
  stop,
  output,
  tool_change,
  spindle,
  coolant,
  speed_control,
};

/// A G or M word. Codes count tenths, so that G59.3 is 593.
struct Code {
  char letter;
  int tenths;
  Group group;
  /// The letters that have a meaning through this code. A block with another letter of these kinds (axes,
  /// I J R P Q H) is refused.
  std::string_view takes = {};
};

inline constexpr int kRapid = 0, kFeed = 10, kClockwise = 20, kCounterClockwise = 30, kNoMotion = 800;

[[nodiscard]] std::span<const Code> known_codes() noexcept;

/// The code of a G or M word, or null for one that is not known.
[[nodiscard]] const Code* code_of(char letter, double value) noexcept;

/// The word as people write it, `G59.3`.
[[nodiscard]] std::string name_of(const Code& code);

/// The letters other than G and M that may stand in a block: those that need a code which takes them, and
/// those that need none.
inline constexpr std::string_view kTakenLetters = "XYZIJRPQH", kFreeLetters = "NOFST";

}  // namespace lekalo::verify
