#pragma once

#include <vector>

#include "search.hpp"

namespace lekalo::nest {

/// States of attempts that failed, from which another arrangement is tried. docs/design/nest.md, step 6.
class FailedStates {
 public:
  std::size_t count() const noexcept { return states_.size(); }
  void clear() { states_.clear(); }
  /// Remembers the least state of the attempt; the oldest one is forgotten where there are more than so
  /// many.
  void add(const Attempt& attempt, std::size_t most);
  /// Loads one of the better states and lets two large items change places in it, with what lies in them.
  void load_disrupted(Search& search);

 private:
  struct Failed {
    State state;
    double overlap;
  };
  std::vector<Failed> states_;
};

}  // namespace lekalo::nest
