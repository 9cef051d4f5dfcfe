#pragma once

#include "nest/separator/separator.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {

/// One attempt to end all overlaps: it remembers the state with the least overlap and says whether it is
/// worth going on.
class Attempt {
 public:
  enum class Next { on, from_least, stuck };

  void begin(double overlap, const State& state) {
    least_overlap_ = strike_overlap_ = overlap;
    least_ = state;
    without_gain_ = strikes_ = 0;
  }
  Next after_pass(double overlap, const State& state, Patience patience) {
    if (overlap < 0.98 * strike_overlap_) {
      strike_overlap_ = overlap;
      without_gain_ = 0;
    } else {
      ++without_gain_;
    }
    if (overlap < least_overlap_) {
      least_overlap_ = overlap;
      least_ = state;
    }
    if (without_gain_ < patience.passes) return Next::on;
    without_gain_ = 0;
    strike_overlap_ = least_overlap_;
    return ++strikes_ >= patience.strikes ? Next::stuck : Next::from_least;
  }

  const State& least() const noexcept { return least_; }
  double least_overlap() const noexcept { return least_overlap_; }

 private:
  State least_;
  double least_overlap_ = 0, strike_overlap_ = 0;
  int without_gain_ = 0, strikes_ = 0;
};

}  // namespace lekalo::nest
