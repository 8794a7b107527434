#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/format.h"

namespace barehand {

/// A thread that makes all calls of a graphics driver, and the `State` that these calls work on. The caller waits for
/// each piece of work, but no longer than a time limit. A thread whose work takes longer is abandoned: it keeps the
/// state, which nobody else uses from then on, and destroys it when the driver returns, if it ever does. For one caller
/// at a time.
template <class State>
class DeviceThread {
 public:
  using Work = Result<void> (*)(State&);

  /// `close_limit`: how long the destructor waits for the state's destruction on the thread, unless it was abandoned.
  DeviceThread(std::unique_ptr<State> state, std::chrono::milliseconds close_limit)
      : shared_(std::make_shared<Shared>(std::move(state))),
        close_limit_(close_limit),
        thread_([shared = shared_] { shared->serve(); }) {}
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;
  ~DeviceThread() {
    if (shared_->finish(close_limit_))
      thread_.join();
    else
      thread_.detach();
  }

  /// Runs `work` on the thread and returns its result. Error: it took longer than `limit`, now or in an earlier call;
  /// state() is null from then on.
  Result<void> run(Work work, std::chrono::milliseconds limit) { return shared_->run(work, limit); }

  /// The state, to be used only while no work runs; null once the thread was abandoned.
  State* state() { return shared_->reachable(); }

 private:
  class Shared {
   public:
    explicit Shared(std::unique_ptr<State> state) : state_(std::move(state)) {}

    Result<void> run(Work work, std::chrono::milliseconds limit) {
      std::unique_lock lock(mutex_);
      if (!leaving_) {
        work_ = work;
        changed_.notify_all();
        if (changed_.wait_for(lock, limit, [&] { return !work_; })) return std::exchange(result_, {});
        leaving_ = true;
      }
      return fail(formatted("the driver has not returned from a call within %.1f s", 1e-3 * limit.count()), "EGL",
                  "update the graphics driver, or set observer: cpu");
    }

    State* reachable() {
      const std::lock_guard lock(mutex_);
      return leaving_ ? nullptr : state_.get();
    }

    /// Main function of the thread.
    void serve() {
      std::unique_lock lock(mutex_);
      for (;;) {
        changed_.wait(lock, [&] { return work_ || leaving_; });
        if (leaving_) break;
        lock.unlock();
        Result<void> result = done(work_);  // works without the lock, since only this thread resets work_
        lock.lock();

        // Hand over the result.
        result_ = std::move(result);
        work_ = nullptr;
        changed_.notify_all();
      }

      // Destroy the state on the thread that made all its calls.
      lock.unlock();
      state_.reset();
      lock.lock();
      ended_ = true;
      changed_.notify_all();
    }

    /// Asks the thread to end, and returns whether it ended within the limit. Does not wait for an abandoned thread.
    bool finish(std::chrono::milliseconds limit) {
      std::unique_lock lock(mutex_);
      if (std::exchange(leaving_, true)) return ended_;
      changed_.notify_all();
      return changed_.wait_for(lock, limit, [&] { return ended_; });
    }

   private:
    Result<void> done(Work work) {
      try {
        return work(*state_);
      } catch (const std::exception& e) {  // most likely out of memory
        return fail(e.what(), "EGL");
      }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::unique_ptr<State> state_;
    Work work_ = nullptr;
    Result<void> result_;
    bool leaving_ = false, ended_ = false;
  };

  std::shared_ptr<Shared> shared_;  // shared with the thread, which may outlive this object
  std::chrono::milliseconds close_limit_;
  std::thread thread_;
};

}  // namespace barehand
