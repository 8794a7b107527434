#pragma once

#include <memory>

namespace barehand {

/// All that Barehand uses of TBB, in one file that is compiled without the thread sanitizer: TBB's templates would be
/// instrumented, its library is not, and every hand-over between them would look like a race.
class TbbArena {
 public:
  explicit TbbArena(int threads);
  ~TbbArena();
  /// call(context, i) for every i in [0, n); throws what it throws.
  void for_each_index(int n, void (*call)(void* context, int i), void* context);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace barehand
