#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <thread>

namespace barehand {

/// Turns Ctrl-C and SIGTERM into a call. To be made before other threads start: they inherit that these signals are
/// left to the watcher. A second signal ends the process at once, for whoever cannot wait.
class InterruptWatcher {
 public:
  /// `on_signal` is called once, on the watcher's thread.
  explicit InterruptWatcher(std::function<void()> on_signal);
  ~InterruptWatcher();

  /// SIGINT or SIGTERM; 0: none came.
  int signal() const { return signal_; }

 private:
  void watch(const std::stop_token& stop, const std::function<void()>& on_signal);

  sigset_t watched_{}, before_{};
  std::atomic<int> signal_ = 0;
  std::jthread thread_;
};

}  // namespace barehand
