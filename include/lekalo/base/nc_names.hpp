#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace lekalo::words {

/// The names that LinuxCNC gives to its own state, in capitals. No program can set them.
inline constexpr auto kStateNames = std::to_array<std::string_view>({"_VMAJOR",
                                                                     "_VMINOR",
                                                                     "_LINE",
                                                                     "_MOTION_MODE",
                                                                     "_PLANE",
                                                                     "_CCOMP",
                                                                     "_METRIC",
                                                                     "_IMPERIAL",
                                                                     "_ABSOLUTE",
                                                                     "_INCREMENTAL",
                                                                     "_INVERSE_TIME",
                                                                     "_UNITS_PER_MINUTE",
                                                                     "_UNITS_PER_REV",
                                                                     "_COORD_SYSTEM",
                                                                     "_TOOL_OFFSET",
                                                                     "_RETRACT_R_PLANE",
                                                                     "_RETRACT_OLD_Z",
                                                                     "_SPINDLE_RPM_MODE",
                                                                     "_SPINDLE_CSS_MODE",
                                                                     "_IJK_ABSOLUTE_MODE",
                                                                     "_LATHE_DIAMETER_MODE",
                                                                     "_LATHE_RADIUS_MODE",
                                                                     "_SPINDLE_ON",
                                                                     "_SPINDLE_CW",
                                                                     "_MIST",
                                                                     "_FLOOD",
                                                                     "_SPEED_OVERRIDE",
                                                                     "_FEED_OVERRIDE",
                                                                     "_ADAPTIVE_FEED",
                                                                     "_FEED_HOLD",
                                                                     "_FEED",
                                                                     "_RPM",
                                                                     "_X",
                                                                     "_Y",
                                                                     "_Z",
                                                                     "_A",
                                                                     "_B",
                                                                     "_C",
                                                                     "_U",
                                                                     "_V",
                                                                     "_W",
                                                                     "_CURRENT_TOOL",
                                                                     "_CURRENT_POCKET",
                                                                     "_SELECTED_TOOL",
                                                                     "_SELECTED_POCKET",
                                                                     "_VALUE",
                                                                     "_VALUE_RETURNED",
                                                                     "_TASK",
                                                                     "_CALL_LEVEL",
                                                                     "_REMAP_LEVEL"});

/// True for the name between `<` and `>`, in capitals.
[[nodiscard]] constexpr bool is_state_name(std::string_view name) noexcept {
  return std::find(kStateNames.begin(), kStateNames.end(), name) != kStateNames.end() ||
         name.starts_with("_ABS_") || name.starts_with("_INI[") || name.starts_with("_HAL[");
}

}  // namespace lekalo::words
