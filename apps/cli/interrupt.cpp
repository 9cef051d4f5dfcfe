#include "interrupt.hpp"

#include <fmt/core.h>
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace lekalo::cli {
namespace {

// A signal handler reaches nothing but globals.
std::atomic<bool> stop_flag{false}, interrupt_flag{false};
std::chrono::steady_clock::time_point began;
static_assert(std::atomic<bool>::is_always_lock_free, "the flag is set in a signal handler");

void request_stop(int signal_number) {
  if (signal_number != SIGALRM) interrupt_flag.store(true, std::memory_order_relaxed);
  stop_flag.store(true, std::memory_order_relaxed);
}

void handle(int signal_number) {
  struct sigaction action {};
  action.sa_handler = request_stop;
  sigemptyset(&action.sa_mask);
  // Once only: the second Ctrl-C finds the default action.
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigaction(signal_number, &action, nullptr);
}

void start_timer(double seconds) {
  const double whole = std::floor(seconds);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - whole) * 1e6);
  if (timer.it_value.tv_sec == 0 && timer.it_value.tv_usec == 0) timer.it_value.tv_usec = 1;
  setitimer(ITIMER_REAL, &timer, nullptr);
}

constexpr auto kQuietTime = std::chrono::seconds(1);
constexpr auto kBetweenLines = std::chrono::milliseconds(250);

}  // namespace

StopRequests::StopRequests() {
  began = std::chrono::steady_clock::now();
  stop_flag.store(false), interrupt_flag.store(false);
  handle(SIGINT);
  handle(SIGTERM);
}

StopRequests::~StopRequests() {
  itimerval none{};
  setitimer(ITIMER_REAL, &none, nullptr);
}

const std::atomic<bool>* StopRequests::flag() noexcept { return &stop_flag; }

const std::atomic<bool>* StopRequests::interrupt() noexcept { return &interrupt_flag; }

void StopRequests::end_at(double seconds) noexcept {
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - began;
  handle(SIGALRM);
  stop_flag.store(false);
  // A Ctrl-C between the two lines sets it again.
  if (interrupt_flag.load()) stop_flag.store(true);
  if (seconds > passed.count())
    start_timer(seconds - passed.count());
  else
    stop_flag.store(true);
}

ToTheEnd::ToTheEnd() {
  if (stop_flag.load(std::memory_order_relaxed)) listening_.emplace(nobody_);
}

ProgressLine::ProgressLine(std::string what, std::string note, bool quiet_at_first)
    : what_(std::move(what)),
      note_(std::move(note)),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      next_(quiet_at_first ? start_ + kQuietTime : start_) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

void ProgressLine::show(const Progress& progress, const std::string& says) {
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kBetweenLines;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::string line = fmt::format("\r\x1b[K{}: {:.0f} %", what_, 100 * progress.fraction) + says;
  if (progress.fraction > 0.01) {
    line += fmt::format(", about {:.0f} s left", seconds * (1 - progress.fraction) / progress.fraction);
  }
  line += " (" + note_ + ")";
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  shown_ = true;
}

jobs::PhaseListener progress_lines() {
  return [](const char* phase) -> ProgressListener {
    // Who has asked for the stop is told at once what he waits for.
    const bool stopped = stop_flag.load(std::memory_order_relaxed);
    const auto line = std::make_shared<ProgressLine>(
        phase,
        stopped ? "another Ctrl-C ends it, and nothing is written" : "Ctrl-C ends it, nothing is written",
        !stopped);
    return [line](const Progress& progress) { line->show(progress); };
  };
}

}  // namespace lekalo::cli
