// Holds the last pose of a hand for some time after it is lost.
#include "stages/publish/pose_hold.h"

#include <cmath>

namespace barehand {
namespace {

/// The state of a segment that has been held for `seconds`.
SegmentState held(SegmentState state, double seconds, const PublishParams& params) {
  const double position = params.hold_growth * seconds, rotation = params.hold_growth_rotation * seconds;
  state.covariance.diagonal().head<3>().array() += position * position;
  state.covariance.diagonal().tail<3>().array() += rotation * rotation;
  state.confidence *= 1 - seconds / params.hold_time;
  state.velocity = unknown_velocity();
  state.seen = false;
  state.visible = 0;
  return state;
}

}  // namespace

PublishedTrack PoseHold::update(const HandEstimate& estimate, const PublishParams& params) {
  if (estimate.status == TrackStatus::searching) {
    last_.reset();
    return {};
  }

  // A tracked pose becomes the last one. So does a pose that was given to the tracker and never tracked.
  if (estimate.status == TrackStatus::tracking || (estimate.status == TrackStatus::holding && !last_)) {
    last_ = {TrackStatus::tracking, true, estimate.utime, estimate.segments};
  }
  if (estimate.status == TrackStatus::tracking) return *last_;

  // Without data, hold the last pose until it is too old.
  PublishedTrack track;
  track.status = TrackStatus::lost;
  if (!last_) return track;
  const double seconds = std::abs(1e-6 * static_cast<double>(estimate.utime - last_->pose_utime));
  if (seconds >= params.hold_time) return track;

  track = *last_;
  track.status = TrackStatus::holding;
  for (SegmentState& segment : track.segments) segment = held(segment, seconds, params);
  return track;
}

}  // namespace barehand
