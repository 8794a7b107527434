#include "app/scan_frames.h"

namespace barehand {

void ScanFrames::add(const HandObservationPtr& observation, const HandEstimate& estimate) {
  if (estimate.status != TrackStatus::tracking || tracked_++ < kSettling) return;
  if ((tracked_ - kSettling - 1) % every_ != 0) return;
  ScanFrame frame{observation, {}};
  for (int s = 0; s < kSegmentCount; ++s) frame.pose[s] = estimate.segments[s].T_camera_segment;
  frames_.push_back(std::move(frame));
  if (static_cast<int>(frames_.size()) <= kMost) return;
  for (std::size_t i = 0; 2 * i < frames_.size(); ++i) frames_[i] = frames_[2 * i];
  frames_.resize((frames_.size() + 1) / 2);
  every_ *= 2;
}

}  // namespace barehand
