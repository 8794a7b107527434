#include "app/interrupt.h"

#include <pthread.h>

#include <ctime>

namespace barehand {

InterruptWatcher::InterruptWatcher(std::function<void()> on_signal) {
  sigemptyset(&watched_);
  sigaddset(&watched_, SIGINT);
  sigaddset(&watched_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &watched_, &before_);
  thread_ = std::jthread([this, on_signal = std::move(on_signal)](std::stop_token stop) { watch(stop, on_signal); });
}

InterruptWatcher::~InterruptWatcher() {
  thread_.request_stop();
  thread_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void InterruptWatcher::watch(const std::stop_token& stop, const std::function<void()>& on_signal) {
  constexpr timespec kPatience{0, 50'000'000};
  while (!stop.stop_requested()) {
    const int received = sigtimedwait(&watched_, nullptr, &kPatience);
    if (received <= 0) continue;
    signal_ = received;
    pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);  // the next one has its default effect, through this thread
    on_signal();
    while (!stop.stop_requested()) nanosleep(&kPatience, nullptr);
  }
}

}  // namespace barehand
