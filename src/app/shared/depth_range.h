#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sensor/rgbd_frame.h"
#include "stages/preprocess/params.h"

namespace barehand {

/// Where the tracker looks for a hand [m]; by default as PreprocessParams does.
struct DepthLimits {
  double nearest = PreprocessParams{}.min_depth, farthest = PreprocessParams{}.max_depth;
};

/// Looks at the first second of a camera's frames: whether anything lies where a hand is looked for.
class DepthRange {
 public:
  explicit DepthRange(const DepthLimits& limits) : limits_(limits) {}

  /// What is to be said after this frame; most often nothing.
  std::optional<std::string> look(const RgbdFrame& frame);
  /// The same when no more frames come.
  std::optional<std::string> finish();

 private:
  std::optional<std::string> conclude();

  DepthLimits limits_;
  bool done_ = false;
  int frames_ = 0;
  std::int64_t first_utime_ = 0;
  double unit_ = 0;                    // m
  std::int64_t within_ = 0;            // of the values
  std::vector<std::uint16_t> values_;  // some of the measured ones
};

}  // namespace barehand
