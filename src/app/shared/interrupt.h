#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <string>
#include <thread>

namespace barehand {

/// Calls a function on Ctrl-C, SIGTERM or SIGHUP. Create it before other threads start: they inherit its signal mask,
/// which leaves these signals to the watcher. A second SIGINT or SIGTERM ends the process at once.
///
/// Signals that the process was started to ignore stay ignored: SIGHUP under nohup, and the terminal's Ctrl-C if a
/// shell without job control started the process in the background. A SIGINT from `kill -INT` is meant for this process
/// and is obeyed there, too.
class InterruptWatcher {
 public:
  /// Both functions are called on the watcher's thread. `on_signal` is called once. If `on_hangup` is given, it is
  /// called instead for every SIGHUP before that (several at once count as one).
  explicit InterruptWatcher(std::function<void()> on_signal, std::function<void()> on_hangup = {});
  ~InterruptWatcher();

  /// From now on, SIGHUP calls `on_signal`, too. Any thread may call this.
  void stop_on_hangup() { hangup_stops_ = true; }

  /// The signal that was received: SIGINT, SIGTERM or SIGHUP; 0 if there was none.
  int signal() const { return signal_; }
  /// Name of that signal, for messages.
  std::string name() const;

 private:
  void watch(const std::stop_token& stop);
  bool is_for_others(const siginfo_t& info) const;

  const std::function<void()> on_signal_, on_hangup_;
  const bool in_background_;  // whether the process was started with SIGINT ignored
  sigset_t watched_{}, before_{};
  std::atomic<bool> hangup_stops_;
  std::atomic<int> signal_ = 0;
  std::jthread thread_;
};

/// Holds back the signals of InterruptWatcher for the rest of the process, so that only watchers receive them: one that
/// arrives between two watchers goes to the second. Call it before other threads start.
void hold_interrupts();

}  // namespace barehand
