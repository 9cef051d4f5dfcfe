#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "lekalo/base/run_control.hpp"

namespace lekalo {

/// One stop for everything long (docs/design/stop.md). Whoever starts a job says with `stoppable` which
/// RunControl may end it; every loop that an input can make long calls `ask` once a round, however deep it
/// lies, and need not be told whose job it works for. Where the job is to end, `ask` throws this, and
/// everything is taken down as when memory ends. Nobody catches it but `stoppable`, and searches that keep
/// their best so far.
class Stopped final : public std::exception {
 public:
  /// Somebody asked for it.
  Stopped() : says_("stopped before there was anything to show; nothing was written") {}
  /// All the steps that the job was given are used up.
  explicit Stopped(std::uint64_t work_limit);

  /// One sentence for the user.
  [[nodiscard]] const char* what() const noexcept override { return says_.c_str(); }
  [[nodiscard]] bool out_of_work() const noexcept { return out_of_work_; }

 private:
  std::string says_;
  bool out_of_work_ = false;
};

/// While this lives, `ask` on this thread, and on those that share_out starts from it, listens to one control
/// and to none that it listened to before: to its flag, and to its work limit, whose unit is the step. With
/// an empty control nobody stops what has to be done to the end.
class Listening {
 public:
  /// \param run  outlives this
  explicit Listening(const RunControl& run) noexcept;
  /// For share_out: this thread listens as the thread does that this is given from. \pre that one waits
  explicit Listening(Listening* other) noexcept;
  ~Listening();
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

  /// Whom this thread listens to; null where to nobody.
  [[nodiscard]] static Listening* now() noexcept;
  /// Counts the steps of this thread so far, and throws Stopped where the job is to end.
  static void look();

 private:
  const RunControl* run_ = nullptr;
  std::atomic<std::uint64_t> steps_{0};
  Listening* before_;
  std::int64_t before_left_, before_granted_;
};

namespace stop_detail {
/// Steps of this thread until it looks at its control.
extern constinit thread_local std::int64_t steps_left;
}  // namespace stop_detail

/// Says that steps of work are done, each about a microsecond or less, and throws Stopped where the job is to
/// end. It costs a subtraction: the control is looked at every few thousand steps.
///
/// A build without exceptions, as that of the page's kernel, has nobody who could stop it.
inline void ask([[maybe_unused]] std::uint64_t steps = 1) {
#ifdef __cpp_exceptions
  stop_detail::steps_left -= static_cast<std::int64_t>(steps);
  if (stop_detail::steps_left < 0) [[unlikely]]
    Listening::look();
#endif
}

#ifdef __cpp_exceptions
/// Does a job that the control may end: what `work` returns, or Stopped.
template <class Work>
auto stoppable(const RunControl& run, Work&& work) -> tl::expected<decltype(work()), Stopped> {
  const Listening listening(run);
  try {
    Listening::look();
    return std::forward<Work>(work)();
  } catch (const Stopped& stopped) {
    return tl::unexpected<Stopped>(stopped);
  }
}
#endif

}  // namespace lekalo
