#pragma once

#include <Eigen/Core>

namespace barehand {

/// Pinhole camera without distortion. Camera frame: x right, y down, z forward (OpenCV, ROS `_optical`); metres.
/// Pixel centres lie at integer coordinates.
struct Intrinsics {
  int width = 0;
  int height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;

  bool valid() const { return width > 0 && height > 0 && fx > 0 && fy > 0; }
  bool operator==(const Intrinsics&) const = default;

  /// Pixel (u, v) of a camera-frame point with z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& p) const { return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy}; }
  /// Camera-frame point at depth z [m] (along the optical axis, not the ray).
  Eigen::Vector3d unproject(double u, double v, double z) const { return {(u - cx) / fx * z, (v - cy) / fy * z, z}; }
};

}  // namespace barehand
