#pragma once

#include <span>
#include <vector>

#include "object/known_object.h"

namespace barehand {

/// The signed distance of a point of the camera frame from the surface of a posed object [m].
struct SurfaceResidual {
  double value = 0;
  Vector6d gradient = Vector6d::Zero();  ///< derivative with respect to the boxplus twist of the object's pose
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< outward normal of the nearest surface, camera frame
};
SurfaceResidual surface_residual(const DistanceGrid& grid, const SE3& T_camera_object, const Eigen::Vector3f& point);

/// What is known of a pose before the points are used: a normal distribution with this inverse covariance.
struct PosePrior {
  SE3 T_camera_object;
  Matrix6d information = Matrix6d::Zero();
};

/// Neighbouring points err together, so that this many of those on which a pose is refined count as one: k below.
constexpr double kTogether = 2.4;

/// A pose that fits points.
struct FittedPose {
  SE3 T_camera_object;
  Matrix6d covariance = Matrix6d::Identity();  ///< covariance of the boxplus twist, from the normal equations
};

/// Fits the pose of an object to points of its surface by Gauss-Newton iterations:
///
///     E(T) = sum rho(d(T^-1 p_i)) / (k sigma^2) + prior,  rho(r) = r^2 s^2 / (s^2 + r^2)  (Geman and McClure)
///
/// d is the signed distance, and s = 2 sigma.
/// Points whose nearest surface faces away from the camera count nothing, unless `coarse` is 1 and they are in or
/// behind a thin wall: d is then the distance from the side that the camera sees. In the first half of the iterations s
/// is up to `coarse` times as large: with 6, start from a pose that is off by no more than about 20 degrees and 20 mm;
/// with 1, by no more than a few millimetres, and other things nearby disturb little.
FittedPose fit_pose(const KnownObject& object, std::span<const Eigen::Vector3f> points, double sigma, const SE3& start,
                    const PosePrior& prior, int iterations, double coarse = 6);

}  // namespace barehand
