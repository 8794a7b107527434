// Builds the published estimate of a hand from the tracker's pose: covariances, confidences and velocities.
#include "tracking/estimate_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace barehand {
namespace {

constexpr double kMicro = 1e-6;
constexpr double kBadDeviation = 0.03;  // additional deviation of every segment in a bad frame [m]

// Probability that both ends of the segment lie within kConfidenceRadius of their true positions, approximated by that
// of the less certain end.
double confidence(const HandProfile& profile, const SegmentState& state, int segment) {
  const Eigen::Vector3d bone = state.T_camera_segment.R * profile.segments[segment].distal;
  const auto J_distal = point_jacobian(bone);
  return std::min(probability_within(kConfidenceRadius, state.covariance.topLeftCorner<3, 3>()),
                  probability_within(kConfidenceRadius, J_distal * state.covariance * J_distal.transpose()));
}

// Additional covariance because of an unknown scale: if the hand seems to have another size than its profile, the depth
// values may be wrong by that factor, and with them the hand's distance from the camera.
Matrix6d size_covariance(const SE3& T_camera_segment, double size_in_view) {
  Matrix6d covariance = Matrix6d::Zero();
  const Eigen::Vector3d off = (size_in_view - 1) * T_camera_segment.t;
  covariance.topLeftCorner<3, 3>() = off * off.transpose();
  return covariance;
}

}  // namespace

EstimateBuilder::EstimateBuilder(const TrackerContext& context, HandIds ids)
    : context_(context), uncertainty_(context.params.uncertainty, context.params.refinement.energy), ids_(ids) {}

void EstimateBuilder::start_track() { hand_id_ = hand_id_ ? hand_id_ + ids_.step : ids_.first; }

void EstimateBuilder::change() {
  uncertainty_ = PoseUncertainty(context_.params.uncertainty, context_.params.refinement.energy);
}

HandEstimatePtr EstimateBuilder::build(const HandObservation& observation, TrackStatus status, const Hypothesis* chosen,
                                       bool bad, bool ambiguous, const PersonModel& person, Decisions decisions) {
  auto out = std::allocate_shared<HandEstimate>(FrameAllocator<HandEstimate>());

  // Copy what identifies the frame and the hand.
  out->utime = observation.frame->utime;
  out->number = observation.frame->number;
  out->sensor = observation.frame->sensor;
  out->status = status;
  out->hand_id = hand_id_;
  out->handedness = person.profile().handedness;
  out->profile = person.shared_profile();
  out->decisions = std::move(decisions);

  // Fill in the pose that was chosen, or the last tracked one while the track is held or lost.
  if (status == TrackStatus::tracking && chosen) {
    fill_segments(*out, *chosen, bad, person.size_in_view());
    out->ambiguous = ambiguous;
    last_tracked_ = out;
  } else if (last_tracked_ && (status == TrackStatus::holding || status == TrackStatus::lost)) {
    fill_held(*out);
  }
  return out;
}

void EstimateBuilder::fill_segments(HandEstimate& out, const Hypothesis& chosen, bool bad, double size_in_view) {
  const RefinedPose& refined = chosen.refined;
  const TrackerParams& params = context_.params;
  out.score = refined.score;
  out.joint_gap = chosen.joint_gap;

  // Find the segments of which too little is matched to be called seen.
  std::array<bool, kSegmentCount> hidden;
  for (int s = 0; s < kSegmentCount; ++s) hidden[s] = refined.matched[s] < params.seen_fraction;

  // A pose that was found or given since the last estimate does not continue it, so it yields no velocity.
  const double dt = last_tracked_ ? std::abs(out.utime - last_tracked_->utime) * kMicro : 0;
  const bool same_track = chosen.prediction && dt == chosen.prediction->dt;
  if (!same_track) uncertainty_.restart();
  const auto covariance = chosen.belief ? *chosen.belief : uncertainty_.covariance(*out.profile, refined, hidden, dt);

  // Fill in the state of every segment.
  for (int s = 0; s < kSegmentCount; ++s) {
    SegmentState& state = out.segments[s];
    state.T_camera_segment = refined.pose[s];
    state.covariance = covariance[s];
    if (size_in_view != 1) state.covariance += size_covariance(refined.pose[s], size_in_view);
    if (bad) state.covariance.diagonal().head<3>().array() += kBadDeviation * kBadDeviation;

    // State how well the segment is seen, and its velocity if the track continues.
    state.visible = refined.visible[s];
    state.seen = !hidden[s];
    state.confidence = confidence(*out.profile, state, s);
    if (same_track && dt > 0 && dt < params.prediction.max_interval)
      state.velocity = boxminus(state.T_camera_segment, last_tracked_->segments[s].T_camera_segment) / dt;
  }
}

// Repeats the last tracked pose with its covariance; PoseHold increases the covariance when the pose is published.
void EstimateBuilder::fill_held(HandEstimate& out) const {
  out.segments = last_tracked_->segments;
  out.score = last_tracked_->score;
  for (SegmentState& state : out.segments) {
    state.velocity = unknown_velocity();
    state.seen = false;
    state.visible = 0;
  }
}

}  // namespace barehand
