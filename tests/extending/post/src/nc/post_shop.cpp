#include "lekalo/nc/dialect.hpp"

namespace lekalo::nc {

/// The control counts a wait in tenths of a second and takes comments after a semicolon.
Dialect post_shop() {
  return {.name = "shop",
          .control = "Shop 9",
          .comment = {.open = "; ", .close = ""},
          .dwell = {.units_per_second = 10, .decimals = 0},
          .pocket = {.modes = "{unit} G17 G90 G40 G49 G80 G94\nG91.1 G61\n{offset}", .end = "M30"},
          .profile = {.modes = "{unit} G17 G90\nG40 G49 G54 G94 G91.1 G61", .end = "M30"}};
}

}  // namespace lekalo::nc
