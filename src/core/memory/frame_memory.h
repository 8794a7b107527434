#pragma once

#include <cstddef>
#include <memory_resource>
#include <type_traits>
#include <vector>

namespace barehand {

/// Memory for the results that frames carry from stage to stage. Memory that the last owner frees, on any thread, is
/// reused for a later frame, so that a running stream allocates nothing from the heap. It lives as long as the process.
std::pmr::memory_resource& frame_memory();

/// Allocator over frame_memory(). Throws std::bad_alloc.
template <typename T>
struct FrameAllocator {
  using value_type = T;
  using is_always_equal = std::true_type;

  FrameAllocator() = default;
  template <typename U>
  FrameAllocator(const FrameAllocator<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(frame_memory().allocate(count * sizeof(T), alignof(T))); }
  void deallocate(T* block, std::size_t count) { frame_memory().deallocate(block, count * sizeof(T), alignof(T)); }
  bool operator==(const FrameAllocator&) const { return true; }
};

template <typename T>
using FrameVector = std::vector<T, FrameAllocator<T>>;

}  // namespace barehand
