#include "lekalo/nc/dialect.hpp"

namespace lekalo::nc {

/// Numbers of programs have five digits. Digits beyond 0.001 mm and 0.0001 inch are dropped, centres of arcs
/// are counted from the start, and a wait is in milliseconds, without a point.
Dialect post_haas() {
  return {.name = "haas",
          .control = "Haas",
          .language = words::Control::haas,
          .decimals = {.millimetre = 3, .inch = 4},
          .dwell = {.units_per_second = 1000, .decimals = 0},
          .tape_mark = "%",
          .program_number = "O00001",
          .pocket = {.modes = "{unit} G17 G90 G40 G49 G80 G94\n{offset}", .end = "M30"},
          .profile = {.modes = "{unit} G17 G90\nG40 G49 G80 G54 G94", .end = "M30"}};
}

}  // namespace lekalo::nc
