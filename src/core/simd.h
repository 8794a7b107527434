#pragma once

/// Before a function whose loops matter: it is compiled once more for processors with AVX-512 (x86-64-v4), and the
/// right version is chosen when the program starts. Sums are taken in another order then, so results differ in the last
/// bits between processors; never between runs on one. Compilers without the attribute, and the sanitizers, which do
/// not get along with it, use the instruction set of the build alone.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define BAREHAND_SIMD __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define BAREHAND_SIMD
#endif
