// In place of src/base/assert.cpp: there is no stderr in a page.

#include <cstdint>

#include "lekalo/base/assert.hpp"

extern "C" {
/// "expression (file:line)" of our own mistake; the instance is of no use after it.
__attribute__((import_module("lekalo"), import_name("broken"))) void lekalo_broken(const char* expression,
                                                                                   const char* file,
                                                                                   std::int32_t line);
}

namespace lekalo::detail {

void assertion_failed(const char* expression, const char* file, int line) noexcept {
  lekalo_broken(expression, file, line);
  __builtin_trap();
}

}  // namespace lekalo::detail
