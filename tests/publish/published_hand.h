#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "hand/joint_angles.h"
#include "math/angles.h"
#include "support/adult_hand.h"

namespace barehand {

/// A pose of the palm half a metre in front of the camera, rotated about every axis.
inline SE3 somewhere() { return {exp_so3({0.4, -0.9, 2.0}), {0.05, -0.1, 0.5}}; }

using Angles = std::array<JointAngles, kSegmentCount>;

inline HandEstimate estimate_of(const HandProfile& profile, const Angles& angles, std::int64_t utime,
                                TrackStatus status = TrackStatus::tracking) {
  HandEstimate estimate;
  estimate.utime = utime;
  estimate.number = utime / 1000;
  estimate.sensor = "test";
  estimate.status = status;
  estimate.hand_id = 5;
  estimate.handedness = profile.handedness;
  estimate.score = 0.001;
  estimate.joint_gap = 0.002;
  estimate.profile = std::make_shared<HandProfile>(profile);

  // Give every segment a motion and an uncertainty; the tip of the little finger is not seen.
  const HandPose pose = forward_kinematics(profile, somewhere(), angles);
  for (int s = 0; s < kSegmentCount; ++s) {
    SegmentState& segment = estimate.segments[s];
    segment.T_camera_segment = pose[s];
    segment.velocity << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6;
    segment.covariance = 1e-6 * Matrix6d::Identity();
    segment.covariance(0, 4) = segment.covariance(4, 0) = 2e-7;
    segment.confidence = 0.8;
    segment.visible = 0.6;
    segment.seen = s != segment_of(4, 2);
  }
  return estimate;
}

}  // namespace barehand
