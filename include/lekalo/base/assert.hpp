#pragma once

namespace lekalo::detail {
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line) noexcept;
}

/// Our own mistakes only; user data never reaches it. Stays on in release builds: a wrong cut costs more
/// than a comparison.
#define LEKALO_ASSERT(expression) \
  ((expression) ? static_cast<void>(0) : ::lekalo::detail::assertion_failed(#expression, __FILE__, __LINE__))
