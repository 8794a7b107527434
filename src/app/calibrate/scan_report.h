#pragma once

#include <array>
#include <string>
#include <vector>

#include "hand/hand_pose.h"

namespace barehand {

// The report of which parts of the hand a scan has not seen yet.

/// What was seen of one segment during a scan.
struct ScannedSegment {
  int seen = 0;                      ///< number of tracked frames in which the segment was seen
  int palm_side = 0, back_side = 0;  ///< numbers of those frames in which the palm side or the back faced the camera
  /// Smallest and largest flexion of its joint in these frames [rad]; zeros for the palm.
  double least_bent = 0, most_bent = 0;
};

/// Tells the user what is still to be shown: a hand can only be fitted where its skin was seen from both sides and its
/// joints were bent.
class ScanReport {
 public:
  static constexpr int kEnoughFrames = 15;       ///< frames that must show each side of a segment
  static constexpr double kEnoughBending = 0.5;  ///< range of flexion that a joint must show [rad]

  /// Whether the user is asked to bend the joint of segment `s`; the thumb's metacarpal is left out, since it moves too
  /// little.
  static bool asks_to_bend(int s) { return s != kPalm && s != segment_of(0, 0); }

  /// Adds a frame; frames in which the hand is not tracked are ignored.
  void add(const HandEstimate& estimate);

  int frames() const { return frames_; }
  const ScannedSegment& segment(int s) const { return segments_[s]; }
  /// One sentence for each kind of view or motion that is still missing; empty if everything was seen.
  std::vector<std::string> missing() const;

 private:
  std::array<ScannedSegment, kSegmentCount> segments_;
  int frames_ = 0;
};

}  // namespace barehand
