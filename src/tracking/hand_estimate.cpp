// How HandTracker puts a frame's result into words: states of the segments, velocities, covariance, confidence.
#include <algorithm>
#include <cmath>

#include "tracking/hand_tracker.h"

namespace barehand {
namespace {

constexpr double kMicro = 1e-6;

// That both ends of the segment are near the truth; the less certain one decides.
double confidence(const HandProfile& profile, const SegmentState& state, int segment) {
  const Eigen::Vector3d bone = state.T_camera_segment.R * profile.segments[segment].distal;
  const auto J_distal = point_jacobian(bone);
  return std::min(probability_within(kConfidenceRadius, state.covariance.topLeftCorner<3, 3>()),
                  probability_within(kConfidenceRadius, J_distal * state.covariance * J_distal.transpose()));
}

}  // namespace

// A hand of another size than its profile's may well be one that is seen in a wrong scale, so that its place is wrong
// by as much along the way from the camera.
Matrix6d HandTracker::scale_doubt(const SE3& T_camera_segment) const {
  Matrix6d doubt = Matrix6d::Zero();
  const Eigen::Vector3d off = (size_in_view_ - 1) * T_camera_segment.t;
  doubt.topLeftCorner<3, 3>() = off * off.transpose();
  return doubt;
}

HandEstimatePtr HandTracker::estimate(const HandObservation& observation, const std::optional<Fit>& fit) {
  auto out = std::allocate_shared<HandEstimate>(FrameAllocator<HandEstimate>());
  out->utime = observation.frame->utime;
  out->number = observation.frame->number;
  out->sensor = observation.frame->sensor;
  out->status = loss_.status();
  out->hand_id = hand_id_;
  out->handedness = model_->profile->handedness;
  out->profile = model_->profile;
  if (out->status == TrackStatus::tracking && fit) {
    fill_segments(*out, *fit);
    last_tracked_ = out;
  } else if (last_tracked_ && (out->status == TrackStatus::holding || out->status == TrackStatus::lost)) {
    fill_held(*out);
  }
  return out;
}

void HandTracker::fill_segments(HandEstimate& out, const Fit& fit) {
  const RefinedPose& refined = fit.refined;
  out.score = refined.score;
  out.joint_gap = fit.joint_gap;
  const double dt = last_tracked_ ? std::abs(out.utime - last_tracked_->utime) * kMicro : 0;
  std::array<bool, kSegmentCount> hidden;
  for (int s = 0; s < kSegmentCount; ++s) hidden[s] = refined.matched[s] < params_.seen_fraction;
  // A pose that was found or given anew since then is no motion from there.
  const bool same_track = fit.prediction && dt == fit.prediction->dt;
  if (!same_track) uncertainty_.restart();
  const auto covariance = fit.belief ? *fit.belief : uncertainty_.covariance(*model_->profile, refined, hidden, dt);
  for (int s = 0; s < kSegmentCount; ++s) {
    SegmentState& state = out.segments[s];
    state.T_camera_segment = refined.pose[s];
    state.covariance = covariance[s];
    if (size_in_view_ != 1) state.covariance += scale_doubt(refined.pose[s]);
    state.visible = refined.visible[s];
    state.seen = !hidden[s];
    state.confidence = confidence(*model_->profile, state, s);
    if (same_track && dt > 0 && dt < params_.prediction.max_interval)
      state.velocity = boxminus(state.T_camera_segment, last_tracked_->segments[s].T_camera_segment) / dt;
  }
}

// As it was tracked last; how its uncertainty grows from then on is said where it is published (PoseHold).
void HandTracker::fill_held(HandEstimate& out) const {
  out.segments = last_tracked_->segments;
  out.score = last_tracked_->score;
  for (SegmentState& state : out.segments) {
    state.velocity = unknown_velocity();
    state.seen = false;
    state.visible = 0;
  }
}

}  // namespace barehand
