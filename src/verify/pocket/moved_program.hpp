#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/nc_words.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {

/// The claim of a result about the program that it wrote: the original, moved by the placement.
struct ProgramClaim {
  const Document& original;
  const Document& written;
  /// The placement p -> R(theta) p + (x, y), mm.
  Decimal x, y, theta;
  /// No programmed point lies further than this from its exact place, mm.
  Decimal rounding;
  std::string mode;  ///< "coordinates", "offset" or "g68"
  std::size_t work_offset = 1;
  /// The control in whose language both programs are, and the M words that the shop allows.
  words::Control control = words::Control::linuxcnc;
  std::vector<int> allowed_m = {};
  /// The placement of a solid also shifts by `z`, and its turn about Z is that of the quaternion
  /// [w, 0, 0, z] in place of theta.
  struct Solid {
    Decimal z;
    std::array<Decimal, 2> turn;  ///< w and z, not both 0
  };
  std::optional<Solid> solid = {};
};

/// A fault is a reason to refuse, an open question one to say so; with neither the claim is confirmed.
struct ProgramVerdict {
  std::optional<std::string> fault, open;
};

/// Reads both programs with the checker's own reader (nc_program.hpp), which computes expressions and follows
/// subprograms, and compares them motion by motion, and all that is no place of X and Y word by word. Arcs of
/// G18 and G19 may have become chords, and comments and numbers of blocks do not count. Programs that this
/// reader does not understand stay open.
[[nodiscard]] ProgramVerdict check_moved_program(const ProgramClaim& claim);

}  // namespace lekalo::verify
