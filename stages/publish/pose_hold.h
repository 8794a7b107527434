#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hand/hand_pose.h"
#include "stages/publish/publish_params.h"

namespace barehand {

// Holds the last pose of a hand for some time after it is lost.

/// The state of a hand in one frame as it is published.
struct PublishedTrack {
  TrackStatus status = TrackStatus::searching;
  bool has_pose = false;                             ///< whether the hand is tracked or held
  std::int64_t pose_utime = 0;                       ///< time stamp of the frame in which the pose was tracked [us]
  std::array<SegmentState, kSegmentCount> segments;  ///< meaningless without a pose
};

/// Keeps publishing the last pose of a hand that is not seen any more, with growing covariance, for a limited time;
/// then the hand is published as lost, without a pose. If the tracker forgets the hand (status searching), the pose is
/// dropped at once.
class PoseHold {
 public:
  PublishedTrack update(const HandEstimate& estimate, const PublishParams& params);

 private:
  std::optional<PublishedTrack> last_;
};

}  // namespace barehand
