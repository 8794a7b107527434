#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "sensor/rgbd_frame.h"

namespace barehand::virtual_openni {

/// The images that the virtual sensor exposes. They are rendered beforehand, so that even at 120 Hz only copying is
/// left to do.
struct Pictures {
  /// Played forth and back, so that the motion never jumps. An image can follow itself only if the exposure at a
  /// turning point is left out.
  std::vector<FramePtr> frames;

  /// The image for the exposure with this index.
  const RgbdFrame& at(std::int64_t index) const;
  const Intrinsics& camera() const { return frames.front()->camera; }
};

/// Renders `count` images of a simulated scene at most, with depth in counts of 100 um below 65535 and colour
/// registered to depth: what the sensor delivers in its best mode.
Result<Pictures> render_pictures(const std::string& sim, int count);

}  // namespace barehand::virtual_openni
