#pragma once

#include <cmath>

namespace lekalo {

/// Returns with how many decimals a program writes a feed: the usual ones, and as many more as a slow feed
/// needs to be written within 1 % of what it is, so that none becomes F0.00. \param feed  0 or more, in the
/// unit of the program Cost: one step for each decimal; a feed has 17 at most.
[[nodiscard]] inline int feed_decimals(double feed, int usual) noexcept {
  constexpr double kOff = 0.01;
  constexpr int kMost = 17;
  int decimals = usual;
  double scale = std::pow(10.0, usual);
  for (; decimals < kMost && std::abs(std::round(feed * scale) - feed * scale) > kOff * feed * scale;
       ++decimals)
    scale *= 10;
  return decimals;
}

}  // namespace lekalo
