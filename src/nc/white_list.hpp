#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "lekalo/nc/decimal.hpp"

namespace lekalo::nc {

/// The words that may pass, and what each does to the state of the control. docs/design/nc-rewrite.md says
/// why each of them keeps its meaning when the path is turned and shifted in the plane.

/// Words of one group exclude each other within a block.
enum class Group {
  dwell,
  motion,
  cycle_cancel,  ///< G80, which may stand beside G0 to G3
  plane,
  unit,
  compensation,
  tool_length,
  work_offset,
  path_control,
  distance,
  centre_distance,
  feed_mode,
  retract,
  spindle_mode,
  rotation_cancel,
};
inline constexpr std::size_t kGroups = 15;

/// Codes count tenths, so that G59.3 is 593.
inline constexpr int kRapid = 0, kFeed = 10, kClockwise = 20, kCounterClockwise = 30, kMotionOff = 800;

/// The group of a G word on the list, else nothing.
[[nodiscard]] std::optional<Group> group_of(int tenths) noexcept;

/// Drilling, tapping and boring cycles of the list.
[[nodiscard]] bool is_cycle(int tenths) noexcept;

/// Number of the work offset that a G word selects (G54 is 1 .. G59.3 is 9); \pre group work_offset.
[[nodiscard]] int work_offset_of(int tenths) noexcept;
/// `G54` .. `G59.3`; \pre 1 <= number <= 9.
[[nodiscard]] std::string work_offset_name(int number);

/// Tenths of a G word's number; nothing when it has more than one decimal or is out of range.
[[nodiscard]] std::optional<int> tenths_of(Decimal value) noexcept;

/// The reason to refuse a G word that is not on the list.
[[nodiscard]] std::string refused_g(Decimal value);

[[nodiscard]] bool m_on_list(int number) noexcept;
/// True for M words of the list that change nothing that a later block depends on: a block that may be
/// skipped may hold them.
[[nodiscard]] bool m_may_be_skipped(int number) noexcept;
[[nodiscard]] std::string refused_m(Decimal value);

/// The reason to refuse a letter; none for a letter that can stand in a program on the list.
[[nodiscard]] std::optional<std::string> refused_letter(char letter);

}  // namespace lekalo::nc
