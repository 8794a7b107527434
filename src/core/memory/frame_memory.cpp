#include "core/memory/frame_memory.h"

namespace barehand {

std::pmr::memory_resource& frame_memory() {
  constexpr std::size_t kLargest = 1 << 16;  // largest pooled block [bytes]; a result has 8 kB, images are not pooled
  // The pool is never destroyed, because a thread may release a result after static objects are destroyed.
  static auto& memory = *new std::pmr::synchronized_pool_resource({.largest_required_pool_block = kLargest});
  return memory;
}

}  // namespace barehand
