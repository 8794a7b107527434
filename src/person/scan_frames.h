#pragma once

#include <vector>

#include "person/skin_scan.h"

namespace barehand {

/// Selects the frames that scan_hand uses: evenly spread over the whole scan, however long it lasts, except for its
/// beginning, when the hand is not yet known well enough to be tracked precisely.
class ScanFrames {
 public:
  static constexpr int kFewest = 24;  ///< fewer frames do not determine the skin

  /// `settling`: tracked frames to leave out at the beginning; `most`: number of frames to keep.
  ScanFrames(int settling, int most) : settling_(settling), most_(most) {}

  /// Counts a tracked frame; returns whether it should be kept.
  bool wants();
  /// Keeps a frame; if there are too many, every other one is dropped.
  void keep(HandObservationPtr observation, const HandPose& pose);
  /// Counts the frame, and keeps it if wants() says so. Frames in which the hand is not tracked are ignored.
  void add(const HandObservationPtr& observation, const HandEstimate& estimate);
  const std::vector<ScanFrame>& frames() const { return frames_; }
  int tracked() const { return tracked_; }

 private:
  int settling_, most_;
  std::vector<ScanFrame> frames_;
  int tracked_ = 0, every_ = 1;
};

}  // namespace barehand
