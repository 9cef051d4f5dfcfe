#include "lekalo/nc/dialect.hpp"

namespace lekalo::nc {

/// G61 is the exact path: blending, G64, would leave the path that was judged or proved.
Dialect post_linuxcnc() {
  return {.name = "linuxcnc",
          .control = "LinuxCNC",
          .language = words::Control::linuxcnc,
          .pocket = {.modes = "{unit} G17 G90 G40 G49 G80 G94\nG91.1\n{offset}\nG61", .end = "M30"},
          .profile = {.modes = "{unit} G17 G90\nG40 G49 G80 G54 G94 G91.1 G61", .end = "M2"}};
}

}  // namespace lekalo::nc
