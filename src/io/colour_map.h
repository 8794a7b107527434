#pragma once

#include "core/image.h"
#include "math/frame.h"

namespace barehand {

/// Distances shown in colours [m].
struct DepthRange {
  double near = 0, far = 1;
};
/// The range that holds the middle 96 % of a frame's measurements; all of it for a frame without any.
DepthRange typical_range(const RgbdFrame& frame);

/// Depth in rainbow colours (Turbo): near is red, far is blue; outside the range darkened, no measurement black.
Image<Rgb> depth_colours(const RgbdFrame& frame, const DepthRange& range);

}  // namespace barehand
