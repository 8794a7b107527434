#include "stages/known_object/object_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

namespace barehand {
namespace {

using Eigen::Vector3d;

constexpr double kAway = 0.1;  // least cosine between the line of sight and the normal of a visible surface
// Steps towards the camera [m], and their number, in which the side of a thin wall that faces the camera is looked for.
// A search, which starts far off, does without.
constexpr double kThrough = 0.002;
constexpr int kThroughSteps = 6;
constexpr double kStep = 1e-4;      // the iterations end with smaller steps than this [m, rad]
constexpr double kLeastTurn = 0.3;  // information about a rotation that nothing shows, as if it were known to 1.8 rad

bool faces_camera(const SurfaceResidual& residual, const Vector3d& sight) {
  return residual.normal.dot(sight) <= -kAway * residual.normal.norm();
}

/// The residual of the surface that faces the camera. A point behind the middle of a thin wall is nearer to the wall's
/// other side, which the camera does not see: the plane of the side that it sees takes its place. None: the nearest
/// surface is not seen, and no wall is between the point and the camera. `steps`: how many are looked for it.
std::optional<SurfaceResidual> visible_residual(const DistanceGrid& grid, const SE3& T, const Eigen::Vector3f& point,
                                                int steps) {
  const Vector3d at = point.cast<double>(), sight = at.normalized();
  SurfaceResidual residual = surface_residual(grid, T, point);
  if (faces_camera(residual, sight)) return residual;

  // Step towards the camera until the surface faces it.
  bool within = residual.value < 0;
  for (int step = 1; step <= steps; ++step) {
    const Vector3d back = step * kThrough * sight;
    residual = surface_residual(grid, T, (at - back).cast<float>());
    within = within || residual.value < 0;
    if (!faces_camera(residual, sight)) continue;
    if (!within) break;
    residual.value += residual.normal.dot(back);
    residual.gradient.tail<3>() = residual.normal.cross(at - T.t);
    return residual;
  }
  return std::nullopt;
}

}  // namespace

SurfaceResidual surface_residual(const DistanceGrid& grid, const SE3& T, const Eigen::Vector3f& point) {
  const Vector3d arm = point.cast<double>() - T.t;
  const DistanceGrid::Sample sample = grid.sample((T.R.transpose() * arm).cast<float>());
  SurfaceResidual residual;
  residual.value = sample.distance;
  residual.normal = T.R * sample.gradient.cast<double>();
  residual.gradient << -residual.normal, residual.normal.cross(arm);
  return residual;
}

FittedPose fit_pose(const KnownObject& object, std::span<const Eigen::Vector3f> points, double sigma, const SE3& start,
                    const PosePrior& prior, int iterations, double coarse) {
  FittedPose fitted{start, Matrix6d::Identity()};
  SE3& T = fitted.T_camera_object;
  const double unit = 1 / (kTogether * sigma * sigma);
  Matrix6d information = prior.information;
  for (int i = 0; i < iterations; ++i) {
    // Begin with the prior. Iterations at the start see farther.
    const double wider = std::max(1.0, coarse * (1 - 2.0 * i / iterations));
    const double scale_sq = 4 * sigma * sigma * wider * wider;
    information = prior.information;
    information.diagonal().tail<3>().array() += kLeastTurn;
    Vector6d force = -prior.information * boxminus(T, prior.T_camera_object);

    // Add the points.
    for (const Eigen::Vector3f& point : points) {
      const auto r = visible_residual(object.grid, T, point, coarse > 1 ? 0 : kThroughSteps);
      if (!r) continue;
      const double root = scale_sq / (scale_sq + r->value * r->value), weight = unit * root * root;
      information.noalias() += weight * r->gradient * r->gradient.transpose();
      force -= weight * r->value * r->gradient;
    }

    // Make a Gauss-Newton step.
    information.diagonal().array() += 1e-9 * information.trace();
    const Vector6d step = information.ldlt().solve(force);
    if (!step.allFinite()) break;
    T = boxplus(T, step);
    if (step.norm() < kStep && wider == 1) break;
  }

  // Return the pose with a proper rotation, and its covariance.
  T.R = orthonormalised(T.R);
  fitted.covariance = information.inverse();
  return fitted;
}

}  // namespace barehand
