#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "hand/hand_pose.h"
#include "math/camera.h"

namespace barehand {

// Functions that all parts of an overlay use: cameras, pixels and ends of segments.

/// Whether a segment was estimated from this frame's data.
inline bool is_measured(const HandEstimate& estimate, int segment) {
  return estimate.status == TrackStatus::tracking && estimate.segments[segment].seen;
}

/// The camera whose images are `scale` times as large. Pixel centres have integer coordinates, so the principal point
/// changes by more than the factor: enlarging keeps the edges of pixels in place, not their centres.
inline Intrinsics enlarged(const Intrinsics& camera, int scale) {
  return {camera.width * scale, camera.height * scale,           camera.fx * scale,
          camera.fy * scale,    (camera.cx + 0.5) * scale - 0.5, (camera.cy + 0.5) * scale - 0.5};
}

inline constexpr int kFractionBits = 4;  ///< fractional bits of the fixed-point coordinates that OpenCV gets

/// The pixel of a point in the camera frame with kFractionBits fractional bits; none if it is behind the camera or so
/// far outside that its coordinates would not fit.
inline std::optional<cv::Point> pixel_of(const Intrinsics& camera, const Eigen::Vector3d& p) {
  constexpr double kFar = 1e5;  // pixels
  if (!(p.z() > 0.01)) return {};
  const Eigen::Vector2d pixel = camera.project(p);
  if (!(pixel.cwiseAbs().maxCoeff() < kFar)) return {};
  return cv::Point(cvRound(pixel.x() * (1 << kFractionBits)), cvRound(pixel.y() * (1 << kFractionBits)));
}

/// The proximal and the distal end of a segment in the camera frame [m].
inline Eigen::Vector3d proximal_end_of(const HandEstimate& estimate, int segment) {
  return estimate.segments[segment].T_camera_segment.t;
}
inline Eigen::Vector3d distal_end_of(const HandEstimate& estimate, int segment) {
  return estimate.segments[segment].T_camera_segment * estimate.profile->segments[segment].distal;
}

}  // namespace barehand
