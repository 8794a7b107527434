#pragma once

#include "core/image.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Range of depths that is shown in colours [m].
struct ColouredDepths {
  double near = 0, far = 1;
};
/// The range that contains the middle 96 % of a frame's valid depths; the default range if there are none.
ColouredDepths typical_range(const RgbdFrame& frame);

/// Depth in the colours of the Turbo map: near is red, far is blue, values out of range are darkened, and missing
/// depth is black.
Image<Rgb> depth_colours(const RgbdFrame& frame, const ColouredDepths& range);

}  // namespace barehand
