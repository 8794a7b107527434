#include "core/memory/kept_memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstring>
#include <memory>
#include <thread>

namespace barehand {
namespace {

/// Number of pages that the kernel has provided to this process so far.
long provided_pages() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

/// Writes to several blocks as large as images, in a thread of its own, and frees them.
void use_images() {
  std::jthread([] {
    constexpr std::size_t kImage = 640 * 480 * 4;
    std::unique_ptr<char[]> images[8];
    for (auto& image : images) {
      image.reset(new char[kImage]);
      std::memset(image.get(), 1, kImage);
    }
  }).join();
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(KeptMemory, ThreadsReuseWhatIsReserved) {
  keep_freed_memory();
  const long before = provided_pages();
  for (int i = 0; i < 3; ++i) use_images();
  const long pages_of_images = 8 * 640 * 480 * 4 / sysconf(_SC_PAGESIZE);
  EXPECT_LT(provided_pages() - before, pages_of_images / 10);
}
#endif

}  // namespace
}  // namespace barehand
