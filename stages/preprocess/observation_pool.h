#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "observe/observation.h"

namespace barehand {

/// Hands out observations and takes them back when their last owner, on whatever thread, lets go: their images keep
/// their memory, so a running stream allocates nothing. May be destroyed before what it handed out.
class ObservationPool {
 public:
  /// An observation with arbitrary content; not shared with anyone.
  std::shared_ptr<HandObservation> take() {
    std::unique_ptr<HandObservation> own;
    {
      const std::lock_guard lock(store_->mutex);
      if (!store_->idle.empty()) {
        own = std::move(store_->idle.back());
        store_->idle.pop_back();
      }
    }
    if (!own) own = std::make_unique<HandObservation>();
    return {own.release(), [store = store_](HandObservation* used) {
              used->frame.reset();  // the frame's memory is not ours to keep
              std::unique_ptr<HandObservation> back(used);
              const std::lock_guard lock(store->mutex);
              if (store->idle.size() < kMostIdle) store->idle.push_back(std::move(back));
            }};
  }

 private:
  static constexpr std::size_t kMostIdle = 8;
  struct Store {
    std::mutex mutex;
    std::vector<std::unique_ptr<HandObservation>> idle;
  };
  std::shared_ptr<Store> store_ = std::make_shared<Store>();
};

}  // namespace barehand
