// How HandTracker puts a frame's result into words: states of the segments, velocities, covariance, confidence.
#include <algorithm>
#include <cmath>

#include "app/hand_tracker.h"

namespace barehand {
namespace {

constexpr double kMicro = 1e-6;
constexpr double kRotationGrowth = 10;  // [rad/m]: a segment is about 0.1 m long at most

// Agreement of the visible skin with the data, less where little is visible; what is inferred stays below 0.3.
double confidence(double visible, double matched, bool seen) {
  const double agreement = visible > 0 ? std::clamp(matched / visible, 0.0, 1.0) : 0.0;
  return seen ? agreement * (0.4 + 0.6 * std::min(1.0, visible / 0.6)) : 0.3 * agreement * visible + 0.1;
}

}  // namespace

HandEstimatePtr HandTracker::estimate(const HandObservation& observation, const std::optional<Fit>& fit) {
  auto out = std::make_shared<HandEstimate>();
  out->utime = observation.frame->utime;
  out->number = observation.frame->number;
  out->sensor = observation.frame->sensor;
  out->status = loss_.status();
  out->hand_id = hand_id_;
  out->handedness = model_->profile->handedness;
  out->profile = model_->profile;
  if (out->status == TrackStatus::tracking && fit) {
    const RefinedPose& refined = fit->refined;
    out->score = refined.score;
    out->joint_gap = fit->joint_gap;
    const double dt = last_tracked_ ? std::abs(out->utime - last_tracked_->utime) * kMicro : 0;
    for (int s = 0; s < kSegmentCount; ++s) {
      SegmentState& state = out->segments[s];
      state.T_camera_segment = refined.pose[s];
      state.covariance = refined.covariance[s] * (params_.refinement.enabled ? params_.covariance_scale : 1.0);
      state.visible = refined.visible[s];
      state.seen = refined.matched[s] >= params_.seen_fraction;
      state.confidence = confidence(refined.visible[s], refined.matched[s], state.seen);
      // Velocity needs a pose of the same track shortly before.
      if (fit->prediction && dt > 0 && dt < params_.prediction.max_interval)
        state.velocity = boxminus(state.T_camera_segment, last_tracked_->segments[s].T_camera_segment) / dt;
    }
    last_tracked_ = out;
  } else if (last_tracked_ && (out->status == TrackStatus::holding || out->status == TrackStatus::lost)) {
    fill_held(*out, std::abs(out->utime - last_tracked_->utime) * kMicro);
  }
  return out;
}

void HandTracker::fill_held(HandEstimate& out, double held_s) const {
  out.segments = last_tracked_->segments;
  out.score = last_tracked_->score;
  Vector6d growth = Vector6d::Constant(params_.hold_growth * std::max(0.0, held_s));
  growth.tail<3>() *= kRotationGrowth;
  for (SegmentState& state : out.segments) {
    state.velocity.setZero();
    state.covariance.diagonal() += growth.cwiseAbs2();
    state.seen = false;
    state.visible = 0;
    state.confidence *= std::exp(-4 * held_s);
  }
}

}  // namespace barehand
