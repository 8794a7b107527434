#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/error.h"

namespace barehand {

class TbbArena;

/// Owns the cores that computation may use: stages distribute their work through it and start no threads of their own.
class Workers {
 public:
  static constexpr int kMaxThreads = 256;

  /// `threads` in [1, kMaxThreads] includes the calling thread; 1 runs everything inline. Use make_workers() for
  /// numbers from the user.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Calls fn(0) ... fn(n-1), each once, in any order and on any thread, and returns when all are done. The result is
  /// the same for any number of threads if fn(i) writes only data that belongs to i, and sums are formed afterwards in
  /// index order. Exceptions of fn are rethrown here. May be called from several threads, and from within fn.
  template <typename Fn>
  void for_each_index(int n, Fn&& fn) {
    run(n, {[](const void* f, int i) { (*static_cast<const std::remove_reference_t<Fn>*>(f))(i); }, &fn});
  }
  int threads() const { return threads_; }

  /// Runs long work (seconds) whose result no frame needs immediately: fn(Workers&), which may outlive this call but
  /// not `*this`. For a recording it is finished before this returns, so that results are the same on every machine.
  /// After go_live() it runs in the background with the lowest priority. Exceptions of fn are rethrown by the future's
  /// get().
  template <typename Fn>
  auto run_in_background(Fn fn) -> std::future<std::invoke_result_t<Fn&, Workers&>> {
    if (live_)
      return std::async(std::launch::async, [fn = std::move(fn)]() mutable {
        give_way();
        Workers alone(1);
        return fn(alone);
      });
    auto done = std::async(std::launch::deferred, [this, fn = std::move(fn)]() mutable { return fn(*this); });
    ++long_works_;
    done.wait();
    --long_works_;
    return done;
  }
  /// Whether run_in_background() is executing work for a recording now, and its caller waits. Any thread may ask.
  bool does_long_work() const { return long_works_ > 0; }
  /// Must be called when frames come from a live source, which long work must not delay (see run_in_background()).
  void go_live() { live_ = true; }

 private:
  /// A non-owning reference to a callable object; std::function would allocate memory for most lambdas.
  struct Call {
    void (*function)(const void* self, int i);
    const void* self;
    void operator()(int i) const { function(self, i); }
  };
  void run(int n, Call call);
  /// Gives the calling thread the lowest priority.
  static void give_way();

  int threads_;
  bool live_ = false;
  std::atomic<int> long_works_ = 0;  ///< number of calls of run_in_background() that wait for their work
  std::unique_ptr<TbbArena> arena_;  ///< null for one thread
};

/// Checks a number of threads from the user: it must be in [1, Workers::kMaxThreads].
Result<std::unique_ptr<Workers>> make_workers(int threads);
/// Number of cores that this process may use, at least 1.
int available_cores();

}  // namespace barehand
