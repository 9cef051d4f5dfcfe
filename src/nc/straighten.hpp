#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "interpreter.hpp"

namespace lekalo::nc {

/// A program whose arcs of G18 and G19 are chords.
struct Straightened {
  std::string text;
  /// For each line of the text, the line of the program that it comes from.
  std::vector<std::size_t> lines;
  double chord_mm = 0;  ///< no chord is further than this from its arc
  std::size_t arcs = 0;
};

/// Step 4 of docs/design/nc-rewrite.md: writes each arc outside the XY plane as lines in its place, and every
/// G18 and G19 as G17. The ends of the arcs stay the same points, to the last digit.
/// \pre interpretation has such an arc
[[nodiscard]] Result<Straightened> straighten(std::string_view text, const std::string& name,
                                              const Program& program, const Interpretation& interpretation,
                                              double tolerance_mm);

}  // namespace lekalo::nc
