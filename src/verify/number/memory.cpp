#include "lekalo/verify/memory.hpp"

#include <gmp.h>

#include <cstdlib>
#include <new>

namespace lekalo::verify {
namespace {

void* or_throw(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void* make(std::size_t size) { return or_throw(std::malloc(size)); }
void* resize(void* block, std::size_t /*old_size*/, std::size_t size) {
  return or_throw(std::realloc(block, size));
}
void release(void* block, std::size_t /*size*/) { std::free(block); }

}  // namespace

// Both libraries are C, compiled with tables for unwinding as everything on Linux is; an exception passes.
void let_numbers_throw_bad_alloc() { mp_set_memory_functions(make, resize, release); }

}  // namespace lekalo::verify
