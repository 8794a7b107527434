#pragma once

#include <vector>

#include "observe/observation.h"

namespace barehand {

// Normals and depth noise of the hand's pixels.

/// Computes the normals of the hand pixels in `mask` from least-squares planes through the depth around them: a grid of
/// 5 x 5 samples that spans +-radius [m]. Only hand samples on the same surface are used, so that neither edges nor
/// objects affect a normal. A normal is zero where fewer than six samples agree. fit() fills `out.normal`; it needs the
/// members frame, depth, hand_pixels (those of `mask`), u0 and v0 of `out`.
class NormalFitter {
 public:
  void fit(const Image<std::uint8_t>& mask, double radius, HandObservation& out);

 private:
  Image<float> padded_;  // depth of the hand pixels only, with a border
};

/// Estimates the depth noise of a frame. Reuses its memory.
class NoiseMeter {
 public:
  /// Returns the 1-sigma depth noise [m] of the hand pixels, at least `floor`. It is the median of third differences
  /// along the rows, on which smooth curvature has no effect; they use every second pixel, because the noise of
  /// neighbours is correlated.
  double measure(const Image<std::uint8_t>& mask, const Image<float>& depth, double floor);

 private:
  std::vector<float> differences_;
};

}  // namespace barehand
