#include "stages/prediction/rigid_icp.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace barehand {

namespace {

using Eigen::Vector3d;

/// Geman-McClure: rho(r) = r^2 / (1 + r^2 / s^2), bounded by s^2; its weight is rho' / (2 r).
double robust_weight(double r_sq, double scale) {
  const double k = scale * scale / (scale * scale + r_sq);
  return k * k;
}
double robust_cost(double r_sq, double scale) { return r_sq * scale * scale / (scale * scale + r_sq); }

Vector3d centroid_of(std::span<const OrientedPoint> points) {
  Vector3d sum = Vector3d::Zero();
  for (const OrientedPoint& q : points) sum += q.p;
  return sum / static_cast<double>(points.size());
}

/// One registration from one start. The pivot frame sits at the model's centroid, so that rotation and translation
/// are nearly independent.
class Registration {
 public:
  Registration(std::span<const OrientedPoint> model, const ObservedCloud& cloud, const IcpParams& params)
      : model_(model), cloud_(cloud), params_(params), pivot_(centroid_of(model)) {}

  SE3 run(const SE3& start) const {
    SE3 T_camera_pivot = start * SE3{Eigen::Matrix3d::Identity(), pivot_};
    const double ratio = params_.scale_end / params_.scale_start;
    for (int i = 0; i < params_.iterations; ++i) {
      const double progress = params_.iterations > 1 ? i / (params_.iterations - 1.0) : 1.0;
      T_camera_pivot = step(T_camera_pivot, params_.scale_start * std::pow(ratio, progress));
    }
    T_camera_pivot.R = orthonormalised(T_camera_pivot.R);
    return T_camera_pivot * SE3{Eigen::Matrix3d::Identity(), -pivot_};
  }

  struct Fit {
    double cost = 0, rms = 0, inliers = 0;
  };
  /// How well a motion explains the cloud: robust mean of squared nearest distances.
  Fit fit(const SE3& motion) const {
    const double scale = 2 * params_.scale_end;
    Fit fit;
    double sum_sq = 0;
    int matched = 0;
    for (const OrientedPoint& q : model_) {
      const IcpPair pair = match(motion, q.p - pivot_, q, motion * q.p);
      const double distance_sq = (motion * q.p - pair.data).squaredNorm();
      const double plane = pair.normal.dot(motion * q.p - pair.data);
      fit.cost += robust_cost(distance_sq, scale);
      if (distance_sq > scale * scale) continue;
      sum_sq += plane * plane;
      ++matched;
    }
    fit.cost /= static_cast<double>(model_.size());
    fit.inliers = static_cast<double>(matched) / static_cast<double>(model_.size());
    fit.rms = matched > 0 ? std::sqrt(sum_sq / matched) : 0;
    return fit;
  }

 private:
  /// The data's normal where it is defined and agrees with the model's, else the model's own.
  IcpPair match(const SE3& motion, const Vector3d& in_pivot, const OrientedPoint& q, const Vector3d& moved) const {
    const std::size_t i = cloud_.nearest(moved);
    const Vector3d model_normal = motion.R * q.n, data_normal = cloud_.normal(i);
    return {in_pivot, cloud_.point(i), data_normal.dot(model_normal) > 0.5 ? data_normal : model_normal};
  }

  SE3 step(const SE3& T, double scale) const {
    Matrix6d H = Matrix6d::Zero();
    Vector6d b = Vector6d::Zero();
    for (const OrientedPoint& q : model_) {
      const Vector3d in_pivot = q.p - pivot_;
      const IcpPair pair = match(T, in_pivot, q, T * in_pivot);
      const IcpResidual r = icp_residual(T, pair);
      const Eigen::Vector4d w = robust_weight(r.value.tail<3>().squaredNorm(), scale) *
                                Eigen::Vector4d(1, params_.point_weight, params_.point_weight, params_.point_weight);
      H += r.jacobian.transpose() * w.asDiagonal() * r.jacobian;
      b += r.jacobian.transpose() * w.cwiseProduct(r.value);
    }
    // A little damping keeps directions that no point constrains where they are.
    H.diagonal().array() += 1e-9;
    H.diagonal() *= 1.001;
    const Vector6d twist = -H.ldlt().solve(b);
    return twist.allFinite() ? boxplus(T, twist) : T;
  }

  std::span<const OrientedPoint> model_;
  const ObservedCloud& cloud_;
  const IcpParams& params_;
  Vector3d pivot_;
};

bool believable(const SE3& motion, const Vector3d& pivot, double dt, const IcpParams& params) {
  const double shift = (motion * pivot - pivot).norm();
  const double angle = log_so3(motion.R).norm();
  return motion.all_finite() && shift < params.slack + params.max_speed * dt &&
         angle < params.slack / 0.1 + params.max_angular_speed * dt;
}

}  // namespace

IcpResidual icp_residual(const SE3& T_camera_pivot, const IcpPair& pair) {
  const Vector3d arm = T_camera_pivot.R * pair.model;
  const Vector3d difference = arm + T_camera_pivot.t - pair.data;
  IcpResidual r;
  r.value << pair.normal.dot(difference), difference;
  // d(exp(w) a)/dw = -[a]x, hence d(n . a)/dw = (a x n)^T.
  r.jacobian.row(0) << pair.normal.transpose(), arm.cross(pair.normal).transpose();
  r.jacobian.bottomRows<3>() << Eigen::Matrix3d::Identity(), -skew(arm);
  return r;
}

IcpResult align_rigid(std::span<const OrientedPoint> model, const ObservedCloud& cloud, const SE3& last_motion,
                      double dt, const IcpParams& params) {
  if (!params.enabled || static_cast<int>(cloud.size()) < params.min_points || model.size() < 20) return {};
  const Registration registration(model, cloud, params);
  const Vector3d pivot = centroid_of(model);
  const std::array<SE3, 3> starts = {SE3{}, SE3{Eigen::Matrix3d::Identity(), cloud.centroid() - pivot}, last_motion};
  IcpResult best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const SE3& start : starts) {
    const SE3 motion = registration.run(start);
    if (!believable(motion, pivot, dt, params)) continue;
    const auto fit = registration.fit(motion);
    if (fit.cost >= best_cost) continue;
    best_cost = fit.cost;
    best = {motion, fit.rms, fit.inliers, fit.inliers >= params.min_inliers};
  }
  if (!best.reliable) best.motion = SE3{};
  return best;
}

}  // namespace barehand
