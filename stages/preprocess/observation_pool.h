#pragma once

#include <memory>

#include "core/pool.h"
#include "observe/observation.h"

namespace barehand {

/// Hands out observations and takes them back when their last owner, on whatever thread, lets go: their images keep
/// their memory, so a running stream allocates nothing. May be destroyed before what it handed out.
class ObservationPool {
 public:
  /// An observation with arbitrary content; not shared with anyone.
  std::shared_ptr<HandObservation> take() {
    return {pool_->take().release(),
            [pool = pool_](HandObservation* used) {
              used->frame.reset();  // the frame's memory is not ours to keep
              Pool<HandObservation>::Return{pool.get()}(used);
            },
            FrameAllocator<HandObservation>()};
  }

 private:
  std::shared_ptr<Pool<HandObservation>> pool_ = std::make_shared<Pool<HandObservation>>();
};

}  // namespace barehand
