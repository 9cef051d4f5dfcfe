#include "lekalo/base/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace lekalo::detail {

void assertion_failed(const char* expression, const char* file, int line) noexcept {
  std::fprintf(stderr, "lekalo: internal error: %s (%s:%d)\n", expression, file, line);
  std::abort();
}

}  // namespace lekalo::detail
