#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "io/lcm/log_recorder.h"
#include "io/web/view_scan.h"
#include "math/se3.h"

namespace barehand {

/// Frames without a pose, by position in the log: the first and the last one.
struct LostFrames {
  std::int64_t first = 0, last = 0;
};

/// Where a log that is played stands.
struct PlayedLog {
  std::int64_t frames = 0, position = 0;  ///< position: of the frame shown, from 0
  double seconds = 0;                     ///< from the first frame to the last
  double at = 0;                          ///< from the first frame to the one shown [s]
  bool playing = false;
  double speed = 1;
  std::vector<LostFrames> lost;  ///< in order
};

inline constexpr std::int64_t kStatusPeriodUs = 500'000;  ///< between two status messages
inline constexpr std::int64_t kNoFramesUs = 2'000'000;    ///< after so long without a frame the status says so

/// What the page says besides frames.
struct ViewState {
  std::string source;   ///< where frames come from, for people
  bool live = false;    ///< frames come in real time
  std::string trouble;  ///< why nothing comes, a sentence; "": all is well
  int clients = 0;
  std::optional<PipelineHealth> health;      ///< none: not known
  std::optional<PlayedLog> log;              ///< none: nothing to play
  std::optional<SE3> T_world_camera = {};    ///< none: the room is not known (sensor/camera_placement.h)
  std::optional<ViewScan> scan = {};         ///< none: no hand is being scanned
  std::optional<RecorderState> record = {};  ///< none: there is nothing to record
};

/// {"type": "status", ...}, as docs/view_protocol.md lists it. What is not known is null.
std::string status_json(const ViewState& state);

}  // namespace barehand
