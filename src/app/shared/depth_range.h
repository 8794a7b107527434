#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sensor/rgbd_frame.h"
#include "stages/preprocess/params.h"

namespace barehand {

/// Range of depth in which the tracker searches for a hand [m]; by default that of PreprocessParams.
struct DepthLimits {
  double nearest = PreprocessParams{}.min_depth, farthest = PreprocessParams{}.max_depth;
};

/// Checks in the first second of a camera's frames whether any depth lies in the range in which a hand is searched for.
/// If none does, the depth unit may be wrong.
class DepthRange {
 public:
  explicit DepthRange(const DepthLimits& limits) : limits_(limits) {}

  /// Adds a frame. Returns a warning for the user, usually none.
  std::optional<std::string> add(const RgbdFrame& frame);
  /// Must be called after the last frame. Returns a warning for the user, if there is one, as add() does.
  std::optional<std::string> finish();

 private:
  std::optional<std::string> conclude();

  DepthLimits limits_;
  bool done_ = false;
  int frames_ = 0;
  std::int64_t first_utime_ = 0;
  double unit_ = 0;                    // metres per unit of `values_`
  std::int64_t within_ = 0;            // number of `values_` within the limits
  std::vector<std::uint16_t> values_;  // a sample of the measured depths, in units of `unit_`
};

}  // namespace barehand
