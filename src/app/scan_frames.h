#pragma once

#include <vector>

#include "stages/refinement/skin_scan.h"

namespace barehand {

/// Keeps frames of a scan for scan_hand: evenly spread over all of it, however long it lasts, but for its beginning,
/// when the hand is not yet known well enough to be followed closely.
class ScanFrames {
 public:
  static constexpr int kMost = 64;
  static constexpr int kFewest = 24;    ///< fewer say too little about a skin
  static constexpr int kSettling = 60;  ///< tracked frames at the beginning

  /// Frames in which the hand is not tracked do not count.
  void add(const HandObservationPtr& observation, const HandEstimate& estimate);
  const std::vector<ScanFrame>& frames() const { return frames_; }

 private:
  std::vector<ScanFrame> frames_;
  int tracked_ = 0, every_ = 1;
};

}  // namespace barehand
