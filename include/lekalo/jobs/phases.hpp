#pragma once

#include <functional>

#include "lekalo/base/run_control.hpp"

namespace lekalo::jobs {

/// Hears of the phases of a job. It is called as a phase begins, with the phase's name ("checking the
/// program"); what it returns hears how far that phase is and is destroyed when the phase ends. Both may be
/// empty. Everything happens in the thread that called the job.
using PhaseListener = std::function<ProgressListener(const char* phase)>;

/// Begins a phase and gives the listener to its progress, which is empty where nobody listens.
[[nodiscard]] inline ProgressListener begin_phase(const PhaseListener& phases, const char* phase) {
  return phases ? phases(phase) : ProgressListener{};
}

}  // namespace lekalo::jobs
