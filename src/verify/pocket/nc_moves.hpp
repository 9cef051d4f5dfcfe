#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"
#include "stroke.hpp"

namespace lekalo::verify {

/// One motion of the tool's tip, straight or along a helix about an axis of z, in mm.
struct Move {
  bool rapid = false, arc = false, ccw = true;
  Place from, to, centre;
  double from_z = 0, to_z = 0;
  /// An arc turns by less than turns * 360 degrees and at least (turns - 1) * 360.
  int turns = 1;
  double feed = 0;  ///< mm/min; 0 for a rapid
  std::size_t line = 0;
};

/// Reads the motions of an NC program in the XY plane as LinuxCNC's interpreter moves, from the words of
/// nc_words.hpp. The place before the first motion is not known. A program begins where its first words for
/// X, Y and Z lead, and the rapids before all three are given are no motions.
///
/// bad_input with the line for words that are not known or do not fit together, a tool change after the first
/// cut, offsets changed where the place is known, and all that would cut from a place that is not known.
/// \param top  the Z of the stock's upper face, mm; what goes below may cut
[[nodiscard]] Result<std::vector<Move>> read_moves(const Document& program, double top);

}  // namespace lekalo::verify
