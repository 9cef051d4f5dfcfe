#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace lekalo {

/// What went wrong, as a stable code. Each code has one exit status of the command line (see exit_status).
enum class ErrorCode {
  usage,            ///< the caller asked for something that does not exist or contradicts itself
  bad_input,        ///< a file or value is not what it should be
  program_refused,  ///< an NC program holds a word that cannot be rewritten safely
  refuted,          ///< a check found that a result is not true
  environment,      ///< disk, permissions, a missing optional component
};

/// A failure the caller can foresee: the code, and one sentence that names file, place, number and way out.
struct Error {
  ErrorCode code{};
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

[[nodiscard]] inline tl::unexpected<Error> failure(ErrorCode code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message)});
}

/// Exit status of the command line for an error: 2 usage, 3 bad input or refused program, 4 refuted,
/// 5 environment. (0 is a result, 1 a valid answer "no"; neither is an error.)
[[nodiscard]] constexpr int exit_status(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::usage:
      return 2;
    case ErrorCode::bad_input:
    case ErrorCode::program_refused:
      return 3;
    case ErrorCode::refuted:
      return 4;
    case ErrorCode::environment:
      return 5;
  }
  return 5;
}

}  // namespace lekalo
