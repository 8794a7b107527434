#pragma once

#include <span>

#include "observe/registration/observed_cloud.h"
#include "observe/registration/visible_points.h"

namespace barehand {

// Rigid registration of a hand's surface to the depth data of a frame (ICP, iterative closest points).

/// Settings of the rigid registration of a posed hand surface to a frame (paper Sec. 4.4 and its reference [2]).
struct RegistrationParams {
  bool enabled = true;
  int model_points = 200;
  int iterations = 30;
  double scale_start = 0.030;
  double scale_end = 0.004;
  double point_weight = 0.03;
  int min_points = 100;
  double min_inliers = 0.5;
  double slack = 0.03;
  bool operator==(const RegistrationParams&) const = default;
};

template <class V>
void visit(V& v, RegistrationParams& p) {
  v("enabled", p.enabled, "align rigidly by ICP (Sec. 4.4); false: no motion is estimated");
  v("model_points", p.model_points, 20, 100000, "number of visible surface points that are used");
  v("iterations", p.iterations, 1, 200, "maximum number of iterations from each start");
  v("scale_start", p.scale_start, 1e-3, 1.0, "m, Geman-McClure scale of the first iteration");
  v("scale_end", p.scale_end, 1e-4, 1.0, "m, Geman-McClure scale of the last iteration");
  v("point_weight", p.point_weight, 1e-6, 1.0,
    "weight of the point-to-point residuals, relative to point-to-plane, in the last iteration; 1 in the first");
  v("min_points", p.min_points, 3, 1000000, "minimum number of observed points; with fewer, no motion is estimated");
  v("min_inliers", p.min_inliers, 0.0, 1.0, "minimum fraction of the model points in view that must match");
  v("slack", p.slack, 0.0, 1.0, "m, motion that is accepted at any frame interval (rotation: slack / 0.1 m)");
}

/// Settings of the registration of the previous hand surface to the new frame, which yields the large global motion.
/// The largest accepted motion is `slack` plus these speeds times the frame interval.
struct IcpParams : RegistrationParams {
  double max_speed = 4.0;
  double max_angular_speed = 20;
  bool operator==(const IcpParams&) const = default;
};

template <class V>
void visit(V& v, IcpParams& p) {
  visit(v, static_cast<RegistrationParams&>(p));
  v("max_speed", p.max_speed, 0.0, 100.0, "m/s, faster motion between two frames is rejected");
  v("max_angular_speed", p.max_angular_speed, 0.0, 1000.0, "rad/s, faster motion between two frames is rejected");
}

/// Largest plausible motion; a larger one is rejected.
struct MotionBound {
  double shift;  ///< translation of the model's centroid [m]
  double angle;  ///< rotation [rad]
};
inline MotionBound motion_bound(const RegistrationParams& p) { return {p.slack, p.slack / 0.1}; }
/// The bound for a model that was posed `dt` [s] ago: the slack plus the largest speeds times `dt`.
inline MotionBound motion_bound(const IcpParams& p, double dt) {
  const MotionBound always = motion_bound(p);
  return {always.shift + p.max_speed * dt, always.angle + p.max_angular_speed * dt};
}

/// Motion of the hand between two frames in camera coordinates: p_new = motion * p_old.
struct IcpResult {
  SE3 motion;
  double rms = 0;         ///< root mean square point-to-plane distance of the matching points [m]
  double inliers = 0;     ///< matching model points, as a fraction of those that no object hides
  bool reliable = false;  ///< false: `motion` is the identity (the pose is held)
};

/// Registers `model` to `cloud`. The result is the best of three starts: identity, shift of the centroid, and
/// `last_motion` (already scaled to this frame interval).
IcpResult align_rigid(std::span<const OrientedPoint> model, const ObservedCloud& cloud, const SE3& last_motion,
                      const MotionBound& bound, const RegistrationParams& params);

/// A model point, the data point that it was matched with, and the normal of the plane used for their distance. Camera
/// frame [m].
struct IcpPair {
  Eigen::Vector3d model, data, normal;
};
/// Residuals (point-to-plane, then the three point-to-point components, not weighted) of a pair whose model point,
/// given in a frame at the pivot, was moved by `T_camera_pivot`; and their derivative with respect to the boxplus
/// twist.
struct IcpResidual {
  Eigen::Vector4d value;
  Eigen::Matrix<double, 4, 6> jacobian;
};
IcpResidual icp_residual(const SE3& T_camera_pivot, const IcpPair& pair);

}  // namespace barehand
