#include "person/scan_frames.h"

#include <utility>

namespace barehand {

bool ScanFrames::wants() { return tracked_++ >= settling_ && (tracked_ - settling_ - 1) % every_ == 0; }

void ScanFrames::keep(HandObservationPtr observation, const HandPose& pose) {
  frames_.push_back({std::move(observation), pose});
  if (static_cast<int>(frames_.size()) <= most_) return;
  for (std::size_t i = 0; 2 * i < frames_.size(); ++i) frames_[i] = frames_[2 * i];
  frames_.resize((frames_.size() + 1) / 2);
  every_ *= 2;
}

void ScanFrames::add(const HandObservationPtr& observation, const HandEstimate& estimate) {
  if (estimate.status == TrackStatus::tracking && wants()) keep(observation, pose_of(estimate.segments));
}

}  // namespace barehand
