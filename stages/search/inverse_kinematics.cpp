// Fits a hand profile to the detected joints of a hand (inverse kinematics).
#include "stages/search/inverse_kinematics.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "hand/joint_linearisation.h"
#include "math/angles.h"
#include "math/square.h"

namespace barehand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kIterations = 12;                  // Gauss-Newton steps
constexpr double kDamping = 1e-3;                // Levenberg-Marquardt factor on the diagonal
constexpr double kOutlier = 3;                   // scale of the Cauchy cost of a detected joint [standard deviations]
constexpr double kGapDeviation = 0.001;          // standard deviation of the gap at a soft joint [m]
constexpr double kLimitDeviation = 4 * kDegree;  // standard deviation of angles beyond their limits, and of twist
constexpr double kLimitWidening = 10 * kDegree;  // angle by which the profile's joint limits are widened at both ends
constexpr double kRestFlexion = 20 * kDegree;    // prior mean of every flexion angle
constexpr double kRestDeviation = 50 * kDegree;  // standard deviation of the prior of every flexion angle
constexpr double kLongestTurn = 30 * kDegree,    // largest rotation of a segment in one iteration
    kLongestStep = 0.05;                         // largest translation of a segment in one iteration [m]

/// The point of the hand at which a landmark lies: the proximal or the distal end of a segment.
struct Attachment {
  int segment;
  bool distal;
};

Attachment attachment(int landmark) {
  if (landmark == kWristLandmark) return {kPalm, false};
  const int finger = (landmark - 1) / 4, k = (landmark - 1) % 4;
  return {segment_of(finger, std::min(k, 2)), k == 3};
}

/// Position of a landmark of a pose, camera frame [m].
Vector3d landmark(const HandProfile& profile, const HandPose& pose, int k) {
  const auto [s, distal] = attachment(k);
  return distal ? distal_end(profile, pose, s) : pose[s].t;
}

/// Cauchy's cost of a squared Mahalanobis distance.
double robust_cost(double distance_sq) { return square(kOutlier) * std::log1p(distance_sq / square(kOutlier)); }

/// Adds a residual r with information matrix W that depends on segment s, its parent and the logarithm of the scale.
void add_with_scale(int s, const JointJacobians& J, const Vector3d& J_scale, const Vector3d& r, const Matrix3d& W,
                    KinematicEquations& out) {
  out.tree.add<3>(s, J.child, J.parent, r, W);
  out.coupling[s] += J.child.transpose() * W * J_scale;
  out.coupling[parent_of(s)] += J.parent.transpose() * W * J_scale;
  out.scale_information += J_scale.dot(W * J_scale);
  out.scale_gradient -= J_scale.dot(W * r);
  out.energy += r.dot(W * r);
}

void add_landmarks(const HandProfile& profile, const DetectedJoints& joints, const HandPose& pose, double scale,
                   KinematicEquations& out) {
  for (int k = 0; k < kLandmarkCount; ++k) {
    const auto [s, distal] = attachment(k);
    const Vector3d arm = distal ? Vector3d(scale * (pose[s].R * profile.segments[s].distal)) : Vector3d::Zero();
    const Vector3d r = pose[s].t + arm - joints[k].position;
    const Matrix3d information = joints[k].covariance.inverse();

    // Weight the joint by Cauchy's robust cost (iteratively reweighted least squares).
    const double distance_sq = r.dot(information * r);
    const Matrix3d W = information / (1 + distance_sq / square(kOutlier));
    const double cost = robust_cost(distance_sq);
    out.energy += cost;
    out.cost += cost / kLandmarkCount;

    const auto J = point_jacobian(arm);
    out.tree.H_self[s] += J.transpose() * W * J;
    out.tree.g[s] -= J.transpose() * (W * r);
    out.coupling[s] += J.transpose() * W * arm;
    out.scale_information += arm.dot(W * arm);
    out.scale_gradient -= arm.dot(W * r);
  }
}

void add_joints(const HandProfile& profile, const std::array<JointLimits, kSegmentCount>& limits, const HandPose& pose,
                double scale, KinematicEquations& out) {
  const Matrix3d W_gap = Matrix3d::Identity() / square(kGapDeviation);
  for (int s = 1; s < kSegmentCount; ++s) {
    SE3 rest = profile.rest_relative(s);
    rest.t *= scale;
    const JointLinearisation joint = linearise_joint(rest, pose, s);
    add_with_scale(s, joint.of_gap(), joint.lever, joint.gap, W_gap, out);

    const AngleExcess excess = joint.excess(limits[s]);
    const Matrix3d W_angle = Matrix3d(excess.counts.asDiagonal()) / square(kLimitDeviation);
    const JointJacobians J = joint.of_angles();
    add_with_scale(s, J, Vector3d::Zero(), excess.angles, W_angle, out);

    const Vector3d bent(joint.angles.flexion - kRestFlexion, 0, 0);
    const Matrix3d W_rest = Matrix3d(Vector3d(1, 0, 0).asDiagonal()) / square(kRestDeviation);
    add_with_scale(s, J, Vector3d::Zero(), bent, W_rest, out);
  }
}

