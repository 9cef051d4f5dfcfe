#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/nc_words.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/pocket/stroke.hpp"
#include "verify/pocket/unsaid_modes.hpp"

namespace lekalo::verify {

/// A cut of a profile program without a lift or the beam off: lines and arcs one after the other, mm.
struct CutChain {
  std::vector<Stroke> edges;  ///< an arc may have any sweep below a full turn
  std::size_t line = 0;       ///< of the program, where the cut begins
  bool rapid = false;         ///< true where G0 cuts
  double depth = 0;           ///< below Z 0, mm; 0 in programs without Z
  int tool = 0;               ///< the number of the tool; 0 before the first change
};

struct ProfileProgram {
  std::vector<CutChain> chains;
  /// A profile program that lekalo writes for this control says all modes before its first motion.
  UnsaidModes unsaid;
};

/// Reads the cuts of a profile program as lekalo writes it: the beam or spindle is on, and the tool is below
/// Z 0 where the program has a Z. A block that only moves in Z begins another chain. Where a tool is changed
/// the spindle stands still, the length of the tool is taken next, and then it is lifted.
///
/// bad_input with the line for every word that lekalo does not write into such a program, and for cuts that
/// begin at a place that is not known. Cost: O(bytes).
[[nodiscard]] Result<ProfileProgram> read_profile(const Document& program, words::Control control);

}  // namespace lekalo::verify
