#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/nc_words.hpp"
#include "lekalo/verify/verify.hpp"
#include "stroke.hpp"

namespace lekalo::verify {

/// One motion of the tool's tip, straight or along a helix about an axis of z, in mm.
struct Move {
  bool rapid = false, arc = false, ccw = true;
  Place from, to, centre;
  double from_z = 0, to_z = 0;
  /// False where the program has not said that Z, which a program that is not judged may leave open.
  bool from_z_said = true, to_z_said = true;
  /// An arc turns by less than turns * 360 degrees and at least (turns - 1) * 360.
  int turns = 1;
  double feed = 0;  ///< mm/min; 0 for a rapid
  std::size_t line{};
};

/// Reads the motions of an NC program as the control moves, from the words that it knows (base/nc_words.hpp).
/// Canned cycles are read as the moves that LinuxCNC makes of them, and arcs of G18 and G19 as chords within
/// 1e-4 mm. The place before the first motion is not known. A program begins where its first words for X, Y
/// and Z lead, and the rapids before all three are given are no motions; nor are those to points of the
/// machine (G28, G30, G53), after which Z is not known.
///
/// bad_input with the line for words that are not known, do not fit together or make a path that the program
/// does not say (G41, G42), a tool change after the first cut, offsets changed where the place is known, and
/// all that would cut from a place that is not known.
/// \param top  the Z of the stock's upper face, mm; what goes below may cut
[[nodiscard]] Result<std::vector<Move>> read_moves(const Document& program, double top,
                                                   words::Control control = words::Control::linuxcnc);

}  // namespace lekalo::verify
