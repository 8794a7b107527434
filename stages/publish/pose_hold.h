#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hand/hand_pose.h"
#include "stages/publish/publish_params.h"

namespace barehand {

/// What may be said of a hand in one frame.
struct PublishedTrack {
  TrackStatus status = TrackStatus::searching;
  bool has_pose = false;  ///< tracking or holding
  std::int64_t pose_utime = 0;
  std::array<SegmentState, kSegmentCount> segments;  ///< meaningless without a pose
};

/// Keeps the promise to consumers: a hand that is not seen any more is held at its last pose with growing covariance
/// for a limited time, then it is lost and has no pose. A search that starts anew forgets the pose at once.
class PoseHold {
 public:
  PublishedTrack update(const HandEstimate& estimate, const PublishParams& params);

 private:
  std::optional<PublishedTrack> last_;
};

}  // namespace barehand
