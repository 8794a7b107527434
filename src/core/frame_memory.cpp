#include "core/frame_memory.h"

namespace barehand {

std::pmr::memory_resource& frame_memory() {
  constexpr std::size_t kLargest = 1 << 16;  // an estimate has 8 kB; images keep their memory by themselves
  // Never destroyed: a result may be let go by a thread that ends after the statics do.
  static auto& memory = *new std::pmr::synchronized_pool_resource({.largest_required_pool_block = kLargest});
  return memory;
}

}  // namespace barehand
