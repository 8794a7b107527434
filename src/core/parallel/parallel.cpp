// Runs loops and background tasks on a limited number of threads.
#include "core/parallel/parallel.h"

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <thread>

#include "core/parallel/tbb_arena.h"

namespace barehand {
namespace {

/// One call of run(). TBB synchronises its threads, but inside a library that the thread sanitizer cannot see. The two
/// atomics express the same ordering in code that the sanitizer sees.
template <typename Call>
struct Job {
  const Call& fn;
  std::atomic<bool> started = false;
  std::atomic<int> finished = 0;

  struct Finish {
    Job& job;
    ~Finish() { job.finished.fetch_add(1, std::memory_order_release); }
  };
  static void run(void* self, int i) {
    Job& job = *static_cast<Job*>(self);
    [[maybe_unused]] const bool started = job.started.load(std::memory_order_acquire);
    const Finish finish{job};
    job.fn(i);
  }
};

}  // namespace

Workers::Workers(int threads) : threads_(threads) {
  assert(threads >= 1 && threads <= kMaxThreads);
  if (threads > 1) arena_ = std::make_unique<TbbArena>(threads);
}

Workers::~Workers() = default;

void Workers::run(int n, Call call) {
  // Run everything in the calling thread if there is nothing to distribute.
  if (!arena_ || n <= 1) {
    for (int i = 0; i < n; ++i) call(i);
    return;
  }

  // Order the caller's writes before the tasks, and the tasks' writes before the return (see Job).
  Job<Call> job{call};
  job.started.store(true, std::memory_order_release);
  const auto settle = [&] { [[maybe_unused]] const int finished = job.finished.load(std::memory_order_acquire); };

  try {
    arena_->for_each_index(n, &Job<Call>::run, &job);
  } catch (...) {
    settle();
    throw;
  }
  settle();
}

void Workers::give_way() {
  constexpr int kLast = 19;  // nice value of the lowest priority; on Linux every thread has its own nice value
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kLast);
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
