#pragma once

#include <ctime>

namespace lekalo::cases {

/// The bounds of tests that measure time hold for programs without sanitizers; with one everything may take so many
/// times as long.
#if defined(LEKALO_SANITIZE_ADDRESS) || defined(LEKALO_SANITIZE_THREAD)
inline constexpr double kSlowdown = 10;
#else
inline constexpr double kSlowdown = 1;
#endif

/// Processor time of the test since the watch was made. A machine that does other things as well makes the time of
/// day pass, not this one.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return static_cast<double>(std::clock() - start_) / static_cast<double>(CLOCKS_PER_SEC);
  }

 private:
  std::clock_t start_ = std::clock();
};

}  // namespace lekalo::cases
