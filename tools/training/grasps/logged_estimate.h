#pragma once

#include <memory>

#include "barehand/hand_state_t.hpp"
#include "hand/hand_pose.h"

namespace barehand {

/// The estimate that a message states, as far as the recognition of grasps needs it, with a profile that has the
/// lengths of the hand.
inline HandEstimate estimate_of(const hand_state_t& state) {
  const auto profile = std::make_shared<HandProfile>();
  HandEstimate estimate;
  estimate.utime = state.utime;
  estimate.number = state.frame_number;
  estimate.sensor = state.sensor;
  estimate.status = static_cast<TrackStatus>(state.status);
  estimate.hand_id = state.hand_id;
  estimate.handedness = state.handedness == hand_state_t::LEFT ? Handedness::left : Handedness::right;
  for (int s = 0; s < kSegmentCount; ++s) {
    const segment_state_t& stated = state.segments[s];
    SegmentState& segment = estimate.segments[s];
    const double(&q)[4] = stated.orientation;
    segment.T_camera_segment = {Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix(),
                                Eigen::Vector3d(stated.position)};
    segment.covariance = Eigen::Map<const Matrix6d>(stated.covariance[0]);  // symmetric, so either order is right
    profile->segments[s].distal = segment.T_camera_segment.inverse() * Eigen::Vector3d(stated.distal);
  }
  estimate.profile = profile;
  return estimate;
}

}  // namespace barehand
