#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <string>
#include <thread>

namespace barehand {

/// Turns Ctrl-C, SIGTERM and SIGHUP into a call. To be made before other threads start: they inherit that these signals
/// are left to the watcher. A second SIGINT or SIGTERM ends the process at once, for whoever cannot wait.
///
/// What the process was started to ignore stays ignored: SIGHUP under nohup, and the Ctrl-C of a terminal where a shell
/// without job control started it in the background. `kill -INT` means this very process and is followed there, too.
class InterruptWatcher {
 public:
  /// `on_signal` is called once. `on_hangup`, where there is one, is called for every SIGHUP before that (several that
  /// come at once count as one) instead. Both on the watcher's thread.
  explicit InterruptWatcher(std::function<void()> on_signal, std::function<void()> on_hangup = {});
  ~InterruptWatcher();

  /// Any thread: from now on SIGHUP means the end here, too.
  void stop_on_hangup() { hangup_stops_ = true; }

  /// SIGINT, SIGTERM or SIGHUP; 0: none came.
  int signal() const { return signal_; }
  /// Its name, for people.
  std::string name() const;

 private:
  void watch(const std::stop_token& stop);
  bool is_for_others(const siginfo_t& info) const;

  const std::function<void()> on_signal_, on_hangup_;
  const bool in_background_;  // started to ignore SIGINT
  sigset_t watched_{}, before_{};
  std::atomic<bool> hangup_stops_;
  std::atomic<int> signal_ = 0;
  std::jthread thread_;
};

}  // namespace barehand
