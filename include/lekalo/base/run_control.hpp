#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>

namespace lekalo {

/// How far a long piece of work is. `fraction` is in [0, 1]; it never decreases within one run.
struct Progress {
  std::uint64_t work = 0;  ///< units done, of the unit the algorithm states
  double fraction = 0;
};

/// Called from the computing thread.
using ProgressListener = std::function<void(const Progress&)>;

/// Everything a long computation needs from outside: a stop flag, a listener, and a budget counted in units
/// of work. A result depends on the budget, never on a clock; a clock may only set the stop flag.
struct RunControl {
  const std::atomic<bool>* stop = nullptr;  ///< looked at often; set it from any thread or a signal handler
  ProgressListener progress;                ///< may be empty
  std::uint64_t work_limit = std::numeric_limits<std::uint64_t>::max();

  [[nodiscard]] bool stop_requested() const noexcept {
    return stop != nullptr && stop->load(std::memory_order_relaxed);
  }
};

}  // namespace lekalo
