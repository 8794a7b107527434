// Decides whether a hand is tracked, held or lost.
#include "tracking/track_state.h"

#include <algorithm>
#include <cmath>

namespace barehand {

namespace {

/// A threshold on the global score, scaled with the size of the hand and raised by the sensor's noise [m].
double threshold(double score, const LossParams& params, const TrackEvidence& evidence) {
  const double scaled = score * evidence.hand_length / TrackState::kReferenceHandLength;
  return std::hypot(scaled, params.noise_factor * evidence.noise);
}

bool tracked(TrackPhase phase) { return phase == TrackPhase::tracking || phase == TrackPhase::holding; }
bool lost(TrackPhase phase) { return phase == TrackPhase::lost || phase == TrackPhase::tentative; }

}  // namespace

std::string_view to_string(TrackPhase phase) {
  switch (phase) {
    case TrackPhase::searching:
      return "searching";
    case TrackPhase::tracking:
      return "tracking";
    case TrackPhase::holding:
      return "holding";
    case TrackPhase::lost:
      return "lost";
    case TrackPhase::tentative:
      return "tentative";
  }
  return "";
}

TrackStatus TrackState::status() const {
  switch (phase_) {
    case TrackPhase::searching:
      return TrackStatus::searching;
    case TrackPhase::tracking:
      return TrackStatus::tracking;
    case TrackPhase::holding:
      return TrackStatus::holding;
    case TrackPhase::lost:
    case TrackPhase::tentative:
      return TrackStatus::lost;
  }
  return TrackStatus::searching;
}

double TrackState::bad_threshold(const TrackEvidence& evidence) const {
  return threshold(params_.lost_score, params_, evidence);
}

double TrackState::good_threshold(const TrackEvidence& evidence) const {
  return threshold(std::min(params_.recovered_score, params_.lost_score), params_, evidence);
}

TrackState::Kind TrackState::kind_of(const TrackEvidence& evidence) const {
  if (evidence.hand_pixels < params_.min_hand_pixels) return Kind::no_data;
  if (evidence.to_be_confirmed) return Kind::to_be_confirmed;

  // Written so that a NaN score is bad.
  if (!evidence.score || !(*evidence.score <= bad_threshold(evidence))) return Kind::bad;
  return *evidence.score <= good_threshold(evidence) ? Kind::good : Kind::undecided;
}

TrackPhase TrackState::update(const TrackEvidence& evidence) {
  // Count consecutive good and bad frames. Frames without data and undecided ones neither extend a run of bad frames
  // nor end it.
  const Kind kind = kind_of(evidence);
  good_ = kind == Kind::good ? good_ + 1 : 0;
  if (kind == Kind::bad || kind == Kind::to_be_confirmed) ++bad_;
  if (kind == Kind::good) bad_ = 0;

  const TrackPhase next = tracked(phase_) ? next_while_tracked(kind, evidence.dt) : next_while_lost(kind, evidence.dt);
  if (next != phase_) enter(next);
  return phase_;
}

TrackPhase TrackState::next_while_tracked(Kind kind, double dt) {
  if (bad_ >= params_.bad_frames) return TrackPhase::lost;
  if (kind == Kind::no_data) {
    time_in_phase_ += dt;
    return time_in_phase_ > params_.hold_time ? TrackPhase::lost : TrackPhase::holding;
  }
  const bool explained = kind == Kind::good || kind == Kind::undecided;
  return explained ? TrackPhase::tracking : phase_;
}

TrackPhase TrackState::next_while_lost(Kind kind, double dt) {
  time_in_phase_ += dt;
  if (kind == Kind::good && good_ >= params_.good_frames) return TrackPhase::tracking;
  if (phase_ == TrackPhase::searching) return phase_;
  if (time_in_phase_ > params_.forget_time) return TrackPhase::searching;
  return kind == Kind::to_be_confirmed ? TrackPhase::tentative : TrackPhase::lost;
}

void TrackState::enter(TrackPhase phase) {
  // Keep the count of bad frames when the phase changes between tracking and holding; keep the count of good frames and
  // the time since the loss when it changes between lost and tentative. Keep the time also on entering holding:
  // next_while_tracked() has already added the frame without data.
  const bool same_track = tracked(phase) && tracked(phase_), same_loss = lost(phase) && lost(phase_);
  if (!same_track) bad_ = 0;
  if (!same_loss) good_ = 0;
  if (!same_loss && !(same_track && phase == TrackPhase::holding)) time_in_phase_ = 0;
  phase_ = phase;
}

}  // namespace barehand