/// Pose of the palm whose wrist and knuckles fit the detected ones best (least squares, closed form). None: the
/// detected points lie on one line.
std::optional<SE3> palm_pose(const HandProfile& profile, const DetectedJoints& joints) {
  // Pair the wrist and the knuckles with the detected ones.
  std::array<Vector3d, 6> model, data;
  model[0] = Vector3d::Zero();
  data[0] = joints[kWristLandmark].position;
  for (int finger = 0; finger < kFingerCount; ++finger) {
    model[1 + finger] = profile.rest_relative(segment_of(finger, 0)).t;
    data[1 + finger] = joints[landmark_of(finger, 0)].position;
  }

  // Compute their covariance.
  Vector3d model_mean = Vector3d::Zero(), data_mean = Vector3d::Zero();
  for (int i = 0; i < 6; ++i) model_mean += model[i] / 6, data_mean += data[i] / 6;
  Matrix3d covariance = Matrix3d::Zero();
  for (int i = 0; i < 6; ++i) covariance += (data[i] - data_mean) * (model[i] - model_mean).transpose();

  // Compute the rotation from its singular value decomposition, and exclude a reflection.
  const Eigen::JacobiSVD<Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (!(svd.singularValues()(1) > 1e-6)) return std::nullopt;  // [m^2]; all points lie on one line
  Matrix3d reflection = Matrix3d::Identity();
  reflection(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  SE3 T;
  T.R = svd.matrixU() * reflection * svd.matrixV().transpose();
  T.t = data_mean - T.R * model_mean;
  return T;
}

/// An initial pose for the iteration: the joint angles, within the limits, that give each bone the direction between
/// its detected ends.
HandPose posed_by_bones(const HandProfile& profile, const std::array<JointLimits, kSegmentCount>& limits,
                        const DetectedJoints& joints, const SE3& T_camera_palm) {
  std::array<JointAngles, kSegmentCount> angles{};
  HandPose pose;
  pose[kPalm] = T_camera_palm;

  // Bend the joints from the palm to the tips.
  for (int finger = 0; finger < kFingerCount; ++finger)
    for (int k = 0; k < 3; ++k) {
      const int s = segment_of(finger, k);
      const Vector3d bone = joints[landmark_of(finger, k + 1)].position - joints[landmark_of(finger, k)].position;
      pose[s] = pose[parent_of(s)] * profile.rest_relative(s);

      // Read the angles from the direction of the bone, in the frame of the unbent joint.
      const Vector3d d = pose[s].R.transpose() * bone.normalized();
      angles[s].flexion = std::clamp(std::atan2(-d.y(), -d.z()), limits[s].flexion_lo, limits[s].flexion_hi);
      angles[s].abduction =
          std::clamp(std::asin(std::clamp(-d.x(), -1.0, 1.0)), limits[s].abduction_lo, limits[s].abduction_hi);
      pose[s].R *= joint_rotation(angles[s]);
    }
  return pose;
}

/// Makes one Gauss-Newton step. The scale couples all segments, so it is eliminated last: the tree is solved first
/// without the scale, then for the change of the solution with the scale. Returns false if the equations are singular.
bool step(bool with_scale, KinematicEquations& equations, HandPose& pose, double& scale) {
  GaussianTree& tree = equations.tree;
  for (int s = 0; s < kSegmentCount; ++s) {
    tree.H_self[s].diagonal() *= 1 + kDamping;
    tree.H_self[s].diagonal().array() += 1e-3;  // keeps the step finite in unconstrained directions
  }
  std::array<Vector6d, kSegmentCount> x, by_scale;
  if (!tree.solve(x)) return false;

  double scale_step = 0;
  if (with_scale) {
    tree.g = equations.coupling;
    if (!tree.solve(by_scale)) return false;

    // Eliminate the poses from the equation of the scale.
    double information = equations.scale_information, gradient = equations.scale_gradient;
    for (int s = 0; s < kSegmentCount; ++s) {
      information -= equations.coupling[s].dot(by_scale[s]);
      gradient -= equations.coupling[s].dot(x[s]);
    }
    scale_step = std::clamp(gradient / information, -0.2, 0.2);
    for (int s = 0; s < kSegmentCount; ++s) x[s] -= scale_step * by_scale[s];
  }

  // Limit the step. All segments get the same factor, so that the joints stay closed.
  double shortened = 1;
  for (const Vector6d& twist : x) {
    shortened = std::min(shortened, kLongestStep / std::max(twist.head<3>().norm(), 1e-12));
    shortened = std::min(shortened, kLongestTurn / std::max(twist.tail<3>().norm(), 1e-12));
  }

  // Apply the step.
  for (int s = 0; s < kSegmentCount; ++s) {
    pose[s] = boxplus(pose[s], shortened * x[s]);
    pose[s].R = orthonormalised(pose[s].R);
  }
  scale *= std::exp(shortened * scale_step);
  return true;
}

/// The pose of the unscaled profile that has the same joint angles, without twist, and the same centre of the palm.
HandPose in_own_size(const HandProfile& profile, const HandPose& pose, double scale) {
  std::array<JointAngles, kSegmentCount> angles{};
  for (int s = 1; s < kSegmentCount; ++s) {
    angles[s] = joint_angles(profile, pose, s);
    angles[s].twist = 0;
  }
  SE3 T_camera_palm = pose[kPalm];
  T_camera_palm.t += (scale - 1) * (T_camera_palm.R * (0.5 * profile.segments[kPalm].distal));
  return forward_kinematics(profile, T_camera_palm, angles);
}

std::optional<KinematicFit> fit(const HandProfile& profile, const DetectedJoints& joints, bool with_scale,
                                double scale_deviation) {
  const auto T_camera_palm = palm_pose(profile, joints);
  if (!T_camera_palm) return std::nullopt;
  const auto limits = widened_limits(profile, kLimitWidening);
  HandPose pose = posed_by_bones(profile, limits, joints, *T_camera_palm);

  double scale = 1;
  for (int i = 0; i < kIterations; ++i) {
    KinematicEquations equations = kinematic_equations(profile, limits, joints, pose, scale, scale_deviation);
    if (!step(with_scale, equations, pose, scale)) return std::nullopt;
  }
  return KinematicFit{in_own_size(profile, pose, scale), scale,
                      kinematic_equations(profile, limits, joints, pose, scale, scale_deviation).cost};
}

}  // namespace

