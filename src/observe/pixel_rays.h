#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "math/camera.h"

namespace barehand {

/// Points of a region of interest without a division per pixel: HandObservation::point() from tables, bit by bit the
/// same. Keeps its allocations.
class PixelRays {
 public:
  /// The region's pixel (0, 0) is pixel (u0, v0) of the camera.
  void reset(const Intrinsics& camera, int u0, int v0, int width, int height) {
    width_ = width;
    inverse_width_ = 1.0 / width;
    x_.resize(width);
    y_.resize(height);
    for (int u = 0; u < width; ++u) x_[u] = static_cast<float>((u + u0 - camera.cx) / camera.fx);
    for (int v = 0; v < height; ++v) y_[v] = static_cast<float>((v + v0 - camera.cy) / camera.fy);
  }

  /// Camera frame [m], of a pixel of the region at depth z [m].
  Eigen::Vector3f point(int u, int v, float z) const { return {x_[u] * z, y_[v] * z, z}; }
  /// Of the pixel with this index, at the depth measured there.
  Eigen::Vector3f point(std::int32_t pixel, const Image<float>& depth) const {
    const int v = row_of(pixel);
    return point(pixel - v * width_, v, depth[pixel]);
  }
  /// pixel / width, exactly: pixel and width fit many times into a double's 53 bits.
  int row_of(std::int32_t pixel) const { return static_cast<int>((pixel + 0.5) * inverse_width_); }

 private:
  int width_ = 0;
  double inverse_width_ = 0;
  std::vector<float> x_, y_;
};

}  // namespace barehand
