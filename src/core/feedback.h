#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>

namespace barehand {

/// Hands the results of a later stage back to an earlier one, frame by frame. Taking the result of frame k waits until
/// it is there, so what the earlier stage gets does not depend on the speed of the threads. Each result can be taken
/// only once.
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
  std::map<std::int64_t, T> results_;  ///< results by frame, at most one for each frame in the pipeline
};

}  // namespace barehand
