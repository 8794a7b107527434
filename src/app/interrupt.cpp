#include "app/interrupt.h"

#include <pthread.h>

#include <ctime>

namespace barehand {

InterruptWatcher::InterruptWatcher(std::function<void()> on_signal, std::function<void()> on_hangup)
    : on_signal_(std::move(on_signal)), on_hangup_(std::move(on_hangup)) {
  sigemptyset(&watched_);
  sigaddset(&watched_, SIGINT);
  sigaddset(&watched_, SIGTERM);
  if (on_hangup_) sigaddset(&watched_, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &watched_, &before_);
  thread_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

InterruptWatcher::~InterruptWatcher() {
  thread_.request_stop();
  thread_.join();
  if (on_hangup_) {  // one that came too late must not end the process now
    constexpr timespec kNow{0, 0};
    sigset_t hangup;
    sigemptyset(&hangup);
    sigaddset(&hangup, SIGHUP);
    sigtimedwait(&hangup, nullptr, &kNow);
  }
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void InterruptWatcher::watch(const std::stop_token& stop) {
  constexpr timespec kPatience{0, 50'000'000};
  while (!stop.stop_requested()) {
    const int received = sigtimedwait(&watched_, nullptr, &kPatience);
    if (received <= 0) continue;
    if (received == SIGHUP) {
      on_hangup_();
      continue;
    }
    signal_ = received;
    sigdelset(&watched_, SIGHUP);                      // whoever stops does not reload any more
    pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);  // the next one has its default effect, through this thread
    on_signal_();
    while (!stop.stop_requested()) nanosleep(&kPatience, nullptr);
  }
}

}  // namespace barehand
