#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "sensor/rgbd_frame.h"

namespace barehand {

/// Lends frames and takes them back when their last owner, on whatever thread, releases them. Their images keep their
/// memory, so that a running stream allocates no pixels. The pool may be destroyed before the frames it has lent.
class FramePool {
 public:
  /// A frame with arbitrary content and no other owner.
  std::shared_ptr<RgbdFrame> take() {
    // Reuse an idle frame if there is one.
    std::unique_ptr<RgbdFrame> own;
    {
      const std::lock_guard lock(store_->mutex);
      if (!store_->idle.empty()) {
        own = std::move(store_->idle.back());
        store_->idle.pop_back();
      }
    }

    // Share the store with the frame, so that the pool may be destroyed before the frame.
    if (!own) own = std::make_unique<RgbdFrame>();
    return {own.release(), [store = store_](RgbdFrame* used) {
              std::unique_ptr<RgbdFrame> back(used);
              const std::lock_guard lock(store->mutex);
              if (store->idle.size() < kMostIdle) store->idle.push_back(std::move(back));
            }};
  }

 private:
  static constexpr std::size_t kMostIdle = 8;
  struct Store {
    std::mutex mutex;
    std::vector<std::unique_ptr<RgbdFrame>> idle;
  };
  std::shared_ptr<Store> store_ = std::make_shared<Store>();
};

}  // namespace barehand
