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

/// Reads the motions of an NC program: G0 to G3 in the XY plane, G20/G21, G90/G91, centres as I J (either
/// way) or R, full turns as P. The place before the first motion is not known. A program begins where its
/// first words for X, Y and Z lead, and motion before all three are given is no motion.
///
/// bad_input with the line for everything else that moves or changes where things are.
[[nodiscard]] Result<std::vector<Move>> read_moves(const Document& program);

}  // namespace lekalo::verify
