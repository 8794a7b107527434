#pragma once

#include <vector>

#include "stages/refinement/skin_scan.h"

namespace barehand {

/// Keeps frames of a scan for scan_hand: evenly spread over all of it, however long it lasts, but for its beginning,
/// when the hand is not yet known well enough to be followed closely.
class ScanFrames {
 public:
  static constexpr int kFewest = 24;  ///< fewer say too little about a skin

  /// `settling`: tracked frames at the beginning; `most`: frames to keep.
  ScanFrames(int settling, int most) : settling_(settling), most_(most) {}

  /// Counts a tracked frame; whether it is to be kept.
  bool wants();
  void keep(HandObservationPtr observation, const HandPose& pose);
  /// Both. A frame in which the hand is not tracked does not count.
  void add(const HandObservationPtr& observation, const HandEstimate& estimate);
  const std::vector<ScanFrame>& frames() const { return frames_; }
  int tracked() const { return tracked_; }

 private:
  int settling_, most_;
  std::vector<ScanFrame> frames_;
  int tracked_ = 0, every_ = 1;
};

}  // namespace barehand
