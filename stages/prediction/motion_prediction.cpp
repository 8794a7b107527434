// Predicts the next pose of a hand from its velocity and by ICP.
#include "stages/prediction/motion_prediction.h"

#include <algorithm>
#include <cassert>

namespace barehand {

namespace {

/// Limits the linear and the angular part of a velocity to their maximum norms.
Vector6d bounded(Vector6d velocity, const PredictionParams& params) {
  const double speed = velocity.head<3>().norm(), angular = velocity.tail<3>().norm();
  if (speed > params.max_speed) velocity.head<3>() *= params.max_speed / speed;
  if (angular > params.max_angular_speed) velocity.tail<3>() *= params.max_angular_speed / angular;
  return velocity;
}

}  // namespace

HandPose moved(const SE3& motion, const HandPose& pose) {
  HandPose result;
  for (int s = 0; s < kSegmentCount; ++s) {
    result[s] = motion * pose[s];
    result[s].R = orthonormalised(result[s].R);
  }
  return result;
}

void MotionModel::restart(const HandPose& pose, std::int64_t utime) {
  pose_ = pose;
  utime_ = utime;
  has_pose_ = true;
  seen_.fill(true);
  velocity_.fill(Vector6d::Zero());
  global_velocity_.setZero();
}

void MotionModel::update(const HandPose& pose, const std::array<bool, kSegmentCount>& seen,
                         const Prediction& prediction) {
  // Take ICP's motion as the global motion of this frame or, without ICP, the motion of the palm. With none, the whole
  // motion would count as motion relative to the hand and be applied twice.
  const double dt = prediction.dt;
  const bool usable = has_pose_ && dt > 0 && dt <= params_.max_interval;
  const SE3 global = prediction.icp.reliable ? prediction.icp.motion : SE3(pose[kPalm] * pose_[kPalm].inverse());

  // Compute the velocities of the segments relative to the global motion, and that of the global motion itself.
  const HandPose carried = moved(usable ? global : SE3{}, pose_);
  for (int s = 0; s < kSegmentCount; ++s) {
    const Vector6d measured =
        usable ? bounded(boxminus(pose[s], carried[s]) / dt, params_) : Vector6d(Vector6d::Zero());
    velocity_[s] = params_.smoothing * velocity_[s] + (1 - params_.smoothing) * measured;
  }
  if (usable) global_velocity_ = boxminus(carried[kPalm], pose_[kPalm]) / dt;
  if (!usable) global_velocity_.setZero();

  pose_ = pose;
  seen_ = seen;
  utime_ = prediction.utime;
  has_pose_ = true;
}

double MotionModel::damping_of(int segment, double dt) const {
  if (seen_[segment]) return params_.damping;
  return dt * params_.slow_rate > 1 ? params_.slow_unseen_damping : params_.unseen_damping;
}

HandPose MotionModel::with_velocity(const HandPose& carried, const SE3& motion, double dt) const {
  HandPose pose = carried;
  std::array<Vector6d, kSegmentCount> velocity;
  for (int s = 0; s < kSegmentCount; ++s) {
    // Turn the velocities with the hand.
    velocity[s].head<3>() = motion.R * velocity_[s].head<3>();
    velocity[s].tail<3>() = motion.R * velocity_[s].tail<3>();

    // Move a seen segment with its own velocity.
    if (s == kPalm || seen_[s]) {
      pose[s] = boxplus(carried[s], damping_of(s, dt) * dt * velocity[s]);
      continue;
    }

    // Move an unseen segment with its parent; its joint angles change only by a damped flexion.
    const int parent = parent_of(s);
    pose[s] = pose[parent] * (carried[parent].inverse() * carried[s]);
    const Eigen::Vector3d bending = velocity[s].tail<3>() - velocity[parent].tail<3>();
    pose[s].R = exp_so3(damping_of(s, dt) * dt * bending) * pose[s].R;
  }
  return pose;
}

Prediction MotionModel::predict(const HandObservation& observation, const HandSurface& surface) {
  assert(has_pose_);
  Prediction result;
  result.utime = observation.frame->utime;
  result.dt = std::abs(static_cast<double>(observation.frame->utime - utime_) * 1e-6);

  // Predict the last pose unchanged if too few hand points are visible.
  const StartPose held{"held", pose_};
  cloud_.reset(observation);
  if (static_cast<int>(cloud_.size()) < icp_params_.min_points) {
    result.candidates = {held};
    return result;
  }

  // Find the global motion by ICP, which starts from the last motion.
  const bool recent = result.dt > 0 && result.dt <= params_.max_interval;
  const double ahead = recent && params_.velocity ? result.dt : 0;
  const SE3 last_motion = boxplus(pose_[kPalm], ahead * global_velocity_) * pose_[kPalm].inverse();
  const auto model = visible_points_.of(surface, pose_, observation.frame->camera, icp_params_.model_points);
  result.icp = align_rigid(model, cloud_, last_motion, motion_bound(icp_params_, result.dt), icp_params_);

  // Make the candidates: the pose moved by ICP's motion or by the last motion, with and without the segments' own
  // velocities.
  const HandPose carried = moved(last_motion, pose_);
  const StartPose velocity{"velocity", with_velocity(carried, last_motion, ahead)};

  // Prefer the motion of ICP, if it is reliable.
  if (result.icp.reliable) {
    const StartPose icp{"icp", moved(result.icp.motion, pose_)};
    const StartPose both{"icp_velocity", with_velocity(icp.pose, result.icp.motion, ahead)};
    result.candidates = {both, icp, velocity, held};
    if (!params_.velocity) result.candidates = {icp, held};
  } else {
    result.candidates = {held, velocity};
    if (!params_.velocity) result.candidates = {held};
  }
  return result;
}

}  // namespace barehand
