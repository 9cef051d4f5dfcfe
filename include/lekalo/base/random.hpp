#pragma once

#include <cstdint>

namespace lekalo {

/// Pseudo-random numbers that are the same on every machine and compiler (the standard library's
/// distributions are not). Never for secrets. Period 2^64.
///
/// Source: SplitMix64 (Steele, Lea and Flood 2014); the first outputs for seed 1234567 are checked against
/// the published ones in tests/unit/reference_random_test.cpp.
class Random {
 public:
  /// Generators with the same seed and different streams are unrelated: give every case or lane its own.
  explicit constexpr Random(std::uint64_t seed, std::uint64_t stream = 0) noexcept
      : state_(stream == 0 ? seed : mix(seed + kGolden * stream) + stream) {}

  /// All 64-bit values.
  constexpr std::uint64_t bits() noexcept { return mix(state_ += kGolden); }

  /// In [0, 1): a multiple of 2^-53.
  constexpr double uniform() noexcept { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// In [low, high], both finite with a finite difference; the ends by rounding only.
  constexpr double uniform(double low, double high) noexcept {
    const double value = low + (high - low) * uniform();
    return value < low ? low : value > high ? high : value;
  }

  /// In 0 .. count - 1, each as likely as any other; 0 for count 0.
  constexpr std::uint64_t below(std::uint64_t count) noexcept {
    if (count == 0) return 0;
    // The lowest 2^64 mod count outputs would make small results more likely.
    const std::uint64_t rejected = (0 - count) % count;
    std::uint64_t value = bits();
    while (value < rejected) value = bits();
    return value % count;
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;
  static constexpr std::uint64_t mix(std::uint64_t z) noexcept {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace lekalo
