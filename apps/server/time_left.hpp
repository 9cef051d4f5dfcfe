#pragma once

#include <deque>
#include <optional>

namespace lekalo::server {

/// Estimates how long a piece of work still takes, from how far it was at which time. The latest pace counts
/// (that of 2 s, or of a quarter of all its time where that is more). So a slow end is not promised to be as
/// quick as the beginning, and nothing is said where nothing moves.
class TimeLeft {
 public:
  /// Takes a new state of the work.
  /// \param at  seconds of any clock, never less than before
  /// \param fraction  in [0, 1]
  void take(double at, double fraction);
  /// Returns the seconds that are left; none where nobody can tell.
  [[nodiscard]] std::optional<double> seconds() const noexcept { return seconds_; }

 private:
  struct Sample {
    double at = 0, fraction = 0;
  };
  std::deque<Sample> samples_;
  std::optional<double> begun_, seconds_;
};

}  // namespace lekalo::server
