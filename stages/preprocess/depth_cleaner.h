#pragma once

#include <vector>

#include "sensor/rgbd_frame.h"
#include "stages/preprocess/params.h"

namespace barehand {

/// Part of a frame: columns [u0, u0 + width), rows [v0, v0 + height).
struct Region {
  int u0 = 0, v0 = 0, width = 0, height = 0;
};

/// Computes the depth of a region [m] without flying pixels, which are between two surfaces and have hardly a neighbour
/// at their own depth. These pixels, and those nearer than the working range, become 0. `edge` becomes 1 where one of
/// the eight neighbours is not on the same surface or has no depth. Both outputs have the size of the region.
class DepthCleaner {
 public:
  void clean(const RgbdFrame& frame, const PreprocessParams& params, const Region& region, Image<float>& depth,
             Image<std::uint8_t>& edge);

 private:
  Image<float> raw_;               // depth [m] with a border of one empty pixel
  std::vector<float> neighbours_;  // for each pixel of the current row, its neighbours at the same depth
};

}  // namespace barehand
