#pragma once

/// Marks a function with hot loops. It is compiled again for processors with AVX-512 (x86-64-v4), and the right version
/// is chosen at program start. Since sums are then formed in another order, results may differ in the last bits between
/// processors, but not between runs on one processor. With compilers other than GCC, and with the sanitizers, which do
/// not support the attribute, the function is compiled only once.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define BAREHAND_SIMD __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define BAREHAND_SIMD
#endif
