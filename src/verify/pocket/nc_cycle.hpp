#pragma once

#include <vector>

namespace lekalo::verify {

/// A canned cycle as its words and the ones before say it, in mm.
struct NcCycle {
  int tenths = 0;    ///< of its G word, 730 to 890
  double low = 0;    ///< the Z of the bottom
  double high = 0;   ///< the Z of the plane R
  double clear = 0;  ///< the Z to which it goes back
  double peck = 0;   ///< Q
};

/// A way straight down or up in a hole.
struct NcPlunge {
  bool rapid = false;
  double to_z = 0;
};

/// The ways of one hole, from the plane R on, as LinuxCNC makes them.
[[nodiscard]] std::vector<NcPlunge> plunges_of(const NcCycle& cycle);

}  // namespace lekalo::verify
