#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "lekalo/base/run_control.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/jobs/phases.hpp"

namespace lekalo::cli {

/// Turns Ctrl-C (and SIGTERM) and a time limit into a stop flag, as long as a command runs. The first Ctrl-C
/// asks for the best so far, or for nothing where there is none, the second ends the program as usual. At
/// most one lives at a time.
class StopRequests {
 public:
  StopRequests();
  ~StopRequests();
  StopRequests(const StopRequests&) = delete;
  StopRequests& operator=(const StopRequests&) = delete;
  [[nodiscard]] static const std::atomic<bool>* flag() noexcept;
  /// Set by Ctrl-C and SIGTERM alone, with the flag.
  [[nodiscard]] static const std::atomic<bool>* interrupt() noexcept;
  /// Lets the flag be set by itself so long after this object was made, s; at once where that is past. `nest`
  /// says so when all is read, because before that a time limit would leave nothing. It may be said again: a
  /// flag that only the time before has set is taken back.
  static void end_at(double seconds) noexcept;
};

/// While this lives, nothing is stopped that was not to be stopped before: what a search has found until a
/// stop is written, drawn and told to the end.
class ToTheEnd {
 public:
  ToTheEnd();

 private:
  RunControl nobody_;
  std::optional<Listening> listening_;
};

/// A line on stderr with the time left, where stderr is a terminal: for work of more than a second, as a
/// rule.
class ProgressLine {
 public:
  /// \param note  ends the line: what a Ctrl-C does
  /// \param quiet_at_first  not shown in the first second
  explicit ProgressLine(std::string what, std::string note = "Ctrl-C stops with the best so far",
                        bool quiet_at_first = true);
  ~ProgressLine();  ///< wipes the line
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  /// \param says  goes between the share done and the time left; may be empty
  void show(const Progress& progress, const std::string& says = {});

 private:
  std::string what_, note_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_, next_;
  bool shown_ = false;
};

/// A progress line for each phase of a job that a Ctrl-C ends, with nothing written.
[[nodiscard]] jobs::PhaseListener progress_lines();

}  // namespace lekalo::cli
