#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "math/camera.h"

namespace barehand {

/// Back-projects pixels of a region of interest by table look-up instead of a division per pixel. The results equal
/// those of HandObservation::point() bit by bit. The tables keep their allocation from call to call.
class PixelRays {
 public:
  /// Computes the tables for a region whose pixel (0, 0) is pixel (u0, v0) of the camera image.
  void reset(const Intrinsics& camera, int u0, int v0, int width, int height) {
    width_ = width;
    inverse_width_ = 1.0 / width;
    x_.resize(width);
    y_.resize(height);
    for (int u = 0; u < width; ++u) x_[u] = static_cast<float>((u + u0 - camera.cx) / camera.fx);
    for (int v = 0; v < height; ++v) y_[v] = static_cast<float>((v + v0 - camera.cy) / camera.fy);
  }

  /// The point of pixel (u, v) of the region at the depth z [m], in the camera frame [m].
  Eigen::Vector3f point(int u, int v, float z) const { return {x_[u] * z, y_[v] * z, z}; }
  /// The point of the pixel with this index at its measured depth, in the camera frame [m].
  Eigen::Vector3f point(std::int32_t pixel, const Image<float>& depth) const {
    const int v = row_of(pixel);
    return point(pixel - v * width_, v, depth[pixel]);
  }
  /// Exactly pixel / width, because both are far below 2^53, up to which a double is exact.
  int row_of(std::int32_t pixel) const { return static_cast<int>((pixel + 0.5) * inverse_width_); }

 private:
  int width_ = 0;
  double inverse_width_ = 0;
  std::vector<float> x_, y_;
};

}  // namespace barehand
