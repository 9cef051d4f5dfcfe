#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/run_control.hpp"
#include "lekalo/layout/command.hpp"

namespace lekalo::server {

/// A job is work of more than a moment. It runs on a thread of its own and on a copy of the document, so that
/// the layout stays open for everyone. What the job finds is carried out at the end, as one command, if that
/// is still possible.

/// The things that a job gets beside the document: its stop flag and listener, and a function that takes
/// better layouts.
struct JobContext {
  /// When this stops the job, the job gives the best it has.
  RunControl run;
  /// Takes a layout that is better than any before, as the change that leads to it from the document. May be
  /// empty.
  std::function<void(const layout::Change&)> improved;
};
using Job = std::function<Result<layout::Change>(const layout::Document&, const JobContext&)>;

/// Returns the job that carries out a command; none for commands that take only a moment.
[[nodiscard]] std::optional<Job> job_of(const layout::Command& command, layout::Mode mode);

using JobNumber = std::uint64_t;

/// A job that is to be run, and everything it needs for that.
struct JobStart {
  JobNumber number = 0;
  Job job;
  layout::Document document;
  std::shared_ptr<std::atomic<bool>> stop;
};

}  // namespace lekalo::server
