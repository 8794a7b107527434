#pragma once

#include <string>
#include <vector>

namespace barehand {

/// How well one segment was seen during a scan of the hand, and its length before and after.
struct ViewScanSegment {
  std::string name;
  int palm_side = 0, back_side = 0;  ///< frames in which that side faced the sensor
  double bent = 0;                   ///< range of flexion of the segment's joint that was seen [rad]
  bool to_bend = false;              ///< whether the user is asked to bend this joint
  double before = 0, after = 0;      ///< length of the segment before and after the scan [m]
};

/// The progress of a scan of the hand, as the page shows it.
struct ViewScan {
  enum class Phase { showing, measuring, done } phase = Phase::showing;
  std::string how_to;                ///< instructions for the user
  std::vector<std::string> missing;  ///< views and motions that the user must still show, one sentence each
  std::string progress;              ///< a sentence on the progress of the measurement, or on its result
  int frames = 0;                    ///< number of frames tracked so far
  int enough_frames = 0;             ///< number of frames that suffice for a side of a segment
  double enough_bending = 0;         ///< range of flexion that suffices [rad]
  std::vector<ViewScanSegment> segments;
};

}  // namespace barehand
