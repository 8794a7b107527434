#pragma once

#include <future>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/error.h"

namespace barehand {

class TbbArena;

/// The one owner of the cores: stages spread their work through it and start no threads of their own.
class Workers {
 public:
  static constexpr int kMaxThreads = 256;

  /// `threads` in [1, kMaxThreads], the calling one included; 1 runs everything inline. See make_workers for input
  /// that comes from people.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Calls fn(0) ... fn(n-1), each once, in any order and on any thread, and returns when all are done. The result is
  /// the same for every number of threads if fn(i) writes only what belongs to i; sums are taken afterwards, in order.
  /// What fn throws is thrown here. May be called from several threads, and from within fn.
  template <typename Fn>
  void for_each_index(int n, Fn&& fn) {
    run(n, {[](const void* f, int i) { (*static_cast<const std::remove_reference_t<Fn>*>(f))(i); }, &fn});
  }
  int threads() const { return threads_; }

  /// Work of seconds that no frame needs at once: fn(Workers&), which may outlive this call but not `*this`. A
  /// recording waits for it, so that it gives the same on every machine: it is done before this returns. After
  /// go_live() it is done meanwhile, on what the cores have to spare. What fn throws is thrown by get().
  template <typename Fn>
  auto aside(Fn fn) -> std::future<std::invoke_result_t<Fn&, Workers&>> {
    if (live_)
      return std::async(std::launch::async, [fn = std::move(fn)]() mutable {
        give_way();
        Workers alone(1);
        return fn(alone);
      });
    auto done = std::async(std::launch::deferred, [this, fn = std::move(fn)]() mutable { return fn(*this); });
    done.wait();
    return done;
  }
  /// From now on frames come by themselves and nothing may hold them up.
  void go_live() { live_ = true; }

 private:
  /// A function that someone else owns: std::function would allocate for most lambdas.
  struct Call {
    void (*function)(const void* self, int i);
    const void* self;
    void operator()(int i) const { function(self, i); }
  };
  void run(int n, Call call);
  /// The calling thread runs only while no other one wants its core.
  static void give_way();

  int threads_;
  bool live_ = false;
  std::unique_ptr<TbbArena> arena_;  ///< none for one thread
};

/// Number of threads from people: 0, negative or absurd counts are an error.
Result<std::unique_ptr<Workers>> make_workers(int threads);
/// Cores this process may run on, at least 1.
int available_cores();

}  // namespace barehand
