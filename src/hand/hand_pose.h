#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "core/memory/frame_memory.h"
#include "hand/decision.h"
#include "hand/profile.h"

namespace barehand {

// The pose of a hand, and a tracker's estimate of it.

/// T_camera_segment of every segment: 16 segments with 6 degrees of freedom, the 96 numbers of the paper (Sec. 3.1).
/// The ends of neighbouring segments need not meet exactly.
using HandPose = std::array<SE3, kSegmentCount>;

/// A segment counts as correctly located if both of its ends are within this distance of their true positions [m];
/// SegmentState::confidence is the probability of that.
inline constexpr double kConfidenceRadius = 0.010;

/// State of the track of one hand. searching: no hand was found yet, or it has been lost for a long time; tracking: the
/// pose follows the data; holding: the hand is hardly visible, so its last pose is kept for a short time; lost: the
/// data was missing or fitted badly for too long, so the hand is searched for, its last good pose being one of the
/// initial poses.
enum class TrackStatus { searching = 0, tracking = 1, holding = 2, lost = 3 };

/// A velocity of NaN, which means "not known": a velocity needs two poses of one track that are close in time.
inline Vector6d unknown_velocity() { return Vector6d::Constant(std::numeric_limits<double>::quiet_NaN()); }

/// The estimate of one segment in one frame. Camera frame, metres, radians.
struct SegmentState {
  SE3 T_camera_segment;
  Vector6d velocity = unknown_velocity();      ///< [m/s, rad/s]: linear (of the origin), then angular; NaN: not known
  Matrix6d covariance = Matrix6d::Identity();  ///< covariance of the boxplus twist (translation, rotation)
  double confidence = 0;                       ///< probability that both ends are within kConfidenceRadius of the truth
  double visible = 0;                          ///< fraction of the segment's projected pixels where it is front-most
  bool seen = false;                           ///< whether estimated from data, not inferred from structure and motion
};

/// The poses of the segments without velocities and uncertainties.
inline HandPose pose_of(const std::array<SegmentState, kSegmentCount>& segments) {
  HandPose pose;
  for (int s = 0; s < kSegmentCount; ++s) pose[s] = segments[s].T_camera_segment;
  return pose;
}

/// The estimate of one hand in one frame: what the publish stage, result tables and overlays consume. Immutable once
/// shared.
struct HandEstimate {
  std::int64_t utime = 0;
  std::int64_t number = 0;  ///< RgbdFrame::number
  std::string sensor;
  TrackStatus status = TrackStatus::searching;
  std::int32_t hand_id = 0;
  Handedness handedness = Handedness::right;
  std::array<SegmentState, kSegmentCount> segments;  ///< meaningless while searching
  double score = 0;        ///< global score: mean mismatch of model and data [m], lower is better
  bool ambiguous = false;  ///< explained clearly worse than this hand usually is; fingers may be confused
  double joint_gap = 0;    ///< mean raw gap between adjacent ends before joints are closed [m] (paper Sec. 5.2)
  std::shared_ptr<const HandProfile> profile;
  Decisions decisions;  ///< the decisions that led to this estimate, in order

  /// Whether there is a pose that may be displayed and published as tracked.
  bool has_pose() const { return status == TrackStatus::tracking || status == TrackStatus::holding; }
};
using HandEstimatePtr = std::shared_ptr<const HandEstimate>;
/// The estimates of one frame: one for each configured hand, always in the same order.
using HandEstimates = FrameVector<HandEstimatePtr>;

}  // namespace barehand
