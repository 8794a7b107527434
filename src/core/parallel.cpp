#include "core/parallel.h"

#include <sched.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <thread>

namespace barehand {

struct Workers::Arena {
  explicit Arena(int threads) : limit(tbb::global_control::max_allowed_parallelism, threads), arena(threads) {}
  tbb::global_control limit;  // or TBB would never use more threads than there are cores
  tbb::task_arena arena;
};

Workers::Workers(int threads) : threads_(threads) {
  assert(threads >= 1 && threads <= kMaxThreads);
  if (threads > 1) arena_ = std::make_unique<Arena>(threads);
}

Workers::~Workers() = default;

void Workers::for_each_index(int n, const std::function<void(int)>& fn) {
  if (!arena_ || n <= 1) {
    for (int i = 0; i < n; ++i) fn(i);
    return;
  }
  // Isolated: a thread that waits here takes no work of another stage, which would hold up its own.
  arena_->arena.execute(
      [&] { tbb::this_task_arena::isolate([&] { tbb::parallel_for(0, n, [&](int i) { fn(i); }); }); });
}

Result<std::unique_ptr<Workers>> make_workers(int threads) {
  if (threads < 1 || threads > Workers::kMaxThreads)
    return fail("number of threads is " + std::to_string(threads), "threads",
                "give 1 to " + std::to_string(Workers::kMaxThreads) + "; this machine has " +
                    std::to_string(available_cores()) + " cores");
  return std::make_unique<Workers>(threads);
}

int available_cores() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
  return std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace barehand
