#include "observe/registration/rigid_icp.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/memory/frame_memory.h"

namespace barehand {

namespace {

// Robust ICP (iterative closest points) with point-to-plane and point-to-point residuals.

using Eigen::Vector3d;

constexpr std::size_t kCoarseStride = 2;  // the first half of the iterations uses every second model point

// After a step that is shorter than the fraction kStill of the robust scale, the next kSkipped iterations are skipped.
constexpr double kStill = 0.04;
constexpr int kSkipped = 3;
constexpr double kArm = 0.05;  // lever arm that converts the rotation of a step to a length [m]

// Cost of a model point that is hidden by an object, relative to that of an outlier. It is not zero, because otherwise
// a motion that hides the hand behind an object would have the lowest cost.
constexpr double kHiddenCost = 0.3;

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

/// Registers a model to a cloud from given initial motions. The pivot frame is at the model's centroid, so that
/// rotation and translation are nearly independent.
class Registration {
 public:
  Registration(std::span<const OrientedPoint> model, const ObservedCloud& cloud, const RegistrationParams& params)
      : model_(model), cloud_(cloud), params_(params), pivot_(centroid_of(model)), nearest_(model.size(), 0) {}

  /// Runs the iterations [begin, end) of the annealing from `motion`, with every `stride`-th model point. Iterations
  /// after very small steps are skipped, except for the last one.
  SE3 run(const SE3& motion, int begin, int end, std::size_t stride) {
    SE3 T_camera_pivot = motion * SE3{Eigen::Matrix3d::Identity(), pivot_};
    const double ratio = params_.scale_end / params_.scale_start;
    for (int i = begin; i < end; ++i) {
      const double progress = params_.iterations > 1 ? i / (params_.iterations - 1.0) : 1.0;
      const double scale = params_.scale_start * std::pow(ratio, progress);
      const Vector6d twist = step(T_camera_pivot, scale, std::pow(params_.point_weight, progress), stride);
      T_camera_pivot = boxplus(T_camera_pivot, twist);
      const bool still = twist.head<3>().norm() + kArm * twist.tail<3>().norm() < kStill * scale;
      if (still && i + 1 < end) i = std::min(i + kSkipped, end - 2);
    }
    T_camera_pivot.R = orthonormalised(T_camera_pivot.R);
    return T_camera_pivot * SE3{Eigen::Matrix3d::Identity(), -pivot_};
  }

  struct Fit {
    double cost = 0, rms = 0, inliers = 0;
  };
  /// Computes how well the moved model fits the cloud. The cost is the robust mean of the squared distances to the
  /// nearest points, with a constant for hidden points; rms (point-to-plane [m]) and inliers (fraction) leave out
  /// hidden points.
  Fit fit(const SE3& motion) {
    const double scale = 2 * params_.scale_end;
    Fit fit;
    double sum_sq = 0;
    int matched = 0, counted = 0;

    // A point that is hidden at this motion costs a fixed amount.
    for (std::size_t k = 0; k < model_.size(); ++k) {
      const OrientedPoint& q = model_[k];
      const Vector3d moved = motion * q.p;
      if (cloud_.hidden(moved)) {
        fit.cost += kHiddenCost * scale * scale;
        continue;
      }

      // Match each other point, and add its robust cost.
      ++counted;
      const IcpPair pair = match(motion, q.p - pivot_, k, moved);
      const double distance_sq = (moved - pair.data).squaredNorm(), plane = pair.normal.dot(moved - pair.data);
      fit.cost += robust_cost(distance_sq, scale);

      // Points that match within the scale count as inliers.
      if (distance_sq > scale * scale) continue;
      sum_sq += plane * plane;
      ++matched;
    }

    // Average the sums.
    fit.cost /= static_cast<double>(model_.size());
    fit.inliers = counted > 0 ? static_cast<double>(matched) / counted : 0;
    fit.rms = matched > 0 ? std::sqrt(sum_sq / matched) : 0;
    return fit;
  }

 private:
  /// Matches model point `k` with the nearest point of the cloud. The pair gets the normal of the data if it is defined
  /// and agrees with that of the model, otherwise the normal of the model.
  IcpPair match(const SE3& motion, const Vector3d& in_pivot, std::size_t k, const Vector3d& moved) {
    const std::size_t i = nearest_[k] = cloud_.nearest(moved, nearest_[k]);
    const Vector3d model_normal = motion.R * model_[k].n, data_normal = cloud_.normal(i);
    return {in_pivot, cloud_.point(i), data_normal.dot(model_normal) > 0.5 ? data_normal : model_normal};
  }

