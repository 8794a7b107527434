#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/parallel/delayed_result.h"
#include "stages/detection/hand_detector.h"

namespace barehand {

/// Looks at tracked hands again, now and then. A finger that the tracker has taken for its hidden neighbour may explain
/// the data as well as the right one, but the networks mostly tell them apart. Every few frames, and sooner if a hand
/// is ambiguous, one hand of which not every segment is seen is examined beside the tracking
/// (Workers::run_in_background). The result comes some frames
/// later; for a recording always equally many, so that results are the same on every machine. Not thread-safe.
class SecondLook {
 public:
  /// `every`: frames from one look to the next unless a hand is ambiguous; 0: never.
  explicit SecondLook(int every) : every_(every) {}

  /// Call once per frame. Returns the hand that was examined in an earlier frame, moved with its palm to where that is
  /// expected now; none in most frames. Its labels are those of the earlier frame. `feedback`: the estimates of an
  /// earlier frame, one per hand. `detector` and `workers` must outlive the object. Error: the network returns values
  /// that are not finite.
  Result<std::optional<DetectedHand>> next(const FramePtr& frame, std::span<const HandEstimatePtr> feedback,
                                           HandDetector& detector, Workers& workers);

 private:
  struct Look {
    std::size_t hand;        // index of the hand in the feedback
    Eigen::Vector3d centre;  // where its palm was expected [m]
    Result<std::optional<DetectedHand>> found;
  };
  void begin(const FramePtr& frame, std::span<const HandEstimatePtr> feedback, std::size_t hand, HandDetector& detector,
             Workers& workers);

  int every_;
  std::int64_t frame_ = -1;  // number of the frame, from 0
  std::size_t turn_ = 0;     // the hand that is looked at next
  DelayedResult<Look> look_;
};

}  // namespace barehand
