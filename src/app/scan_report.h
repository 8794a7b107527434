#pragma once

#include <array>
#include <string>
#include <vector>

#include "hand/hand_pose.h"

namespace barehand {

/// What a scan has shown of one segment.
struct ScannedSegment {
  int seen = 0;                          ///< tracked frames in which it was
  int palm_side = 0, back_side = 0;      ///< of these, from there
  double least_bent = 0, most_bent = 0;  ///< of these, flexion of its joint [rad]; the palm's: zeros
};

/// What a hand that is fitted while it is tracked can be known from: skin from both sides, joints from bending them.
class ScanReport {
 public:
  static constexpr int kEnoughFrames = 15;       ///< of a side
  static constexpr double kEnoughBending = 0.5;  ///< [rad]

  /// Frames in which the hand is not tracked say nothing.
  void add(const HandEstimate& estimate);

  int frames() const { return frames_; }
  const ScannedSegment& segment(int s) const { return segments_[s]; }
  /// What is still to be shown, a sentence each; none: everything was seen.
  std::vector<std::string> missing() const;

 private:
  std::array<ScannedSegment, kSegmentCount> segments_;
  int frames_ = 0;
};

}  // namespace barehand
