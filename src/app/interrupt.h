#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <thread>

namespace barehand {

/// Turns Ctrl-C and SIGTERM into a call, and SIGHUP into another. To be made before other threads start: they inherit
/// that these signals are left to the watcher. A second signal ends the process at once, for whoever cannot wait.
class InterruptWatcher {
 public:
  /// `on_signal` is called once, `on_hangup` for every SIGHUP before that (several that come at once count as one),
  /// both on the watcher's thread. Without `on_hangup` SIGHUP has its usual effect.
  explicit InterruptWatcher(std::function<void()> on_signal, std::function<void()> on_hangup = {});
  ~InterruptWatcher();

  /// SIGINT or SIGTERM; 0: none came.
  int signal() const { return signal_; }

 private:
  void watch(const std::stop_token& stop);

  const std::function<void()> on_signal_, on_hangup_;
  sigset_t watched_{}, before_{};
  std::atomic<int> signal_ = 0;
  std::jthread thread_;
};

}  // namespace barehand
