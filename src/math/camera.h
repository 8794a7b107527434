#pragma once

#include <Eigen/Core>

namespace barehand {

/// A pinhole camera without distortion. Camera frame: x right, y down, z forward (as in OpenCV and ROS `_optical`), in
/// metres. Pixel centres have integer coordinates.
struct Intrinsics {
  int width = 0;
  int height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;

  bool valid() const { return width > 0 && height > 0 && fx > 0 && fy > 0; }
  bool operator==(const Intrinsics&) const = default;

  /// Projects a point in the camera frame with z > 0 to pixel coordinates (u, v).
  Eigen::Vector2d project(const Eigen::Vector3d& p) const { return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy}; }
  /// The point in the camera frame at the depth z [m], measured along the optical axis, not along the ray.
  Eigen::Vector3d unproject(double u, double v, double z) const { return {(u - cx) / fx * z, (v - cy) / fy * z, z}; }
};

}  // namespace barehand
