#include "tracking/loss_detector.h"

#include <algorithm>
#include <cmath>

namespace barehand {

namespace {

double threshold(double score, const LossParams& params, const TrackEvidence& evidence) {
  const double scaled = score * evidence.hand_length / LossDetector::kReferenceHandLength;
  return std::hypot(scaled, params.noise_factor * evidence.noise);
}

}  // namespace

double LossDetector::bad_threshold(const TrackEvidence& evidence) const {
  return threshold(params_.lost_score, params_, evidence);
}

double LossDetector::good_threshold(const TrackEvidence& evidence) const {
  return threshold(std::min(params_.recovered_score, params_.lost_score), params_, evidence);
}

LossDetector::Verdict LossDetector::judge(const TrackEvidence& evidence) const {
  if (evidence.hand_pixels < params_.min_hand_pixels) return Verdict::no_data;
  // Written so that a NaN score is bad.
  if (!evidence.score || !(*evidence.score <= bad_threshold(evidence))) return Verdict::bad;
  return *evidence.score <= good_threshold(evidence) ? Verdict::good : Verdict::undecided;
}

TrackStatus LossDetector::update(const TrackEvidence& evidence) {
  const Verdict verdict = judge(evidence);
  good_ = verdict == Verdict::good ? good_ + 1 : 0;
  // Missing and undecided frames neither add to a run of bad frames nor end it.
  if (verdict == Verdict::bad) ++bad_;
  if (verdict == Verdict::good) bad_ = 0;
  const bool tracked = status_ == TrackStatus::tracking || status_ == TrackStatus::holding;
  const TrackStatus next = tracked ? next_while_tracked(verdict, evidence.dt) : next_while_lost(verdict, evidence.dt);
  if (next != status_) enter(next);
  return status_;
}

TrackStatus LossDetector::next_while_tracked(Verdict verdict, double dt) {
  if (bad_ >= params_.bad_frames) return TrackStatus::lost;
  if (verdict == Verdict::no_data) {
    time_in_state_ += dt;
    return time_in_state_ > params_.hold_time ? TrackStatus::lost : TrackStatus::holding;
  }
  if (status_ == TrackStatus::tracking) return TrackStatus::tracking;
  return verdict == Verdict::bad ? TrackStatus::holding : TrackStatus::tracking;
}

TrackStatus LossDetector::next_while_lost(Verdict verdict, double dt) {
  time_in_state_ += dt;
  if (verdict == Verdict::good && good_ >= params_.good_frames) return TrackStatus::tracking;
  const bool forgotten = status_ == TrackStatus::lost && time_in_state_ > params_.forget_time;
  return forgotten ? TrackStatus::searching : status_;
}

void LossDetector::enter(TrackStatus status) {
  // A run of bad frames outlives the change between tracking and holding; nothing else is carried over.
  const bool still_tracked = (status == TrackStatus::tracking || status == TrackStatus::holding) &&
                             (status_ == TrackStatus::tracking || status_ == TrackStatus::holding);
  if (!still_tracked) bad_ = 0;
  good_ = 0;
  if (status != TrackStatus::holding || !still_tracked) time_in_state_ = 0;
  status_ = status;
}

}  // namespace barehand
