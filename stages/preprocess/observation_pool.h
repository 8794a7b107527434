#pragma once

#include <memory>

#include "core/pool.h"
#include "observe/observation.h"

namespace barehand {

/// Lends observations, and takes them back when their last owner, on any thread, releases them. Their images keep their
/// memory, so that a running stream allocates nothing. The pool may be destroyed before its observations.
class ObservationPool {
 public:
  /// Returns an observation with arbitrary content and no other owner.
  std::shared_ptr<HandObservation> take() {
    return {pool_->take().release(),
            [pool = pool_](HandObservation* used) {
              used->frame.reset();  // release the frame, which the pool must not keep alive
              Pool<HandObservation>::Return{pool.get()}(used);
            },
            FrameAllocator<HandObservation>()};
  }

 private:
  std::shared_ptr<Pool<HandObservation>> pool_ = std::make_shared<Pool<HandObservation>>();
};

}  // namespace barehand