  Vector6d step(const SE3& T, double scale, double point_weight, std::size_t stride) {
    Matrix6d H = Matrix6d::Zero();
    Vector6d b = Vector6d::Zero();

    // Sum up the normal equations over the points that are not hidden.
    for (std::size_t k = 0; k < model_.size(); k += stride) {
      const OrientedPoint& q = model_[k];
      const Vector3d in_pivot = q.p - pivot_, moved = T * in_pivot;
      if (cloud_.hidden(moved)) continue;

      // Match the point, and compute its robust weight.
      const IcpPair pair = match(T, in_pivot, k, moved);
      const IcpResidual r = icp_residual(T, pair);
      const Eigen::Vector4d w = robust_weight(r.value.tail<3>().squaredNorm(), scale) *
                                Eigen::Vector4d(1, point_weight, point_weight, point_weight);
      H += r.jacobian.transpose() * w.asDiagonal() * r.jacobian;
      b += r.jacobian.transpose() * w.cwiseProduct(r.value);
    }

    // Damping makes the step zero in directions that no point constrains.
    H.diagonal().array() += 1e-9;
    H.diagonal() *= 1.001;
    const Vector6d twist = -H.ldlt().solve(b);
    return twist.allFinite() ? twist : Vector6d::Zero();
  }

  std::span<const OrientedPoint> model_;
  const ObservedCloud& cloud_;
  const RegistrationParams& params_;
  Vector3d pivot_;
  FrameVector<std::size_t> nearest_;  // for each model point the cloud point matched last, where the next search begins
};

bool nearly_equal(const SE3& a, const SE3& b, const Vector3d& pivot) {
  return (a * pivot - b * pivot).norm() < 0.002 && log_so3(a.R.transpose() * b.R).norm() < 0.03;
}

/// Removes all motions that are nearly equal to an earlier one.
void leave_one_of_each(FrameVector<SE3>& motions, const Vector3d& pivot) {
  auto kept = motions.begin();
  for (const SE3& motion : motions) {
    if (std::none_of(motions.begin(), kept, [&](const SE3& other) { return nearly_equal(motion, other, pivot); }))
      *kept++ = motion;
  }
  motions.erase(kept, motions.end());
}

bool believable(const SE3& motion, const Vector3d& pivot, const MotionBound& bound) {
  return motion.all_finite() && (motion * pivot - pivot).norm() < bound.shift && log_so3(motion.R).norm() < bound.angle;
}

}  // namespace

IcpResidual icp_residual(const SE3& T_camera_pivot, const IcpPair& pair) {
  const Vector3d arm = T_camera_pivot.R * pair.model;
  const Vector3d difference = arm + T_camera_pivot.t - pair.data;
  IcpResidual r;
  r.value << pair.normal.dot(difference), difference;
  // d(exp(w) a)/dw = -[a]x, hence d(n . a)/dw = (a x n)^T.
  r.jacobian.row(0) << pair.normal.transpose(), arm.cross(pair.normal).transpose();
  r.jacobian.bottomRows<3>() = point_jacobian(arm);
  return r;
}

IcpResult align_rigid(std::span<const OrientedPoint> model, const ObservedCloud& cloud, const SE3& last_motion,
                      const MotionBound& bound, const RegistrationParams& params) {
  if (!params.enabled || static_cast<int>(cloud.size()) < params.min_points || model.size() < 20) return {};

  // Start without motion, from the centroid of the cloud, and from the last motion.
  Registration registration(model, cloud, params);
  const Vector3d pivot = centroid_of(model);
  FrameVector<SE3> motions = {SE3{}, SE3{Eigen::Matrix3d::Identity(), cloud.centroid() - pivot}, last_motion};

  // Run the first half of the iterations with fewer points, and merge starts that have converged to the same motion.
  const int coarse = params.iterations / 2, first = params.iterations / 6;
  int begin = 0;
  for (const int end : {first, coarse}) {
    for (SE3& motion : motions) motion = registration.run(motion, begin, end, kCoarseStride);
    leave_one_of_each(motions, pivot);
    begin = end;
  }

  // Refine each remaining motion with all points, and keep the best plausible one.
  IcpResult best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const SE3& coarse_motion : motions) {
    const SE3 motion = registration.run(coarse_motion, coarse, params.iterations, 1);

    // Leave out motions that are not plausible or not better.
    if (!believable(motion, pivot, bound)) continue;
    const auto fit = registration.fit(motion);
    if (fit.cost >= best_cost) continue;
    best_cost = fit.cost;
    best = {motion, fit.rms, fit.inliers, fit.inliers >= params.min_inliers};
  }
  if (!best.reliable) best.motion = SE3{};
  return best;
}

}  // namespace barehand
