#pragma once

#include <memory>

namespace barehand {

/// Wraps the part of TBB that Barehand uses, in a file that is compiled without the thread sanitizer. TBB's templates
/// would be instrumented but its library is not, so every hand-over between them would look like a race.
class TbbArena {
 public:
  explicit TbbArena(int threads);
  ~TbbArena();
  /// Calls call(context, i) for every i in [0, n); rethrows exceptions.
  void for_each_index(int n, void (*call)(void* context, int i), void* context);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace barehand
