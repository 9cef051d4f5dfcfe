#include "lekalo/base/stop.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lekalo {
namespace {

/// A look takes some nanoseconds, and a step a microsecond at the most: looks come every few milliseconds and
/// take less than a hundredth of the time of the quickest steps.
constexpr std::int64_t kBetweenLooks = 2048;

constinit thread_local Listening* listening = nullptr;
/// The steps that were left after the last look.
constinit thread_local std::int64_t granted = 0;

std::uint64_t steps_since_last_look() {
  return static_cast<std::uint64_t>(granted - stop_detail::steps_left);
}

}  // namespace

constinit thread_local std::int64_t stop_detail::steps_left = 0;

Stopped::Stopped(std::uint64_t work_limit)
    : says_(fmt::format("this takes more than {} steps of work; --work allows more, nothing was written", work_limit)),
      out_of_work_(true) {}

Listening::Listening(const RunControl& run) noexcept : Listening(this) { run_ = &run; }

Listening::Listening(Listening* other) noexcept
    : before_(listening), before_left_(stop_detail::steps_left), before_granted_(granted) {
  listening = other;
  granted = stop_detail::steps_left = 0;
}

Listening::~Listening() {
  if (listening != nullptr && listening != this)
    listening->steps_.fetch_add(steps_since_last_look(), std::memory_order_relaxed);
  listening = before_;
  stop_detail::steps_left = before_left_;
  granted = before_granted_;
}

Listening* Listening::now() noexcept { return listening; }

void Listening::look() {
  const std::uint64_t steps = steps_since_last_look();
  granted = stop_detail::steps_left = kBetweenLooks;
  if (listening == nullptr) return;
  const RunControl& run = *listening->run_;
  const std::uint64_t done = listening->steps_.fetch_add(steps, std::memory_order_relaxed) + steps;
  if (run.stop_requested()) throw Stopped();
  if (done > run.work_limit) throw Stopped(run.work_limit);
  granted = stop_detail::steps_left =
      static_cast<std::int64_t>(std::min<std::uint64_t>(kBetweenLooks, run.work_limit - done));
}

}  // namespace lekalo
