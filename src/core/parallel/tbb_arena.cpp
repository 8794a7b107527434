#include "core/parallel/tbb_arena.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace barehand {

struct TbbArena::State {
  explicit State(int threads) : limit(tbb::global_control::max_allowed_parallelism, threads), arena(threads) {}
  tbb::global_control limit;  // allows more threads than cores, which TBB does not by default
  tbb::task_arena arena;
};

TbbArena::TbbArena(int threads) : state_(std::make_unique<State>(threads)) {}
TbbArena::~TbbArena() = default;

void TbbArena::for_each_index(int n, void (*call)(void* context, int i), void* context) {
  // Isolation keeps a thread that waits here from starting work of another stage, which would delay its own stage.
  state_->arena.execute(
      [&] { tbb::this_task_arena::isolate([&] { tbb::parallel_for(0, n, [&](int i) { call(context, i); }); }); });
}

}  // namespace barehand
