#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace lekalo {

/// The stable code of a failure. Each code has one exit status of the command line (see exit_status).
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

/// Passes an error on: `LEKALO_TRY(const auto region, read_region(file));` defines `region` as the value of
/// what `read_region` returns, or leaves the function with its error. The first argument is a declaration or
/// something that can be assigned to; the second any `tl::expected`. It stands for several statements, so an
/// unbraced `if` before it does not compile. No structured binding: name the value, then take it apart.
#define LEKALO_TRY(target, ...) LEKALO_TRY_AS(LEKALO_JOIN(lekalo_tried_, __LINE__), target, (__VA_ARGS__))

/// Passes the error of a call on whose value nobody needs: `LEKALO_CHECK(write_file(path, text));` leaves the
/// function with the error if there is one. One statement.
#define LEKALO_CHECK(...)                                                                      \
  do {                                                                                         \
    if (auto&& lekalo_checked = (__VA_ARGS__); !lekalo_checked)                                \
      return ::tl::unexpected(std::forward<decltype(lekalo_checked)>(lekalo_checked).error()); \
  } while (false)

#define LEKALO_TRY_AS(tried, target, expression)                 \
  auto tried = expression;                                       \
  if (!tried) return ::tl::unexpected(std::move(tried).error()); \
  target = *std::move(tried)
#define LEKALO_JOIN(a, b) LEKALO_JOIN_EXPANDED(a, b)
#define LEKALO_JOIN_EXPANDED(a, b) a##b
