#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "io/lcm/log_recorder.h"
#include "io/web/view_scan.h"
#include "math/se3.h"

namespace barehand {

// The status of the program, as the live page shows it.

/// A sequence of frames without a pose: positions of the first and the last one in the log.
struct LostFrames {
  std::int64_t first = 0, last = 0;
};

/// The state of a log that is played.
struct PlayedLog {
  std::int64_t frames = 0, position = 0;  ///< number of frames; position of the frame shown, from 0
  double seconds = 0;                     ///< time from the first frame to the last [s]
  double at = 0;                          ///< time from the first frame to the one shown [s]
  bool playing = false;
  double speed = 1;
  std::vector<LostFrames> lost;  ///< in the order of time
};

inline constexpr std::int64_t kStatusPeriodUs = 500'000;  ///< time between two status messages [us]
inline constexpr std::int64_t kNoFramesUs = 2'000'000;  ///< time without a frame after which the status reports it [us]

/// What the page shows besides frames.
struct ViewState {
  std::string source;   ///< name of the source of frames, for display
  bool live = false;    ///< whether frames arrive in real time
  std::string trouble;  ///< why no frames arrive, as a sentence; empty while they do
  int clients = 0;
  std::optional<PipelineHealth> health;      ///< none: unknown
  std::optional<PlayedLog> log;              ///< none: nothing to play
  std::optional<SE3> T_world_camera = {};    ///< none: the camera's pose is unknown (sensor/camera_placement.h)
  std::optional<ViewScan> scan = {};         ///< none: no hand is being scanned
  std::optional<RecorderState> record = {};  ///< none: there is nothing to record
  /// Whose skin is drawn, by Handedness: the name of a profile, "" for the average hand. None: that of the tracked
  /// hand.
  std::optional<std::array<std::string, 2>> drawn = {};
};

/// The status message {"type": "status", ...} of docs/view_protocol.md. Unknown parts are null.
std::string status_json(const ViewState& state);

}  // namespace barehand
