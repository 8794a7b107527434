#pragma once

#include <cstdint>
#include <optional>

#include "core/image.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Range of depths that is shown in colours [m].
struct ColouredDepths {
  double near = 0, far = 1;
};
/// The range that contains the middle 96 % of a frame's valid depths; the default range if there are none.
ColouredDepths typical_range(const RgbdFrame& frame);

/// A range that follows the frames' own within half a second, so that the colour of a depth does not jump.
class SteadyRange {
 public:
  /// The range for the frame at `utime` [us], for which `own` would suit best. The first frame, and one that lies
  /// before the last, as after a jump in a log, has its own.
  ColouredDepths follow(const ColouredDepths& own, std::int64_t utime);

 private:
  std::optional<ColouredDepths> range_;
  std::int64_t utime_ = 0;  // of the last frame
};

/// Depth in the colours of the Turbo map: near is red, far is blue, values out of range are darkened, and missing
/// depth is black.
Image<Rgb> depth_colours(const RgbdFrame& frame, const ColouredDepths& range);

}  // namespace barehand
