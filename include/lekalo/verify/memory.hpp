#pragma once

namespace lekalo::verify {

/// GMP, and MPFR on it, ends the process when memory ends; after this call both throw std::bad_alloc like
/// everything else. It changes the whole process, so a program calls it, once and before the first number; no
/// function of the library does.
void let_numbers_throw_bad_alloc();

}  // namespace lekalo::verify
