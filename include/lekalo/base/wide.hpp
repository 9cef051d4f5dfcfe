#pragma once

/// Before a function whose loops become vector instructions (no branch, no call, no order of sums that
/// matters): wider ones are taken where the processor has them, chosen when the program starts. They round
/// the same, as nothing is fused.
#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define LEKALO_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define LEKALO_WIDE
#endif
