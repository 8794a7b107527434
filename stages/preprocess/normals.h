#pragma once

#include <vector>

#include "observe/observation.h"

namespace barehand {

/// Normals of the hand pixels in `mask` from least-squares planes through the depth around them: a grid of 5 x 5
/// samples that spans +-radius [m], only hand samples on the same surface, so neither edges nor objects bend them. Zero
/// where fewer than six samples agree. Fills `out.normal`; needs frame, depth, hand_pixels (those of `mask`), u0 and
/// v0.
class NormalFitter {
 public:
  void fit(const Image<std::uint8_t>& mask, double radius, HandObservation& out);

 private:
  Image<float> padded_;  // depth of the hand pixels alone, with a border
};

/// Keeps its allocation.
class NoiseMeter {
 public:
  /// 1-sigma depth noise [m] of the hand pixels: median of third differences along the rows, which smooth curvature
  /// does not reach; every second pixel, because sensors correlate neighbours. At least `floor`.
  double measure(const Image<std::uint8_t>& mask, const Image<float>& depth, double floor);

 private:
  std::vector<float> differences_;
};

}  // namespace barehand
