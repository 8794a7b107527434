#pragma once

#include "observe/observation.h"

namespace barehand {

/// Normals of the hand pixels in `mask` from least-squares planes through the depth around them: a grid of 5 x 5
/// samples that spans +-radius [m], only hand samples on the same surface, so neither edges nor objects bend them. Zero
/// where fewer than six samples agree. Fills `out.normal`; needs `out.frame`, `out.depth`, `u0`, `v0`.
void fit_normals(const Image<std::uint8_t>& mask, double radius, HandObservation& out);

/// 1-sigma depth noise [m] of the hand pixels: median of third differences along the rows, which smooth curvature
/// does not reach; every second pixel, because sensors correlate neighbours. At least `floor`.
double measure_noise(const Image<std::uint8_t>& mask, const Image<float>& depth, double floor);

}  // namespace barehand