double mean_distance(const HandProfile& profile, const HandPose& pose, const DetectedJoints& joints) {
  double sum = 0;
  for (int k = 0; k < kLandmarkCount; ++k)
    sum += (landmark(profile, pose, k) - joints[k].position).norm() / kLandmarkCount;
  return sum;
}

double joint_cost(const HandProfile& profile, const HandPose& pose, const DetectedJoints& joints) {
  double sum = 0;
  for (int k = 0; k < kLandmarkCount; ++k) {
    const Vector3d r = landmark(profile, pose, k) - joints[k].position;
    sum += robust_cost(r.dot(joints[k].covariance.inverse() * r)) / kLandmarkCount;
  }
  return sum;
}

KinematicEquations kinematic_equations(const HandProfile& profile, const std::array<JointLimits, kSegmentCount>& limits,
                                       const DetectedJoints& joints, const HandPose& pose, double scale,
                                       double scale_deviation) {
  KinematicEquations equations;
  equations.tree.set_zero();
  equations.coupling.fill(Vector6d::Zero());
  add_landmarks(profile, joints, pose, scale, equations);
  add_joints(profile, limits, pose, scale, equations);

  const double log_scale = std::log(scale), information = 1 / square(scale_deviation);
  equations.scale_information += information;
  equations.scale_gradient -= information * log_scale;
  equations.energy += information * square(log_scale);
  return equations;
}

std::optional<KinematicFit> fit_to_joints(const HandProfile& profile, const DetectedJoints& joints) {
  return fit(profile, joints, profile.origin != ProfileOrigin::measured, kScaleDeviation);
}

std::optional<KinematicFit> fit_size_to_joints(const HandProfile& profile, const DetectedJoints& joints,
                                               double deviation) {
  return fit(profile, joints, true, deviation);
}

std::optional<KinematicFit> fit_size_to_hand(const HandProfile& profile, const DetectedHand& detected,
                                             double deviation) {
  const DetectedJoints& joints = detected.joints_of(profile.handedness);
  return fit_size_to_joints(detected.may_be(profile.handedness) ? profile : mirrored(profile), joints, deviation);
}

}  // namespace barehand
