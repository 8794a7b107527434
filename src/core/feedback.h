#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>

namespace barehand {

/// Hands results of a later stage back to an earlier one, frame by frame: whoever takes frame k's result waits until it
/// is there, so what the earlier stage sees does not depend on how fast the threads run. Each result is taken once.
template <typename T>
class Feedback {
 public:
  void post(std::int64_t frame, T result) {
    std::unique_lock lock(mutex_);
    results_[frame] = std::move(result);
    posted_.notify_all();
  }

  T take(std::int64_t frame) {
    std::unique_lock lock(mutex_);
    posted_.wait(lock, [&] { return results_.contains(frame); });
    return std::move(results_.extract(frame).mapped());
  }

 private:
  std::mutex mutex_;
  std::condition_variable posted_;
  std::map<std::int64_t, T> results_;  ///< as many as frames are in flight
};

}  // namespace barehand
