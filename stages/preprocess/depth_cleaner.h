#pragma once

#include <vector>

#include "sensor/rgbd_frame.h"
#include "stages/preprocess/params.h"

namespace barehand {

/// Part of a frame: columns [u0, u0 + width), rows [v0, v0 + height).
struct Region {
  int u0 = 0, v0 = 0, width = 0, height = 0;
};

/// Depth of a region in metres without flying pixels: those between two surfaces, seen by hardly a neighbour at their
/// own depth. They and what is nearer than the working range become 0.
/// `edge`: 1 where one of the eight neighbours is not on the same surface or has no depth; same size.
class DepthCleaner {
 public:
  void clean(const RgbdFrame& frame, const PreprocessParams& params, const Region& region, Image<float>& depth,
             Image<std::uint8_t>& edge);

 private:
  Image<float> raw_;               // with a border of one empty pixel
  std::vector<float> companions_;  // of the current row
};

}  // namespace barehand
