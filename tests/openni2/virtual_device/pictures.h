#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "math/frame.h"

namespace barehand::virtual_openni {

/// Rendered beforehand, so that a sensor of 120 Hz costs no more than copying.
struct Pictures {
  /// Played forth and back: the motion never jumps, and no picture follows itself unless the exposure where it turns is
  /// left out.
  std::vector<FramePtr> frames;

  const RgbdFrame& at(std::int64_t index) const;
  const Intrinsics& camera() const { return frames.front()->camera; }
};

/// Pixels of the same ray by row; depth counts of 100 um below 65535: what the sensor delivers at its best.
Result<Pictures> render_pictures(const std::string& sim, int count);

}  // namespace barehand::virtual_openni
