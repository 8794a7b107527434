// Waits for the signals that stop the program (Ctrl-C, SIGTERM, SIGHUP) on a thread of its own.
#include "app/shared/interrupt.h"

#include <pthread.h>

#include <ctime>

namespace barehand {
namespace {

bool is_ignored(int number) {
  struct sigaction action {};
  return sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// The signals that stop the program. A SIGHUP that is ignored stays ignored.
sigset_t stopping_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  if (!is_ignored(SIGHUP)) sigaddset(&signals, SIGHUP);
  return signals;
}

}  // namespace

void hold_interrupts() {
  const sigset_t held = stopping_signals();
  pthread_sigmask(SIG_BLOCK, &held, nullptr);
}

InterruptWatcher::InterruptWatcher(std::function<void()> on_signal, std::function<void()> on_hangup)
    : on_signal_(std::move(on_signal)),
      on_hangup_(std::move(on_hangup)),
      in_background_(is_ignored(SIGINT)),
      watched_(stopping_signals()),
      hangup_stops_(!on_hangup_) {
  pthread_sigmask(SIG_BLOCK, &watched_, &before_);
  thread_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

InterruptWatcher::~InterruptWatcher() {
  thread_.request_stop();
  thread_.join();

  // Discard a SIGHUP that arrived too late, which would otherwise end the process now.
  constexpr timespec kNow{0, 0};
  sigset_t hangup;
  sigemptyset(&hangup);
  sigaddset(&hangup, SIGHUP);
  sigtimedwait(&hangup, nullptr, &kNow);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

std::string InterruptWatcher::name() const {
  return signal_ == SIGINT ? "Ctrl-C" : signal_ == SIGHUP ? "SIGHUP" : "SIGTERM";
}

/// Whether this is a terminal's Ctrl-C that is meant for other processes: a terminal sends it to all that were started
/// from it.
bool InterruptWatcher::is_for_others(const siginfo_t& info) const {
  return in_background_ && info.si_signo == SIGINT && info.si_code == SI_KERNEL;
}

void InterruptWatcher::watch(const std::stop_token& stop) {
  constexpr timespec kPatience{0, 50'000'000};
  while (!stop.stop_requested()) {
    // Wait for a signal, with a timeout so that the destructor does not wait long.
    siginfo_t info{};
    const int received = sigtimedwait(&watched_, &info, &kPatience);
    if (received <= 0 || is_for_others(info)) continue;
    if (received == SIGHUP && !hangup_stops_) {
      on_hangup_();
      continue;
    }
    signal_ = received;

    // Let the next signal have its default effect on this thread. SIGHUP stays blocked, because a terminal that closes
    // sends it twice: through the shell and by itself.
    sigdelset(&watched_, SIGHUP);
    pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);
    on_signal_();
    while (!stop.stop_requested()) nanosleep(&kPatience, nullptr);
  }
}

}  // namespace barehand
