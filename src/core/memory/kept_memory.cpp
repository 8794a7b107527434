// Keeps freed memory for later frames.
#include "core/memory/kept_memory.h"

#include <cstdlib>
#include <cstring>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace barehand {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kKept = 64 << 20, kReserve = 24 << 20;  // [bytes]
  constexpr int kLargestBlock = 32 << 20;               // largest block on the heap, the most that is allowed [bytes]
  mallopt(M_ARENA_MAX, 1);                              // one heap for all threads
  mallopt(M_MMAP_THRESHOLD, kLargestBlock);
  mallopt(M_TRIM_THRESHOLD, kKept);

  // Have the kernel provide the reserve.
  void* const block = std::malloc(kReserve);
  if (!block) return;
  std::memset(block, 1, kReserve);
  asm volatile("" : : "r"(block) : "memory");  // so that the compiler does not leave it out
  std::free(block);
#endif
}

}  // namespace barehand
