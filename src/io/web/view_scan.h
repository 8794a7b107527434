#pragma once

#include <string>
#include <vector>

namespace barehand {

/// What was seen of one segment during a scan, and what became of its length.
struct ViewScanSegment {
  std::string name;
  int palm_side = 0, back_side = 0;  ///< frames in which that side faced the sensor
  double bent = 0;                   ///< range of its joint that was seen [rad]
  bool to_bend = false;              ///< whether bending it is asked for
  double before = 0, after = 0;      ///< its length in the profile [m]
};

/// How far the scan of a hand has come, for the page.
struct ViewScan {
  enum class Phase { showing, measuring, done } phase = Phase::showing;
  std::string how_to;                ///< what the user is to do, in all
  std::vector<std::string> missing;  ///< sentences: what is still to be shown, most important first
  std::string progress;              ///< a sentence: of the measuring, or what came of it
  int frames = 0;                    ///< tracked so far
  int enough_frames = 0;             ///< a side
  double enough_bending = 0;         ///< [rad]
  std::vector<ViewScanSegment> segments;
};

}  // namespace barehand
