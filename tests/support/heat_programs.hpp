#pragma once

#include <fmt/core.h>

#include <string>

namespace lekalo::cases {

/// A pocket of 40 x 30 mm, as a region file.
inline const std::string kHeatedPocket =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[40,0]}},{"line":{"from":[40,0],"to":[40,30]}},)"
    R"({"line":{"from":[40,30],"to":[0,30]}},{"line":{"from":[0,30],"to":[0,0]}}]})";

/// Lanes and a round that leave `stock` on its walls, and then one pass along them by a tool of 6 mm, on each
/// level: a digit is a depth in mm.
inline std::string heated_program(double stock, const std::string& levels) {
  std::string program = "G21 G90 G17 G54 G94\nM3 S8000\n";
  for (const char level : levels) {
    const double a = 3 + stock;
    program += "G0 X6 Y6 Z5\nG1 Z-" + std::string(1, level) + " F200\n";
    for (double y = 6; y < 25; y += 4)
      program += fmt::format("G1 X{:g} Y{:g} F900\nG1 X{:g}\nG1 Y{:g}\n", a, y, 40 - a, y + 2);
    program +=
        fmt::format("G1 X{0:g} Y{0:g}\nG1 X{1:g}\nG1 Y{2:g}\nG1 X{0:g}\nG1 Y{0:g}\n", a, 40 - a, 30 - a);
    program +=
        "G1 X8 Y10\nG1 X20 Y4\nG3 X21 Y3 I1 J0\nG1 X37 Y3\nG1 Y27\nG1 X3\nG1 Y3\nG1 X21\nG3 X22 Y4 I0 "
        "J1\nG0 Z5\n";
  }
  return program + "M5\nM2\n";
}

}  // namespace lekalo::cases
