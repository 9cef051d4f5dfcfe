#pragma once

#include <deque>
#include <optional>

namespace lekalo::server {

/// Estimates how long something still takes, from how far it was when: by its latest pace (2 s, or a quarter
/// of all its time where that is more), so that a slow end is not promised to be as quick as the beginning,
/// and nothing is said where nothing moves.
class TimeLeft {
 public:
  /// \param at seconds of any clock, never less than before \param fraction in [0, 1]
  void take(double at, double fraction);
  /// Seconds; none: nobody can tell.
  [[nodiscard]] std::optional<double> seconds() const noexcept { return seconds_; }

 private:
  struct Sample {
    double at = 0, fraction = 0;
  };
  std::deque<Sample> samples_;
  std::optional<double> begun_, seconds_;
};

}  // namespace lekalo::server
