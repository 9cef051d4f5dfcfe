#include "lekalo/nc/dialect.hpp"

namespace lekalo::nc {

/// Controls of increment system IS-B drop digits beyond 0.001 mm and 0.0001 inch. Centres of arcs are always
/// counted from the start, without a word for it. A wait is in milliseconds, without a point.
Dialect post_fanuc() {
  return {.name = "fanuc",
          .control = "Fanuc",
          .language = words::Control::fanuc,
          .decimals = {.millimetre = 3, .inch = 4},
          .dwell = {.units_per_second = 1000, .decimals = 0},
          .tape_mark = "%",
          .program_number = "O0001",
          .pocket = {.modes = "{unit} G17 G90 G40 G49 G80 G94\n{offset}", .end = "M30"},
          .profile = {.modes = "{unit} G17 G90\nG40 G49 G80 G54 G94", .end = "M30"}};
}

}  // namespace lekalo::nc
