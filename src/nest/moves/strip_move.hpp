#pragma once

#include "move.hpp"

namespace lekalo::nest {

/// The moves on a strip share this: how overlaps are ended there, and how the strip gets shorter.
/// docs/design/nest.md, steps 4 to 7.
class StripMove : public Move {
 public:
  /// Relaxes at first, then does a pass, and relaxes again where that may end the overlaps.
  Outcome step(Search& search) final;

 protected:
  virtual Patience patience(const Search& search) const = 0;
  /// True if relaxing ends the overlaps, maybe in a little more length that is still a gain.
  virtual bool fits_wider(Search& search);

  void begin_separation(Search& search);
  /// Asks for a strip that is shorter than the best by a share of its length. What lies beyond the middle,
  /// or beyond a place chosen by chance, moves along.
  Outcome shorten(Search& search, double share, bool at_random);
  /// Makes the valid state in the separator the best if it is better, and pushes it together.
  bool take(Search& search);
  /// Pushes the best together as far as that goes without another arrangement.
  static void compact(Search& search);

 private:
  int passes_ = 0, relax_after_ = 0;
};

}  // namespace lekalo::nest
