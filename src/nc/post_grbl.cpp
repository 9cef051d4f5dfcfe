#include "lekalo/nc/dialect.hpp"

namespace lekalo::nc {

/// GRBL has no tools, so the operator reads which one is meant, and no path modes. M4 makes the power of a
/// laser follow its speed; the power is the S word, which GRBL takes for 0 where none was given.
Dialect post_grbl() {
  return {.name = "grbl",
          .control = "GRBL",
          .language = words::Control::grbl,
          .pocket = {.modes = "{unit} G17 G90 G40 G49 G80 G94\nG91.1\n{offset}", .end = "M30"},
          .profile = {.modes = "{unit} G17 G90\nG40 G49 G54 G94 G91.1", .end = "M2"},
          .tool_change = "(TOOL {tool})",
          .changes_tools = false,
          .laser_on = "M4",
          .laser_needs_power = true};
}

}  // namespace lekalo::nc
