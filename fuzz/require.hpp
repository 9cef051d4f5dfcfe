#pragma once

#include <cstdlib>

/// Ends the program where what a fuzzed function promises does not hold, which is how a fuzzer hears of it.
inline void require(bool holds) {
  if (!holds) std::abort();
}
